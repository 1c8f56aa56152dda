//! What a prompt names, and what it says about it.
//!
//! A sentence encoder reads the whole sentence: "make me gravel" is near to gravel, and near to making.
//! So a prompt is read before it is encoded. It is [normalised](normalise()), a misspelling is corrected,
//! names of materials are found in it, the longest first, and of the other words those stay that say how
//! something feels. Only what is left is encoded. English only.
//!
//! ```
//! use asperity_language::{WordVectors, reading::Reader};
//!
//! /// Takes every word for English, and knows nothing about it.
//! struct NoTable;
//! impl WordVectors for NoTable {
//!     fn holds(&self, _: &str) -> bool { true }
//!     fn vector(&self, _: &str) -> Option<Vec<f32>> { None }
//! }
//!
//! let reader = Reader::new(NoTable);
//! let reading = reader.read("imported gravel from my grandmother");
//! assert_eq!(reading.names, ["gravel"]);
//! assert_eq!(reader.read("please, some very rough gravel").text(), "very rough gravel");
//! ```

mod closed_class;
mod description;
mod explained;
mod graphics;
mod parts;
mod read;
mod segment;
mod spelling;
mod word_sense;

pub use crate::lexicon::{in_one_word, key};
pub use crate::words::{Token, normalise, shown};
pub use closed_class::{is_colour, is_grammar};
pub use explained::Taken;
pub use spelling::Correction;

use crate::{
    WordVectors,
    phrase::{self, Phrase},
    words::{
        grade::{self, Grade, Note},
        singular, without_accents,
    },
};

/// What tells two readers apart: the CRC-32 of what is read of the prompts in `training/corpora/evaluation/`, and
/// of their grammar, which the test `judged::the_version_of_the_reader_follows_what_it_reads` computes.
pub const VERSION: &str = "d72512f2";

/// Words of a prompt that are read: several times what an encoder reads of them.
pub const MOST_WORDS: usize = 1024;

/// Reads prompts.
#[derive(Debug, Clone, Copy)]
pub struct Reader<T> {
    table: T,
}

/// What was read of a prompt.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reading {
    /// The names that it says, as the corpus spells them.
    pub names: Vec<String>,
    /// What is encoded: names, each as one, and the words that say how something feels.
    pub words: Vec<String>,
    /// What these are together.
    pub phrase: Phrase,
    /// Whether anything that is left names something, or says how it feels.
    pub says: bool,
    /// Words that were left out because they say nothing of touch.
    pub ignored: Vec<String>,
    /// A word that was misspelt.
    pub correction: Option<Correction>,
    /// What to tell of its numbers: those that are out of range, and those that may be read in two ways.
    pub numbers: Vec<String>,
    /// Two numbers of which only one can hold, the one that is taken last.
    pub conflict: Option<[Grade; 2]>,
    /// Words after the first [`MOST_WORDS`], which were not read.
    pub cut: usize,
}

impl Reading {
    /// The text that is encoded.
    #[must_use]
    pub fn text(&self) -> String {
        self.words.join(" ")
    }

    /// Whether any word of this text is encoded.
    #[must_use]
    pub fn holds(&self, text: &str) -> bool {
        let words = || self.words.iter().flat_map(|word| word.split(' '));
        text.split(' ')
            .any(|word| words().any(|said| singular(said) == singular(word)))
    }
}

impl<T: WordVectors> Reader<T> {
    /// A reader with a table of words.
    #[must_use]
    pub fn new(table: T) -> Self {
        Self { table }
    }

    /// Reads a prompt.
    #[must_use]
    pub fn read(&self, prompt: &str) -> Reading {
        let (prompt, mut gone) = graphics::described(prompt);
        let mut tokens = normalise(&prompt);
        let beyond = tokens.iter().skip(MOST_WORDS);
        let cut = beyond.filter(|token| **token != Token::Break).count();
        tokens.truncate(MOST_WORDS);
        let is_known = |word: &str| spelling::is_known(word, &self.table);
        graphics::divide(&mut tokens, &mut gone, is_known);
        let numbers = grade::notes(&mut tokens);
        gone.extend(numbers.iter().filter_map(Note::unread));
        let correction = spelling::correct(&mut tokens, &self.table);
        let items = segment::segment(&tokens, |word| word_sense::sense(&self.table, word));
        let items = parts::divide(items, &mut gone);
        // Code, paths and markup are no prose, even where a word of them is a name.
        let prose = !prompt.contains(['{', '}', '\\']);
        let mut reading = read::read(&items, prose);
        reading.ignored.append(&mut gone);
        reading.numbers = numbers.iter().map(Note::to_string).collect();
        if reading.words.is_empty() {
            // Signs alone: there is nothing to divide.
            let words = vec![shown(&prompt).trim().to_owned()];
            return Reading { words, ..reading };
        }
        // Where nothing is named, a word that no one knows may say anything.
        reading.says &= !reading.names.is_empty() || self.knows_all(&tokens);
        let phrase = phrase::parse(&reading.words);
        Reading {
            conflict: conflict(&phrase, &reading.words),
            phrase,
            correction,
            cut,
            ..reading
        }
    }

    /// Whether every word is English.
    fn knows_all(&self, tokens: &[Token]) -> bool {
        tokens.iter().all(|token| match token {
            Token::Word(word) => {
                // Of other letters, only those of micrometres are English.
                let foreign = |c: char| c.is_alphabetic() && !c.is_ascii() && c != 'μ';
                !without_accents(word).contains(foreign) && spelling::is_known(word, &self.table)
            }
            Token::Break => true,
        })
    }
}

/// The last number of one thing, and one before it that says otherwise.
fn conflict(phrase: &Phrase, words: &[String]) -> Option<[Grade; 2]> {
    if !matches!(phrase, Phrase::Graded { .. } | Phrase::Changed { .. }) {
        return None;
    }
    let grades: Vec<Grade> = words.iter().filter_map(|word| Grade::of(word)).collect();
    let pair = |(n, last): (usize, &Grade)| {
        let first = grades[..n].iter().find(|first| first.conflicts(*last))?;
        Some([*first, *last])
    };
    grades.iter().enumerate().rev().find_map(pair)
}
