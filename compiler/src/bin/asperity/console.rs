//! Results on stdout, progress on a terminal.

use crate::failure::{Failures, one};
use asperity::output::OutputError;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
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

/// A progress bar on stderr where that is a terminal, else nothing.
pub(crate) fn progress(quiet: bool, steps: usize, what: &'static str) -> ProgressBar {
    let target = if quiet {
        ProgressDrawTarget::hidden()
    } else {
        // Hidden by itself where stderr is no terminal.
        ProgressDrawTarget::stderr()
    };
    let bar = ProgressBar::with_draw_target(Some(steps as u64), target);
    if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:32}] {pos}/{len} {eta}") {
        bar.set_style(style);
    }
    bar.with_message(what)
}
