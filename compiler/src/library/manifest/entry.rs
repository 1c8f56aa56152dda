//! A checked entry of a manifest.

use crate::{
    pipeline::Request,
    sources::{ManifestSource, latents::Edit},
};
use std::{fmt, path::Path, sync::Arc};

/// Where an entry stands.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file.
    pub file: Arc<Path>,
    /// Line, 1-based.
    pub line: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file.display(), self.line)
    }
}

/// A texture that a library is to have.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Its name, unique in the library.
    pub name: String,
    /// What it is made of.
    pub origin: Origin,
    /// How it is made.
    pub options: Options,
    /// Where it stands.
    pub place: Place,
}

/// What a texture is made of. Textures of the manifest are named by their index.
#[derive(Debug, Clone)]
pub enum Origin {
    /// A source of its own.
    Source {
        /// The key that names it.
        key: &'static str,
        /// The source.
        source: Arc<dyn ManifestSource>,
    },
    /// Another texture, to be edited.
    Of(usize),
    /// Between two other textures.
    Blend {
        /// At t = 0.
        a: usize,
        /// At t = 1.
        b: usize,
        /// Where between them, 0..=1.
        t: f64,
    },
    /// Parts of other textures.
    Compose {
        /// What tapping feels like.
        tap: usize,
        /// What sliding feels like.
        slide: usize,
        /// Where friction comes from.
        friction: usize,
    },
}

impl Origin {
    /// The key that a manifest states it under.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Source { key, .. } => key,
            Self::Of(_) => "of",
            Self::Blend { .. } => "blend",
            Self::Compose { .. } => "compose",
        }
    }

    /// Whether it needs the learned model.
    #[must_use]
    pub fn is_learned(&self) -> bool {
        match self {
            Self::Source { source, .. } => source.needs_model(),
            Self::Of(_) | Self::Blend { .. } | Self::Compose { .. } => true,
        }
    }

    /// The other textures that it is made of.
    #[must_use]
    pub fn parts(&self) -> Vec<usize> {
        match *self {
            Self::Of(of) => vec![of],
            Self::Blend { a, b, .. } => vec![a, b],
            Self::Compose {
                tap,
                slide,
                friction,
            } => vec![tap, slide, friction],
            Self::Source { .. } => Vec::new(),
        }
    }
}

/// How a texture is made.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// What is asked of any texture.
    pub request: Request,
    /// Whether the manifest states the fidelity, which no budget changes then.
    pub keeps_fidelity: bool,
    /// What is moved after it was decoded.
    pub edit: Edit,
}
