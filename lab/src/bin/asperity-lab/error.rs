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

/// Every failure of what was done in turn, each whatever became of the others: a result is printed
/// though its files cannot be written.
pub(crate) fn all(done: impl IntoIterator<Item = Result<(), Failures>>) -> Result<(), Failures> {
    let failures: Failures = done.into_iter().filter_map(Result::err).flatten().collect();
    if failures.is_empty() {
        Ok(())
    } else {
        Err(failures)
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
