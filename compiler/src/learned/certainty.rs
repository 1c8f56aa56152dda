//! Certainty of a prompt's interpretation, and how often such prompts come out right.

use serde::{Deserialize, Serialize};
use std::{
    fmt::{self, Display, Formatter},
    str::FromStr,
};

/// Certainty of a prompt's interpretation, least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Certainty {
    /// Nothing is touched in it.
    NoContact,
    /// Nothing in it is known, or says how something feels.
    Guess,
    /// It is put together of what is known, or near to it.
    Close,
    /// It has a name that the model knows, with qualities or numbers at most.
    Known,
}

impl Certainty {
    /// The share of sentences of this level, of three writers, that feel like what is touched in them, 0..=1 (`docs/words.md`;
    /// `compiler/tests/prompts/sentences.rs` measures it).
    #[must_use]
    pub const fn share(self) -> f64 {
        match self {
            Self::Known => 0.92,
            Self::Close => 0.70,
            Self::Guess => 0.45,
            Self::NoContact => 0.0,
        }
    }
}

impl FromStr for Certainty {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let all = [Self::NoContact, Self::Guess, Self::Close, Self::Known];
        all.into_iter()
            .find(|level| level.to_string() == text)
            .ok_or(())
    }
}

impl Display for Certainty {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Guess => "guess",
            Self::NoContact => "no_contact",
            Self::Close => "close",
            Self::Known => "known",
        })
    }
}
