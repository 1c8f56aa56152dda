//! Failures that belong to no library.

use asperity_io::diagnostic::{Failures, Fault, one};

/// Failures whose text and remedy are known where they occur.
pub(crate) struct Plain;

impl Plain {
    pub(crate) fn failure(what: impl std::fmt::Display, remedy: impl Into<Box<str>>) -> Failures {
        one(Fault::new(what, remedy))
    }

    /// The command was called wrongly.
    pub(crate) fn usage(what: impl std::fmt::Display, remedy: impl Into<Box<str>>) -> Failures {
        one(Fault::new(what, remedy).usage())
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
