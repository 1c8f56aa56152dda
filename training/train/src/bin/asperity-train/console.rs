//! Results on stdout, progress on a terminal, and the interrupt.

use asperity_console::{Console, NoHandler, on_interrupt};
use asperity_io::output::OutputError;
use asperity_train::{EpochLoss, Progress};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// The first interrupt lets an epoch end; the second ends the process.
///
/// # Errors
/// [`NoHandler`] where the system allows no further thread or file.
pub(crate) fn listen() -> Result<(), NoHandler> {
    on_interrupt(|| {
        if INTERRUPTED.swap(true, Ordering::SeqCst) {
            std::process::exit(130);
        }
    })
}

/// Returns true once an interrupt has come.
pub(crate) fn is_interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}

/// Writes a result. A reader that has gone away, as `head` does, is no failure.
pub(crate) fn print(text: &str) -> Result<(), OutputError> {
    Console::new(false).text(text)
}

/// A bar of so many steps on stderr, unless that is no terminal.
pub(crate) fn bar(quiet: bool, steps: usize) -> ProgressBar {
    let target = if quiet {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    };
    let bar = ProgressBar::with_draw_target(Some(steps as u64), target);
    let template = "{prefix} [{bar:24}] {pos}/{len} {eta}  {msg}";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}

/// A bar for each stage.
pub(crate) struct Bar {
    bar: ProgressBar,
    text: bool,
}

impl Bar {
    pub(crate) fn new(quiet: bool, epochs: usize) -> Self {
        Self {
            bar: bar(quiet, epochs).with_prefix("training"),
            text: false,
        }
    }

    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar {
    fn epoch(&mut self, epoch: usize, _: usize, loss: &EpochLoss) {
        self.bar.set_position(epoch as u64);
        self.bar.set_message(format!(
            "loss {:.4}  ar {:.4}  taps {:.4}  kl {:.1}  nce {:.3}  align {:.4}",
            loss.total, loss.ar, loss.taps, loss.kl, loss.contrastive, loss.alignment
        ));
    }

    fn text_epoch(&mut self, epoch: usize, epochs: usize, loss: f32) {
        if !self.text {
            self.text = true;
            self.bar.set_length(epochs as u64);
            self.bar.reset_eta();
            self.bar.set_prefix("text stage");
        }
        self.bar.set_position(epoch as u64);
        self.bar.set_message(format!("loss {loss:.4}"));
    }

    fn interrupted(&self) -> bool {
        is_interrupted()
    }
}
