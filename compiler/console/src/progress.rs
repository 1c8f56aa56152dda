//! Progress on a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A progress bar on stderr where that is a terminal, else nothing.
#[must_use]
pub fn bar(quiet: bool, steps: usize, what: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(steps as u64), target(quiet));
    if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:32}] {pos}/{len} {eta}") {
        bar.set_style(style);
    }
    bar.with_message(what)
}

/// A progress bar with rate and time left, on stderr where that is a terminal, else nothing.
#[must_use]
pub fn rated_bar(quiet: bool, steps: usize, what: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(steps as u64), target(quiet));
    let template = "{msg} [{bar:32}] {pos}/{len} {per_sec}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.with_message(what)
}

/// A line on stderr that says what is being done, where that is a terminal, else nothing.
#[must_use]
pub fn activity(quiet: bool) -> ProgressBar {
    let line = ProgressBar::with_draw_target(None, target(quiet));
    if let Ok(style) = ProgressStyle::with_template("{msg} …") {
        line.set_style(style);
    }
    line
}

fn target(quiet: bool) -> ProgressDrawTarget {
    if quiet {
        ProgressDrawTarget::hidden()
    } else {
        // Hidden by itself where stderr is no terminal.
        ProgressDrawTarget::stderr()
    }
}
