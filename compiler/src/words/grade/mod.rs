//! Numbers with a meaning: grit, mesh, Shore, Mohs, Ra, thread count, denier, pile.
//!
//! A sentence encoder knows that "P80" is about sandpaper, and not that it is coarser than "P400". So
//! the reader takes a number with its scale out of the words, and the thing that is left moves as far as
//! the number says.

mod janka;
mod notation;
mod parts;
mod scales;

use notation::CUTS;
use std::fmt::{self, Display, Formatter};

pub(crate) use janka::janka;
pub use janka::woods;
pub(crate) use notation::{Context, read};
pub(crate) use scales::{PAPERS, grit_um, is_abrasive, is_paper, own_grain_um};

/// A number on a scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grade {
    pub(crate) scale: Scale,
    pub(crate) value: f64,
}

/// What a number counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scale {
    /// Grit of an abrasive, with or without the P of FEPA.
    Grit { p: bool },
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
}

impl Grade {
    /// The grade that a word is, as the reader writes one.
    pub(crate) fn of(word: &str) -> Option<Self> {
        // Most words are none.
        let may = word.bytes().any(|byte| byte.is_ascii_digit()) || word.ends_with(" cut");
        let tokens = may.then(|| crate::words::normalise(word))?;
        let (count, grade) = read(&tokens, Context::of_file())?;
        (count == tokens.len()).then_some(grade)
    }

    /// What is graded where a prompt names nothing.
    pub(crate) fn thing(self) -> &'static str {
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
        }
    }

    /// Whether two numbers say the same thing of a surface, so that only one can hold.
    pub(crate) fn conflicts(self, other: Self) -> bool {
        let kind = |grade: Self| match grade.scale {
            Scale::Grit { .. } => Scale::Mesh,
            Scale::ShoreD => Scale::ShoreA,
            scale => scale,
        };
        kind(self) == kind(other) && self.value != other.value
    }
}

/// How much coarser the relief of a text's thing is than its own, by the last number that says it.
pub(crate) fn coarser(text: &str) -> f64 {
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
            Scale::Cut => {
                let cut = CUTS.iter().find(|(_, teeth)| *teeth == value);
                write!(f, "{}", cut.map_or("", |(cut, _)| cut))
            }
        }
    }
}
