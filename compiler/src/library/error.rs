//! Why a library was not built.

use super::manifest::{Entry, Place};
use crate::learned::Certainty;
use asperity_formats::limits::MAX_NAME_BYTES;
use asperity_io::diagnostic::{Diagnostic, Failure};
use thiserror::Error;

/// Why a texture of a manifest could not be made.
#[derive(Debug, Error)]
#[error("{place}: {name:?}: {key}: {cause}")]
pub struct EntryError {
    /// Where it stands.
    pub place: Place,
    /// Its name.
    pub name: String,
    /// Key of its source.
    pub key: &'static str,
    /// The cause.
    pub cause: Failure,
}

impl EntryError {
    pub(crate) fn new(entry: &Entry, cause: Failure) -> Self {
        Self {
            place: entry.place.clone(),
            name: entry.name.clone(),
            key: entry.origin.key(),
            cause,
        }
    }
}

impl Diagnostic for EntryError {
    fn remedy(&self) -> String {
        self.cause.remedy()
    }
}

/// Why textures do not become a library.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LibraryFault {
    /// Some could not be made.
    #[error("no library was written: {failed} of {total} textures failed, the others are {kept}")]
    Unfinished {
        /// Textures that failed.
        failed: usize,
        /// All textures.
        total: usize,
        /// Where the others are.
        kept: &'static str,
    },
    /// A prompt is less certain than is asked for.
    #[error("the certainty of the prompt is {found:?}, but --min-certainty requires {least:?}", found = found.to_string(), least = least.to_string())]
    Unsure {
        /// Certainty of the prompt.
        found: Certainty,
        /// Required certainty.
        least: Certainty,
    },
    /// A temporary file does not take more.
    #[error("the texture cannot be stored until the library is written: {0}")]
    NoRoom(String),
    /// Two libraries have textures of one name that differ.
    #[error("{name:?} is in both {first} and {second}, but with different contents")]
    Differ {
        /// The name.
        name: String,
        /// The library that was given first.
        first: String,
        /// The other one.
        second: String,
    },
    /// A library with a scene.
    #[error("{0}: a library with a scene cannot be changed")]
    Scene(String),
    /// An asset where a library is wanted.
    #[error("{0}: an asset, not a library")]
    NoLibrary(String),
    /// There is a texture of that name.
    #[error("{file}: there is already a texture {name:?}")]
    Taken {
        /// The library.
        file: String,
        /// The name.
        name: String,
    },
    /// A name that no texture can have.
    #[error("{0:?} is not a valid name: a name has 1 to 64 bytes and no control characters")]
    Name(String),
}

/// Refuses a name that no texture can have.
///
/// # Errors
/// [`LibraryFault::Name`].
pub fn check_name(name: &str) -> Result<(), LibraryFault> {
    if name.is_empty() || name.len() > MAX_NAME_BYTES || name.chars().any(char::is_control) {
        return Err(LibraryFault::Name(name.to_owned()));
    }
    Ok(())
}

impl Diagnostic for LibraryFault {
    fn remedy(&self) -> String {
        match self {
            Self::Unfinished { .. } => {
                "correct the textures that failed and build again: only they are compiled then".into()
            }
            Self::Unsure { .. } => {
                "name a material, or see how the prompt is read with `asperity compile PROMPT -o FILE --explain`"
                    .into()
            }
            Self::NoRoom(_) => {
                "free space beside the output, or in the folder for temporary files if it is `-`"
                    .into()
            }
            Self::Differ { .. } => {
                "rename one of them with `asperity rename`, or build all shards with one version and model"
                    .into()
            }
            Self::Scene(_) => "change its manifest, and build it again with `asperity build`".into(),
            Self::NoLibrary(_) => "give a library (.aspl)".into(),
            Self::Taken { .. } | Self::Name(_) => "choose another name".into(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::Name(_))
    }
}
