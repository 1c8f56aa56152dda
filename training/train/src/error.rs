//! Why a model cannot be trained.

use asperity_io::{
    diagnostic::{Diagnostic, Fault},
    output::OutputError,
};
use std::path::PathBuf;
use thiserror::Error;

/// Why a model cannot be trained.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FitError {
    /// Nothing to tell apart.
    #[error("{0} materials to train on, at least 2 are needed")]
    TooFewMaterials(usize),
    /// A material that cannot be trained on.
    #[error("material `{name}`: {field}")]
    Material {
        /// Its name.
        name: String,
        /// The field and its fault.
        field: &'static str,
    },
    /// A caption or phrase without a vector.
    #[error("caption \"{caption}\"")]
    Caption {
        /// The text.
        caption: String,
        /// Why.
        source: Box<Fault>,
    },
    /// A text encoder whose vectors are not as wide as it says.
    #[error("text encoder `{encoder}`: a vector of {found} numbers, it says {expected}")]
    Width {
        /// The encoder.
        encoder: String,
        /// Numbers it gave.
        found: usize,
        /// Numbers it announces.
        expected: usize,
    },
    /// The loss is no number any more.
    #[error("the loss is {loss} in epoch {epoch}")]
    Diverged {
        /// Epoch, from 1.
        epoch: usize,
        /// The loss.
        loss: f32,
    },
    /// Stopped by the user.
    #[error("interrupted after epoch {epoch}")]
    Interrupted {
        /// Epochs done.
        epoch: usize,
    },
    /// Kept text vectors that cannot be used.
    #[error("{}: {message}", path.display())]
    Vectors {
        /// The file.
        path: PathBuf,
        /// The problem.
        message: String,
    },
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A thread pool of this size cannot be made.
    #[error("{threads} threads: {message}")]
    Threads {
        /// The number.
        threads: usize,
        /// Why.
        message: String,
    },
}

impl Diagnostic for FitError {
    fn remedy(&self) -> String {
        match self {
            Self::TooFewMaterials(_) => "choose at least two materials of the corpus".into(),
            Self::Material { .. } => "correct the material's entry in the corpus".into(),
            Self::Caption { .. } => "correct the caption, or choose another text encoder".into(),
            Self::Width { .. } => "choose another text encoder".into(),
            Self::Diverged { .. } => "lower optimiser.learning_rate, or optimiser.clip_norm".into(),
            Self::Interrupted { .. } => "the same command starts anew".into(),
            Self::Vectors { .. } => "remove the file, or give another with --vectors".into(),
            Self::Output(error) => error.remedy(),
            Self::Threads { .. } => "give another number of --threads".into(),
        }
    }
}
