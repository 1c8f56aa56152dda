//! Failures that belong to no library.

use asperity::diagnostic::Diagnostic;

/// A failure with its remedy.
pub(crate) type Failure = Box<dyn Diagnostic>;

/// An error whose text and remedy are known where it is met.
#[derive(Debug, thiserror::Error)]
#[error("{what}")]
pub(crate) struct Plain {
    what: String,
    remedy: String,
}

impl Plain {
    pub(crate) fn boxed(what: impl std::fmt::Display, remedy: impl Into<String>) -> Failure {
        Box::new(Self {
            what: what.to_string(),
            remedy: remedy.into(),
        })
    }
}

impl Diagnostic for Plain {
    fn remedy(&self) -> String {
        self.remedy.clone()
    }
}

/// For `map_err`: any failure that knows its remedy.
pub(crate) fn boxed<E: Diagnostic + 'static>(error: E) -> Failure {
    Box::new(error)
}
