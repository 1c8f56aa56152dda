//! One style for every failure that a user reads: what is wrong, then the remedy.

use std::{error::Error, fmt::Write as _};

/// An error that says what to do about it.
pub trait Diagnostic: Error {
    /// What the user can do, in one sentence.
    fn remedy(&self) -> String;

    /// Whether the command was called wrongly (exit status 2) rather than failed (1).
    fn is_usage(&self) -> bool {
        false
    }
}

/// The text that both commands print on stderr: `error: …`, `  help: …`.
#[must_use]
pub fn report(error: &dyn Diagnostic) -> String {
    let mut text = format!("error: {error}");
    let mut source = error.source();
    while let Some(cause) = source {
        // Writing to a string cannot fail.
        let _ = write!(text, ": {cause}");
        source = cause.source();
    }
    let _ = write!(text, "\n  help: {}", error.remedy());
    text
}
