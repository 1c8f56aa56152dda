//! Extraction of the tactile content of an English text, before any model reads it.
//!
//! | module | |
//! |---|---|
//! | `words` | a text as words in one form, and numbers with a scale |
//! | `lexicon` | names of things, what they are made of, qualities, words of grammar |
//! | `phrase` | qualities, materials and covers of what is named |
//! | `roles` | which words of a sentence say what is touched, by a small network |
//! | `reading` | what a text says is touched, as one phrase |
//! | `vocabulary` | sorted tables in the text of a file |
//!
//! Nothing here knows a texture, a text encoder or a file. A table of word vectors and the states of words inside an encoder
//! stand behind [`WordVectors`] and [`roles::WordStates`].
#![forbid(unsafe_code)]

pub mod lexicon;
pub mod phrase;
pub mod reading;
pub mod roles;
mod vocabulary;
pub mod words;

pub use vocabulary::Vocabulary;

/// Vectors of English words from a table made ahead of time.
pub trait WordVectors {
    /// Returns true if a word has a row, as it stands or without the ending of a plural or of a verb.
    fn holds(&self, word: &str) -> bool;

    /// The sum of the rows of a text's words, of length one and the same width for every text; `None` where none of
    /// them is in the table.
    fn vector(&self, text: &str) -> Option<Vec<f32>>;
}
