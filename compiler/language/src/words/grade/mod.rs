//! Numbers with a meaning: grit, mesh, Shore, Mohs, Ra, thread count, denier, wale, pile.
//!
//! A sentence encoder knows that "P80" is about sandpaper, and not that it is coarser than "P400". So
//! the reader takes a number with its scale out of the words, and the thing that is left moves as far as
//! the number says.

mod janka;
mod notation;
mod number;
mod parts;
mod scales;

use super::Token;
use notation::CUTS;
use std::fmt::{self, Display, Formatter};
use std::ops::RangeInclusive;

pub use janka::{janka, woods};
pub(crate) use notation::{Context, read};
pub(crate) use scales::is_abrasive;
pub use scales::{PAPERS, grit_um, is_paper, own_grain_um};

/// A number on a scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grade {
    /// Scale of the number.
    pub scale: Scale,
    /// The number, in the unit of its scale.
    pub value: f64,
}

/// Scales of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Grit of an abrasive, with or without the P of FEPA.
    Grit {
        /// True if the P is written.
        p: bool,
    },
    /// Openings of a sieve per inch.
    Mesh,
    /// Indentation hardness of elastomers, ISO 868.
    ShoreA,
    /// The same, of plastics.
    ShoreD,
    /// Scratch hardness of minerals.
    Mohs,
    /// Arithmetical mean height of a profile, µm, ISO 21920-2.
    Ra,
    /// Threads of a cloth per square inch.
    Threads,
    /// Mass of 9,000 m of a thread, g.
    Denier,
    /// Height of a pile, mm.
    Pile,
    /// Teeth of a file per inch, by the names of its cuts.
    Cut,
    /// Ribs of corduroy per inch.
    Wale,
}

impl Scale {
    /// The numbers that are sold or measured.
    fn range(self) -> RangeInclusive<f64> {
        match self {
            Self::Grit { .. } => 6.0..=30_000.0,
            Self::Mesh => 2.0..=3000.0,
            Self::ShoreA | Self::ShoreD => 0.0..=100.0,
            Self::Mohs => 1.0..=10.0,
            Self::Ra => 0.001..=200.0,
            Self::Threads => 20.0..=3000.0,
            Self::Denier => 1.0..=10_000.0,
            Self::Pile => 0.2..=200.0,
            Self::Cut => 1.0..=1000.0,
            Self::Wale => 1.0..=40.0,
        }
    }
}

impl Grade {
    /// The grade that a word is, as the reader writes one.
    #[must_use]
    pub fn of(word: &str) -> Option<Self> {
        // Most words are none.
        let may = word.bytes().any(|byte| byte.is_ascii_digit()) || word.ends_with(" cut");
        let tokens = may.then(|| crate::words::normalise(word))?;
        let (count, grade) = read(&tokens, Context::of_file())?;
        (count == tokens.len()).then_some(grade)
    }

    fn is_in_range(&self) -> bool {
        self.scale.range().contains(&self.value)
    }

    /// Returns the thing that is graded where a prompt names nothing.
    #[must_use]
    pub fn thing(self) -> &'static str {
        match self.scale {
            Scale::Grit { .. } => "sandpaper",
            Scale::Mesh => "sand",
            Scale::ShoreA => "rubber",
            Scale::ShoreD => "plastic",
            Scale::Mohs => "stone",
            Scale::Ra => "steel",
            Scale::Threads => "bed sheet",
            Scale::Denier => "nylon fabric",
            Scale::Pile => "carpet",
            Scale::Cut => "file",
            Scale::Wale => "corduroy",
        }
    }

    /// Returns true if two numbers specify the same property of a surface, so that only one can hold.
    #[must_use]
    pub fn conflicts(self, other: Self) -> bool {
        let kind = |grade: Self| match grade.scale {
            Scale::Grit { .. } => Scale::Mesh,
            Scale::ShoreD => Scale::ShoreA,
            scale => scale,
        };
        kind(self) == kind(other) && self.value != other.value
    }
}

/// A note to the user on the numbers of a prompt.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Note {
    /// A number that its scale does not have.
    OutOfRange(Grade),
    /// A comma that was read as the point of decimals.
    Comma(String),
}

impl Note {
    /// The number, if it was not read.
    pub(crate) fn unread(&self) -> Option<String> {
        match self {
            Self::OutOfRange(grade) => Some(grade.to_string()),
            Self::Comma(_) => None,
        }
    }
}

impl Display for Note {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange(grade) => {
                let range = grade.scale.range();
                let [least, most] = [range.start(), range.end()].map(|value| Grade {
                    value: *value,
                    ..*grade
                });
                write!(
                    f,
                    "“{grade}” is out of range and was not read: the scale goes from {least} to {most}"
                )
            }
            Self::Comma(said) => {
                write!(f, "“{said}” is read as {}", said.replace(',', "."))
            }
        }
    }
}

/// Takes numbers that are out of range from a prompt, and says what to tell of its numbers.
pub(crate) fn notes(tokens: &mut Vec<Token>) -> Vec<Note> {
    let mut notes = Vec::new();
    if !may_be_in(tokens) {
        return notes;
    }
    let context = Context::of(tokens);
    let mut at = 0;
    while at < tokens.len() {
        match notation::any(&tokens[at..], context) {
            Some((count, grade)) if !grade.is_in_range() => {
                notes.push(Note::OutOfRange(grade));
                tokens.drain(at..at + count);
            }
            Some((count, _)) => {
                let comma = tokens[at..at + count].iter().find_map(|token| match token {
                    Token::Word(word) if word.contains(',') => Some(word.clone()),
                    _ => None,
                });
                notes.extend(comma.map(Note::Comma));
                at += count;
            }
            None => at += 1,
        }
    }
    notes
}

/// Returns true if tokens may hold a grade.
pub(crate) fn may_be_in(tokens: &[Token]) -> bool {
    let file = |token: &Token| matches!(token, Token::Word(word) if word == "file");
    tokens
        .iter()
        .any(|token| number::begins(token) || file(token))
}

/// Returns the ratio of the relief of a text's thing to that of the thing itself, by the last number that specifies it.
#[must_use]
pub fn coarser(text: &str) -> f64 {
    let tokens = super::normalise(text);
    let context = Context::of(&tokens);
    let text = text.to_lowercase();
    let grades = (0..tokens.len()).rev();
    let mut ratios = grades.filter_map(|at| Some(read(&tokens[at..], context)?.1.coarser(&text)));
    ratios.find(|ratio| *ratio != 1.0).unwrap_or(1.0)
}

/// As [`Grade::of`] reads it.
impl Display for Grade {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let value = self.value;
        match self.scale {
            Scale::Grit { p: true } => write!(f, "P{value}"),
            Scale::Grit { p: false } => write!(f, "{value} grit"),
            Scale::Mesh => write!(f, "{value} mesh"),
            Scale::ShoreA => write!(f, "Shore A {value}"),
            Scale::ShoreD => write!(f, "Shore D {value}"),
            Scale::Mohs => write!(f, "Mohs {value}"),
            Scale::Ra => write!(f, "Ra {value} µm"),
            Scale::Threads => write!(f, "{value} thread count"),
            Scale::Denier => write!(f, "{value} denier"),
            Scale::Pile => write!(f, "{value} mm pile"),
            Scale::Wale => write!(f, "{value} wale"),
            Scale::Cut => {
                let cut = CUTS.iter().find(|(_, teeth)| *teeth == value);
                write!(f, "{}", cut.map_or("", |(cut, _)| cut))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::words::normalise;

    /// Notes on the numbers of a prompt, and the words that are left.
    fn told(prompt: &str) -> (Vec<String>, usize) {
        let mut tokens = normalise(prompt);
        let notes = notes(&mut tokens);
        (notes.iter().map(Note::to_string).collect(), tokens.len())
    }

    #[test]
    fn a_number_out_of_range_is_named_with_its_range() {
        for (prompt, said, left) in [
            ("P0", "P0", 0),
            ("P3 sandpaper", "P3", 1),
            ("P99999999 sandpaper", "P99999999", 1),
            ("1,000,000 grit", "1000000 grit", 0),
            ("Shore A -5 rubber", "Shore A -5", 1),
            ("−20 Shore D plastic", "Shore D -20", 1),
            ("Shore D 400", "Shore D 400", 0),
            ("Mohs 0 talc", "Mohs 0", 1),
            ("steel, Ra 5000", "Ra 5000 µm", 1),
            ("5 thread count sheets", "5 thread count", 1),
            ("900 mm pile carpet", "900 mm pile", 1),
            ("99 wale corduroy", "99 wale", 1),
        ] {
            let (told, rest) = told(prompt);
            assert!(
                told[0].contains(&format!("“{said}” is out of range")),
                "{told:?}"
            );
            assert_eq!((told.len(), rest), (1, left), "{prompt}");
        }
        let (told, _) = told("Shore A 120 rubber");
        assert!(
            told[0].ends_with("from Shore A 0 to Shore A 100"),
            "{told:?}"
        );
    }

    #[test]
    fn numbers_that_are_none_of_a_scale_are_not_named() {
        for prompt in [
            "P2 respirator mask",
            "#1 rubber",
            "240A rubber",
            "bolt with 10 threads per inch",
            "a 300 mm pile of leaves",
            "sandpaper -80 grit",
            "rubber, 3,5 kg",
            "Ra 0,4 steel",
        ] {
            let whole = normalise(prompt).len();
            assert_eq!(told(prompt), (Vec::new(), whole), "{prompt}");
        }
    }

    #[test]
    fn a_comma_that_may_be_two_things_is_said() {
        let (told, _) = told("1,5 mm pile rug");
        assert_eq!(told, ["“1,5” is read as 1.5"]);
    }
}
