//! Failures that belong to no library.

use asperity_io::diagnostic::{Diagnostic, Failures, one};

/// An error whose text and remedy are known where it occurs.
#[derive(Debug, thiserror::Error)]
#[error("{what}")]
pub(crate) struct Plain {
    what: String,
    remedy: String,
    is_usage: bool,
}

impl Plain {
    pub(crate) fn failure(what: impl std::fmt::Display, remedy: impl Into<String>) -> Failures {
        one(Self {
            what: what.to_string(),
            remedy: remedy.into(),
            is_usage: false,
        })
    }

    /// The command was called wrongly.
    pub(crate) fn usage(what: impl std::fmt::Display, remedy: impl Into<String>) -> Failures {
        one(Self {
            what: what.to_string(),
            remedy: remedy.into(),
            is_usage: true,
        })
    }
}

impl Diagnostic for Plain {
    fn remedy(&self) -> String {
        self.remedy.clone()
    }

    fn is_usage(&self) -> bool {
        self.is_usage
    }
}
