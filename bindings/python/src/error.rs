//! Failures as Python exceptions.

use asperity::{
    driver::Stopped, passes::rerate::RATE_RANGE_HZ, pipeline::PipelineError,
    sources::prompt::PromptError,
};
use asperity_io::diagnostic::{Diagnostic, Failures};
use pyo3::{exceptions::PyValueError, prelude::*};
use std::{error::Error, fmt::Display};

/// A failure and its remedy; Python raises it as an exception.
#[derive(Debug)]
pub(crate) struct Failure {
    class: &'static str,
    message: String,
    remedy: String,
}

impl Failure {
    /// A failure of the work itself.
    pub(crate) fn new(message: impl Display, remedy: impl Into<String>) -> Self {
        Self {
            class: "AsperityError",
            message: message.to_string(),
            remedy: remedy.into(),
        }
    }

    /// An argument that makes no sense.
    pub(crate) fn usage(message: impl Display, remedy: impl Into<String>) -> Self {
        Self {
            class: "UsageError",
            ..Self::new(message, remedy)
        }
    }

    /// A texture that a library does not have.
    pub(crate) fn no_such_texture(message: impl Display, remedy: impl Into<String>) -> Self {
        Self {
            class: "NoSuchTextureError",
            ..Self::new(message, remedy)
        }
    }

    /// This failure and one more, each with its remedy.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            message: format!(
                "{}\n  help: {}\n{}",
                self.message, self.remedy, other.message
            ),
            ..other
        }
    }

    /// The same failure, about this.
    pub(crate) fn about(self, what: impl Display) -> Self {
        Self {
            message: format!("{what}: {}", self.message),
            ..self
        }
    }
}

impl Failure {
    /// All that went wrong with one work.
    pub(crate) fn all(failures: Failures) -> Self {
        let mut failures = failures.iter().map(|failure| Self::of(&**failure));
        let first = failures.next();
        let first = first.unwrap_or_else(|| Self::new("it failed", "see what was printed"));
        failures.fold(first, Self::and)
    }
}

impl<E: Diagnostic> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::of(&error)
    }
}

impl Failure {
    fn of(error: &dyn Diagnostic) -> Self {
        let mut message = error.to_string();
        let mut source = error.source();
        while let Some(cause) = source {
            message = format!("{message}: {cause}");
            source = cause.source();
        }
        let (message, remedy) = (in_python(&message), in_python(&error.remedy()));
        if error.is_usage() {
            Self::usage(message, remedy)
        } else {
            Self::new(message, remedy)
        }
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| {
            let exception = py
                .import("asperity._errors")
                .and_then(|module| module.getattr(failure.class))
                .and_then(|class| class.call1((&failure.message, &failure.remedy)));
            match exception {
                Ok(exception) => Self::from_value(exception),
                // The package is incomplete; the message still counts.
                Err(_) => PyValueError::new_err(failure.message),
            }
        })
    }
}

/// A text with the options of the command as arguments: `--tap-speed` is `tap_speed`.
fn in_python(text: &str) -> String {
    let mut parts = text.split("--");
    let mut result = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        if !part.starts_with(|first: char| first.is_ascii_lowercase()) {
            result += "--";
        }
        let end = part.find(|c: char| c != '-' && !c.is_ascii_lowercase());
        let (option, rest) = part.split_at(end.unwrap_or(part.len()));
        result += &option.replace('-', "_");
        result += rest;
    }
    result
}

/// Reports why a source did not compile, rewording failures whose command-line text does not suit Python.
pub(crate) fn stopped(failure: asperity::driver::Failure) -> Failure {
    let error: &dyn Error = &*failure;
    if let Some(PromptError::Empty) = error.downcast_ref() {
        return Failure::usage(
            "prompt: it is empty",
            "describe a surface, e.g. asperity.compile(\"rough abrasive sheet\")",
        );
    }
    match error.downcast_ref() {
        Some(Stopped {
            origin,
            cause: PipelineError::Rate(rate_hz),
        }) => {
            let (least, most) = RATE_RANGE_HZ;
            let colon = if origin.is_empty() { "" } else { ": " };
            let message =
                format!("{origin}{colon}rate = {rate_hz} Hz: not in {least} to {most} Hz");
            Failure::usage(message, "give the rate of the servo loop, e.g. rate=1000")
        }
        _ => Failure::of(&*failure),
    }
}
