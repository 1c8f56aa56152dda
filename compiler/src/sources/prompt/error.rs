//! Why a prompt gave no texture.

use crate::learned::{ModelError, text::TextError};
use asperity_io::diagnostic::Diagnostic;
use thiserror::Error;

/// Why a prompt gave no texture.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PromptError {
    /// There is nothing to go by.
    #[error("the prompt is empty")]
    Empty,
    /// The text encoder failed.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The learned model failed.
    #[error(transparent)]
    Model(#[from] ModelError),
}

impl Diagnostic for PromptError {
    fn remedy(&self) -> String {
        match self {
            Self::Empty => "describe a surface, such as \"rough abrasive sheet\"".into(),
            Self::Text(_) => "try `asperity doctor`, or leave --text-encoder out".into(),
            Self::Model(error) => error.remedy(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::Empty)
    }
}
