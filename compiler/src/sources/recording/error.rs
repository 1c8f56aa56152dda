//! Errors between a folder and an asset.

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
        /// Number of faults.
        count: usize,
        /// The first fault.
        first: String,
        /// Remedy for the first fault.
        remedy: String,
    },
    /// Too few strokes.
    #[error("{}: {found_s:.1} s of usable strokes in {}; at least {least_s} s are needed", folder.display(), counted(*segments, "segment", "segments"))]
    TooFewStrokes {
        /// The folder.
        folder: PathBuf,
        /// Time of usable strokes, s.
        found_s: f64,
        /// Stretches.
        segments: usize,
        /// Required time, s.
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
                "stroke for half a minute at many speeds and forces: a segment is 0.1 s or more of contact in which speed and force change by no more than a factor of four; docs/recording.md explains how to record"
                    .into()
            },
        }
    }
}
