//! Why a learned model cannot be used.

use asperity_io::{diagnostic::Diagnostic, input::InputError};
use std::path::PathBuf;
use thiserror::Error;

/// Why a learned model cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A file of the folder is no file, too large, or not UTF-8.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A file of the folder cannot be read.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// I/O error.
        source: std::io::Error,
    },
    /// The description lacks something, or contradicts itself.
    #[error("{file}: {message}")]
    Description {
        /// The file.
        file: String,
        /// Field and fault.
        message: String,
    },
    /// A network cannot be loaded or run, or has unexpected inputs or outputs.
    #[error("{file}: {message}")]
    Network {
        /// The file.
        file: String,
        /// Error message.
        message: String,
    },
    /// A text vector of another width than the projection takes.
    #[error(
        "text_projection.onnx takes vectors of {expected} numbers, the text encoder gives {found}"
    )]
    Width {
        /// Width of the projection's input.
        expected: usize,
        /// Width of the vector.
        found: usize,
    },
}

impl Diagnostic for ModelError {
    fn remedy(&self) -> String {
        match self {
            Self::Input(error) => error.remedy(),
            Self::Unreadable { .. } => "give a folder that `asperity-train fit` wrote".into(),
            Self::Description { .. } | Self::Network { .. } => {
                "write the folder anew with `asperity-train fit`, or leave --model out for the embedded model".into()
            }
            Self::Width { .. } => {
                "train a projection for this encoder: asperity-train fit --text-encoder clip:DIR".into()
            }
        }
    }
}
