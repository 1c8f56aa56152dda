//! What a text says before any model reads it: its words in one form, and numbers with a meaning.

pub(crate) mod grade;
mod normalise;

pub(crate) use normalise::singular;
pub use normalise::{Token, normalise, shown};
