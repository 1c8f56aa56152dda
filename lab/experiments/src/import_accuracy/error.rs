//! Errors of the bench.

use asperity_io::diagnostic::{Diagnostic, Fault};
use thiserror::Error;

/// A bench that could not run.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportAccuracyError {
    /// A texture that the runtime cannot render.
    #[error("{name}: {what}")]
    Texture {
        /// Its name.
        name: String,
        /// The problem.
        what: String,
    },
    /// A file of the recording.
    #[error("the recording cannot be written ({0})")]
    Write(#[from] std::io::Error),
    /// The import, or the learned model, which textures are taken from.
    #[error(transparent)]
    Import(#[from] Fault),
}

impl Diagnostic for ImportAccuracyError {
    fn remedy(&self) -> String {
        match self {
            Self::Texture { .. } => "give another texture".into(),
            Self::Write(_) => "free space in the folder for temporary files".into(),
            Self::Import(error) => error.remedy(),
        }
    }
}
