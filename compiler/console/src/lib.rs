//! Console output of a command: results on standard output, all else on standard error.
//!
//! Nothing here fails or panics because a reader has gone away.

mod interrupt;
pub mod manual;
pub mod progress;
mod threads;

pub use interrupt::{NoHandler, clean_up_on_interrupt, on_interrupt};
pub use threads::share_work;

use asperity_io::{
    diagnostic::{Failures, report},
    output::{OutputError, Outputs},
    shown::{excerpt, plain},
};
use clap::Parser;
use indicatif::ProgressBar;
use std::{
    fmt::Display,
    io::{self, Write},
    process::ExitCode,
};

/// Warnings of one kind that are printed one by one.
const SHOWN_WARNINGS: usize = 20;

/// The console of one command.
#[derive(Debug, Clone, Copy)]
pub struct Console {
    quiet: bool,
    results_on_stderr: bool,
}

impl Console {
    /// A console that shows progress on a terminal, and reports what was written, unless it is
    /// quiet.
    #[must_use]
    pub fn new(quiet: bool) -> Self {
        Self {
            quiet,
            results_on_stderr: false,
        }
    }

    /// The same, with results on standard error if one of the outputs goes to standard output.
    #[must_use]
    pub fn beside(self, outputs: &Outputs) -> Self {
        Self {
            results_on_stderr: self.results_on_stderr || outputs.to_standard_output(),
            ..self
        }
    }

    /// Writes a result for people. Control characters from names and notes are escaped.
    ///
    /// # Errors
    /// [`OutputError`] for a result that is lost. A reader that has gone away, as `head` does, is
    /// no failure.
    pub fn text(&self, text: &str) -> Result<(), OutputError> {
        self.print(&plain(text))
    }

    /// Writes what a command did, such as how large a file became: a quiet console does not. What
    /// was asked for is [`text`](Self::text).
    ///
    /// # Errors
    /// As [`text`](Self::text).
    pub fn report(&self, text: &str) -> Result<(), OutputError> {
        if self.quiet {
            return Ok(());
        }
        self.text(text)
    }

    /// Writes a result that may have gone into files, too: a [`report`](Self::report) where it has,
    /// else all that was asked for.
    ///
    /// # Errors
    /// As [`text`](Self::text).
    pub fn result_of(&self, wrote: bool, text: &str) -> Result<(), OutputError> {
        if wrote {
            self.report(text)
        } else {
            self.text(text)
        }
    }

    /// Writes a result for programs as it is, and a line break.
    ///
    /// # Errors
    /// As [`text`](Self::text).
    pub fn json(&self, json: &impl Display) -> Result<(), OutputError> {
        self.print(&format!("{json:#}\n"))
    }

    /// Writes a part of a JSON text that no memory should hold as a whole.
    ///
    /// # Errors
    /// As [`text`](Self::text).
    pub fn json_part(&self, text: &str) -> Result<(), OutputError> {
        self.print(text)
    }

    fn print(&self, text: &str) -> Result<(), OutputError> {
        let (stream, printed) = if self.results_on_stderr {
            ("standard error", send(io::stderr().lock(), text))
        } else {
            ("standard output", send(io::stdout().lock(), text))
        };
        printed.map_err(|source| OutputError {
            path: stream.into(),
            doing: "cannot print the result",
            source,
        })
    }

    /// Tells what a user should know besides the result.
    pub fn warn(&self, warning: &str) {
        note(&format!("warning: {}\n", excerpt(&plain(warning))));
    }

    /// Tells the warnings of a result, of which the JSON of that result holds all. Where that JSON
    /// takes standard error, it is left alone there, so that a program can read it.
    pub fn warnings(&self, warnings: &[String], in_json: bool) {
        if in_json && self.results_on_stderr {
            return;
        }
        for warning in warnings {
            self.warn(warning);
        }
    }

    /// Tells the first of many warnings, and how many there are.
    pub fn warn_of_many(&self, warnings: &[String]) {
        let shown = warnings.len().min(SHOWN_WARNINGS);
        self.warnings(&warnings[..shown], false);
        if shown < warnings.len() {
            self.warn(&format!("{} more of these", warnings.len() - shown));
        }
    }

    /// Prints a figure on standard error, such as how long each pass took.
    pub fn aside(&self, text: &impl Display) {
        note(&text.to_string());
    }

    /// A progress bar on standard error where that is a terminal, else nothing.
    #[must_use]
    pub fn bar(&self, steps: usize, what: &'static str) -> ProgressBar {
        progress::bar(self.quiet, steps, what)
    }

    /// A progress bar with rate and time left, where [`bar`](Self::bar) has one.
    #[must_use]
    pub fn rated_bar(&self, steps: usize, what: &'static str) -> ProgressBar {
        progress::rated_bar(self.quiet, steps, what)
    }

    /// Shows the current activity on standard error where that is a terminal; else shows nothing.
    #[must_use]
    pub fn activity(&self) -> ProgressBar {
        progress::activity(self.quiet)
    }
}

/// The arguments of a command. Wrong usage is said on standard error, and ends the process with
/// status 2; help and version end it with 0.
#[must_use]
pub fn arguments<C: Parser>() -> C {
    C::try_parse().unwrap_or_else(|error| {
        if error.use_stderr() {
            // What a user typed is repeated, which may be a file's content.
            note(&excerpt(&plain(&error.to_string())));
            std::process::exit(error.exit_code());
        }
        error.exit()
    })
}

/// Says why a command failed. The status is 0 for success, 2 for wrong usage and 1 for any other
/// failure.
#[must_use]
pub fn finish(result: Result<(), Failures>) -> ExitCode {
    let Err(failures) = result else {
        return ExitCode::SUCCESS;
    };
    for failure in &failures {
        note(&format!("{}\n", report(failure.as_ref())));
    }
    if failures.iter().any(|failure| failure.is_usage()) {
        ExitCode::from(2)
    } else {
        ExitCode::FAILURE
    }
}

/// Prints on standard error. Where that is gone, nobody can be told.
fn note(text: &str) {
    let _ = send(io::stderr().lock(), text);
}

fn send(mut stream: impl Write, text: &str) -> io::Result<()> {
    let sent = stream
        .write_all(text.as_bytes())
        .and_then(|()| stream.flush());
    match sent {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error),
        _ => Ok(()),
    }
}
