//! Why a network cannot be loaded.

use thiserror::Error;

use crate::discover::NotFound;

/// Why a network cannot be loaded.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// No library was found.
    #[error(transparent)]
    Library(#[from] NotFound),
    /// ONNX Runtime refuses the model.
    #[error("ONNX Runtime refuses the model: {0}")]
    Model(String),
    /// An input or output whose type is not one of our tensors.
    #[error(
        "{direction} `{name}` is {found}; tensors of float32, int64, int32, int8, uint8 and bool are supported"
    )]
    Port {
        /// `input` or `output`.
        direction: &'static str,
        /// Its name.
        name: String,
        /// Its type.
        found: String,
    },
}

impl LoadError {
    /// Returns the remedy: a step for the user, in one sentence.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Library(error) => error.remedy(),
            Self::Model(_) => "check the file, or install a newer onnxruntime".to_owned(),
            Self::Port { .. } => "export the model with float32 and integer ports".to_owned(),
        }
    }
}
