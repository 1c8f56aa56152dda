//! A checked entry of a manifest.

use crate::{
    pipeline::Request,
    sources::{ManifestSource, latents::Edit},
};
use asperity_io::diagnostic::{Diagnostic, Fault};
use std::{fmt, path::Path, sync::Arc};

/// Where an entry stands.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct EntryLocation {
    /// The file.
    pub file: Arc<Path>,
    /// Line, 1-based.
    pub line: usize,
}

impl fmt::Display for EntryLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file.display(), self.line)
    }
}

impl EntryLocation {
    /// A fault in the same file.
    pub(super) fn fault(&self, line: usize, key: &str, fault: Fault) -> Fault {
        fault.at(&*self.file).line(line as u64).field(key)
    }
}

/// A texture that a library is to have.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Its name, unique in the library.
    pub name: String,
    /// Origin of the texture.
    pub origin: Origin,
    /// Build options.
    pub options: Options,
    /// Where it stands.
    pub location: EntryLocation,
}

impl Entry {
    /// Returns the fault of a texture that cannot be made.
    pub(crate) fn fault(&self, cause: &dyn Diagnostic) -> Fault {
        let field = format!("{:?}: {}", self.name, self.origin.key());
        let fault = Fault::new(cause, cause.remedy());
        self.location.fault(self.location.line, &field, fault)
    }
}

/// Origin of a texture. Textures of a checked manifest are referred to by index.
#[derive(Debug, Clone)]
pub enum Origin<R = usize> {
    /// A source of its own.
    Source {
        /// The key that names it.
        key: &'static str,
        /// The source.
        source: Arc<dyn ManifestSource>,
    },
    /// Another texture, to be edited.
    Of(R),
    /// Between two other textures.
    Blend {
        /// At t = 0.
        a: R,
        /// At t = 1.
        b: R,
        /// Where between them, 0..=1.
        t: f64,
    },
    /// Parts of other textures.
    Compose {
        /// Source of the tap response.
        tap: R,
        /// Source of the sliding vibration.
        slide: R,
        /// Where friction comes from.
        friction: R,
    },
}

impl<R> Origin<R> {
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

    /// Returns true if it needs the learned model.
    #[must_use]
    pub fn is_learned(&self) -> bool {
        match self {
            Self::Source { source, .. } => source.needs_model(),
            Self::Of(_) | Self::Blend { .. } | Self::Compose { .. } => true,
        }
    }

    /// The same with other references; `None` if one is not found. All are looked for.
    pub(super) fn try_map<S>(self, mut find: impl FnMut(R) -> Option<S>) -> Option<Origin<S>> {
        Some(match self {
            Self::Source { key, source } => Origin::Source { key, source },
            Self::Of(of) => Origin::Of(find(of)?),
            Self::Blend { a, b, t } => {
                let (a, b) = (find(a), find(b));
                Origin::Blend { a: a?, b: b?, t }
            }
            Self::Compose {
                tap,
                slide,
                friction,
            } => {
                let (tap, slide, friction) = (find(tap), find(slide), find(friction));
                Origin::Compose {
                    tap: tap?,
                    slide: slide?,
                    friction: friction?,
                }
            }
        })
    }
}

impl Origin {
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

/// Build options of a texture.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Options common to all textures.
    pub request: Request,
    /// True if the manifest states the fidelity; no budget changes it then.
    pub keeps_fidelity: bool,
    /// Edit applied to the decoded texture.
    pub edit: Edit,
}
