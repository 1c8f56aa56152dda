//! Failures that belong to no library, and printing.

use std::io::{self, Write as _};

use asperity::diagnostic::Diagnostic;

/// A failure with its remedy.
pub(crate) type Failure = Box<dyn Diagnostic>;

/// An error whose text and remedy are known where it occurs.
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

/// A failure of the libraries.
pub(crate) fn boxed<E: Diagnostic + 'static>(error: E) -> Failure {
    Box::new(error)
}

/// Prints results. A closed pipe is not a failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Plain::boxed(
            format!("stdout: {error}"),
            "check where the output goes",
        )),
        _ => Ok(()),
    }
}
