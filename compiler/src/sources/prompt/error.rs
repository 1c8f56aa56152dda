//! Why a prompt gave no texture.

use asperity_io::diagnostic::{Diagnostic, Fault};
use thiserror::Error;

/// Why a prompt gave no texture.
#[derive(Debug, Error)]
pub enum PromptError {
    /// There is nothing to go by.
    #[error("the prompt is empty")]
    Empty,
    /// The text encoder or the learned model failed.
    #[error(transparent)]
    Fault(#[from] Fault),
}

impl Diagnostic for PromptError {
    fn remedy(&self) -> String {
        match self {
            Self::Empty => "describe a surface, such as \"rough abrasive sheet\"".into(),
            Self::Fault(fault) => fault.remedy(),
        }
    }

    fn is_usage(&self) -> bool {
        matches!(self, Self::Empty)
    }
}

impl From<PromptError> for Fault {
    fn from(error: PromptError) -> Self {
        Self::of(&error)
    }
}

/// For `map_err`: a text that its encoder does not read.
pub(super) fn unread(fault: Fault) -> Fault {
    Fault {
        remedy: "try `asperity doctor`, or leave --text-encoder out".into(),
        ..fault
    }
}
