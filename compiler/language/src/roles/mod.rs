//! Which words of a text say what is touched.

mod features;
mod tagger;

pub use features::{Flags, flags};
pub(crate) use tagger::tag;

use crate::words::Token;

/// States of words inside a text encoder.
pub trait WordStates {
    /// The state of each token, [`STATE`] numbers, of as many as are read from the beginning.
    fn states(&self, tokens: &[Token]) -> Vec<Vec<f32>>;
}

/// Numbers of a state.
pub const STATE: usize = 384;
/// Flags of a word.
pub const WIDTH: usize = 14;
/// Meaning of each flag.
pub const FLAGS: [&str; WIDTH] = [
    "mark",
    "name",
    "end of a name",
    "of several words",
    "substance",
    "quality",
    "quality of the lexicon",
    "degree",
    "grammar",
    "colour",
    "touch",
    "thing",
    "digits",
    "owner",
];

/// Role of a word in a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Nothing that is felt.
    Context,
    /// It says what is under the hand, and how it feels.
    Surface,
    /// An object that carries the surface, which is said beside it.
    Object,
    /// It says what is not there.
    Denied,
    /// An object that is moved over the surface.
    Tool,
}

impl Role {
    /// All, in the order of the tagger's outputs.
    pub const ALL: [Self; 5] = [
        Self::Context,
        Self::Surface,
        Self::Object,
        Self::Denied,
        Self::Tool,
    ];

    /// Its name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Context => "left out",
            Self::Surface => "surface",
            Self::Object => "object",
            Self::Denied => "denied",
            Self::Tool => "tool",
        }
    }
}
