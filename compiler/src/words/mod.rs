//! What a text says before any model reads it: its words in one form, and numbers with a meaning.

pub(crate) mod grade;
mod homoglyphs;
mod normalise;

pub use normalise::{Token, normalise, shown};
pub(crate) use normalise::{in_letters, singular, spelled, without_accents};
