//! Grammar of a prompt about a material: "very rough silk", "foam, but firmer", "between cork and felt".
//!
//! A text vector knows that rough silk is about silk, and hardly that it is rougher than silk.
//! So a prompt is divided: its base is what remains without the words that change it ("silk"),
//! and each change says in which direction roughness, slipperiness or hardness moves, and how far. English only;
//! whatever is not recognised is left to the text vector.
//!
//! ```
//! use asperity_language::phrase::{Phrase, parse};
//!
//! let words = ["very", "rough", "sandpaper"].map(String::from);
//! let Phrase::Changed { base, changes } = parse(&words) else { panic!("a material with a change") };
//! assert_eq!(base, "sandpaper");
//! assert!(changes.rough.is_some_and(|change| change.least > 0.0) && changes.hard.is_none());
//! ```

mod compound;
mod parse;
mod quality;
mod relative;
mod table;

use crate::words::grade::Grade;

pub use parse::{is_cover, parse};
pub use quality::{degree, is_adjective, is_degree, is_lasting, is_quality};
pub use relative::{Relative, Towards, relative};
pub(crate) use table::is_noun;
pub use table::quality_words;

/// Range for the change of an attribute relative to the base, in steps; half a step is noticeable.
///
/// The value from the text vector is kept where it lies within the range.
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
    /// Change of the vibration level.
    pub rough: Option<Change>,
    /// Change of the friction, downwards.
    pub slippery: Option<Change>,
    /// Change of the pitch of a tap.
    pub hard: Option<Change>,
}

/// A parsed prompt.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Phrase {
    /// A material, described by the text vector alone.
    #[default]
    Plain,
    /// A material with changes.
    Changed {
        /// The material without them.
        base: String,
        /// Changes to the base.
        changes: Changes,
    },
    /// A material with numbers for its roughness or hardness.
    Graded {
        /// The material without them.
        base: String,
        /// The grades, in their order; at least one.
        grades: Vec<Grade>,
    },
    /// An object made of a material: the material is stroked, and both are tapped.
    Made {
        /// Its material.
        material: String,
        /// The object.
        object: String,
    },
    /// A named part, which is as such parts are: "axe handle".
    Part {
        /// Its whole name.
        name: String,
        /// The part by itself.
        part: String,
    },
    /// Something between two materials.
    Between(String, String),
    /// An object with a cover: the cover is stroked, and both are tapped.
    Covered {
        /// The object inside.
        inside: String,
        /// The cover.
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
