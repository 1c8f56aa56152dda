//! Why a material did not become an asset.

use super::error::HattError;
use crate::{front_ends::learned::ModelError, pipeline::PipelineError};
use asperity_io::diagnostic::Diagnostic;
use std::{fmt, path::PathBuf};
use thiserror::Error;

/// Largest RMS log-spectral error of a vertex against its source, dB.
pub const BUDGET_DB: f64 = 0.5;

/// Why a file did not become an asset.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file was refused.
    #[error(transparent)]
    Hatt(#[from] HattError),
    /// The learned model could not decode the taps.
    #[error("{file}: taps: {cause}", file = file.display())]
    Complete {
        /// The file.
        file: PathBuf,
        /// What went wrong.
        cause: ModelError,
    },
    /// The texture did not pass the pipeline.
    #[error("{file}: {cause}", file = file.display(), cause = Stated(cause))]
    Pipeline {
        /// The file.
        file: PathBuf,
        /// The pass that failed.
        cause: PipelineError,
    },
}

impl Diagnostic for ImportError {
    fn remedy(&self) -> String {
        match self {
            Self::Hatt(error) => error.remedy(),
            Self::Complete { cause, .. } => cause.remedy(),
            Self::Pipeline { cause, .. } => cause.remedy(),
        }
    }
}

/// A failure of the pipeline, which of verification says so.
struct Stated<'a>(&'a PipelineError);

impl fmt::Display for Stated<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if matches!(self.0, PipelineError::Verify(_)) {
            f.write_str("verification failed: ")?;
        }
        self.0.fmt(f)
    }
}
