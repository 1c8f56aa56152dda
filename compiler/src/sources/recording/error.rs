//! What can go wrong between a folder and an asset.

use asperity_io::{diagnostic::Diagnostic, shown::counted};
use asperity_recording::RecordingError;
use std::path::PathBuf;
use thiserror::Error;

/// A recording that did not become a texture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecordingFailure {
    /// The files.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A fault that would end up in the texture.
    #[error("{}: {}, the first: {first}", folder.display(), counted(*count, "fault", "faults"))]
    Faulty {
        /// The folder.
        folder: PathBuf,
        /// How many.
        count: usize,
        /// The first fault.
        first: String,
        /// What to do.
        remedy: String,
    },
    /// Too few steady strokes.
    #[error("{}: {found_s:.1} s of steady strokes in {}; at least {least_s} s are needed", folder.display(), counted(*segments, "segment", "segments"))]
    TooFewStrokes {
        /// The folder.
        folder: PathBuf,
        /// Time of steady strokes, s.
        found_s: f64,
        /// Stretches.
        segments: usize,
        /// What is needed, s.
        least_s: f64,
    },
}

impl Diagnostic for RecordingFailure {
    fn remedy(&self) -> String {
        match self {
            Self::Recording(error) => error.remedy(),
            Self::Faulty { remedy, .. } => format!(
                "{remedy}; `asperity record-check` lists every fault, and --force imports regardless"
            ),
            Self::TooFewStrokes { .. } => {
                "stroke for a minute at many speeds and forces without stopping, as docs/recording.md explains"
                    .into()
            },
        }
    }
}
