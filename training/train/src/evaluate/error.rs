//! Why a model cannot be evaluated.

use crate::{config::ConfigError, error::FitError};
use asperity_corpus::CorpusError;
use asperity_io::{
    diagnostic::{Diagnostic, Fault},
    output::OutputError,
};
use asperity_plot::PlotError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a model cannot be evaluated.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum EvaluateError {
    /// The model folder is none.
    #[error(transparent)]
    Model(#[from] Fault),
    /// The corpus cannot be loaded.
    #[error(transparent)]
    Corpus(#[from] CorpusError),
    /// The configuration of the folds is none.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A fold cannot be trained.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Model and corpus, or model and text encoder, do not belong together.
    #[error("model.json: {field} is {model}, the given one has {given}")]
    Mismatch {
        /// The field.
        field: &'static str,
        /// The model's value.
        model: String,
        /// The given value.
        given: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// A file of the folder that only the evaluation reads.
    #[error("{}: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// The committed prompts are no such list.
    #[error("{file}: {message}")]
    Prompts {
        /// The file.
        file: &'static str,
        /// Where and what.
        message: String,
    },
    /// Too few materials for the folds.
    #[error("{folds} folds over {count} {what}")]
    Folds {
        /// Folds asked for.
        folds: usize,
        /// Number of items to divide.
        count: usize,
        /// Their kind.
        what: &'static str,
    },
    /// A result that is no JSON.
    #[error("{file}: {message}")]
    Encode {
        /// The file.
        file: String,
        /// Why.
        message: String,
    },
    /// A picture cannot be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// The report cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Stopped by the user; what is finished is kept.
    #[error("interrupted in: {what}")]
    Interrupted {
        /// The interrupted task.
        what: String,
    },
}

impl Diagnostic for EvaluateError {
    fn remedy(&self) -> String {
        match self {
            Self::Model(error) => error.remedy(),
            Self::Corpus(error) => error.remedy(),
            Self::Config(error) => error.remedy(),
            Self::Fit(error) => error.remedy(),
            Self::Mismatch { remedy, .. } => (*remedy).into(),
            Self::Unreadable { .. } => "give a folder that `asperity-train fit` wrote".into(),
            Self::Prompts { .. } => "correct the entry; the file's head states its form".into(),
            Self::Folds { .. } => "give --folds from 2 to the number of families".into(),
            Self::Encode { .. } => "report it: a number of the evaluation is not finite".into(),
            Self::Plot(_) => "report it: a picture of the evaluation failed".into(),
            Self::Output(error) => error.remedy(),
            Self::Interrupted { .. } => {
                "the same command goes on from the last finished part".into()
            }
        }
    }

    fn is_usage(&self) -> bool {
        match self {
            Self::Config(error) => error.is_usage(),
            Self::Folds { .. } => true,
            _ => false,
        }
    }
}
