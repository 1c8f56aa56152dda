//! Text before any model reads it: words in one form, and numbers with a meaning.

pub mod grade;
mod homoglyphs;
mod normalise;

pub use normalise::{Token, in_letters, normalise, shown};
pub(crate) use normalise::{singular, spelled, without_accents};
