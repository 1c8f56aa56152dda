//! What the grammar of a prompt says of a thing: "very rough silk", "foam, but firmer", "between
//! cork and felt".
//!
//! A text vector knows that rough silk is about silk, and hardly that it is rougher than silk.
//! So a prompt is divided: its base is what remains without the words that change it ("silk"),
//! and each change says where roughness, slipperiness or hardness goes, and how far. A
//! [`Shift`](asperity_texture::model::shift::Shift) moves the texture there. English only; whatever is not recognised stays with the text vector.

mod changed;
mod compound;
mod parse;
mod quality;
mod relative;
mod table;
mod words;

use crate::words::grade::Grade;

pub use changed::{STEP, changed, from_base};
pub use parse::{is_cover, parse};
pub use quality::{is_degree, is_lasting, is_quality};
pub use relative::{Relative, Towards, relative};

/// How far one attribute is to go from that of the base, in steps of [`STEP`].
///
/// What the text vector says by itself is kept where it lies within the range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// Least change, in steps; negative for less of the attribute.
    pub least: f64,
    /// Largest change, in steps, of the same sign.
    pub most: f64,
}

/// Changes of roughness, slipperiness and hardness.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Changes {
    /// Of the level of the vibration.
    pub rough: Option<Change>,
    /// Of the friction, downwards.
    pub slippery: Option<Change>,
    /// Of the pitch of a tap.
    pub hard: Option<Change>,
}

/// What a prompt says.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Phrase {
    /// A thing, for the text vector alone.
    #[default]
    Plain,
    /// A thing with changes.
    Changed {
        /// The thing without them.
        base: String,
        /// What changes.
        changes: Changes,
    },
    /// A thing with numbers that say how rough or hard it is.
    Graded {
        /// The thing without them.
        base: String,
        /// What they say, in their order; at least one.
        grades: Vec<Grade>,
    },
    /// A thing of a material, which is stroked; both are tapped.
    Made {
        /// What it is made of.
        material: String,
        /// What it is.
        object: String,
    },
    /// A named part, which is as such parts are: "axe handle".
    Part {
        /// Its whole name.
        name: String,
        /// The part by itself.
        part: String,
    },
    /// Something between two things.
    Between(String, String),
    /// A thing that is covered with another: the cover is stroked, and both are tapped.
    Covered {
        /// What is inside.
        inside: String,
        /// What is outside.
        cover: String,
    },
}

impl Phrase {
    /// The things that it names, unless it is one thing as a whole.
    #[must_use]
    pub fn things(&self) -> Vec<&str> {
        match self {
            Self::Plain => Vec::new(),
            Self::Changed { base, .. } | Self::Graded { base, .. } => vec![base],
            Self::Between(first, second) => vec![first, second],
            Self::Covered { inside, cover } => vec![inside, cover],
            Self::Made { material, object } => vec![material, object],
            Self::Part { part, .. } => vec![part],
        }
    }
}
