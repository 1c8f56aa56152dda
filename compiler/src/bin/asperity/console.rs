//! Results on stdout.

use crate::failure::{Failures, one};
use asperity::{output::OutputError, pipeline::Timings};
use std::io::{self, Write as _};

/// Writes a result. A reader that has gone away, as `head` does, is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failures> {
    let mut stdout = io::stdout().lock();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    match written {
        Err(source) if source.kind() != io::ErrorKind::BrokenPipe => Err(one(OutputError {
            path: "stdout".into(),
            doing: "cannot print the result",
            source,
        })),
        _ => Ok(()),
    }
}

/// Prints how long each pass took, where that was asked for.
pub(crate) fn print_timings(wanted: bool, timings: &Timings) {
    if wanted {
        eprint!("{timings}");
    }
}
