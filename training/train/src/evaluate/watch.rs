//! Progress and interruption of an evaluation.

use super::EvaluateError;
use crate::progress::{EpochLoss, Progress};

/// A listener to an evaluation.
pub trait Watch {
    /// Something begins that takes this many steps.
    fn begin(&mut self, what: &str, steps: usize);
    /// So many of its steps are done.
    fn done(&mut self, steps: usize);
    /// Returns true to stop.
    fn interrupted(&self) -> bool {
        false
    }
}

/// Gives up if asked to.
pub(super) fn pause(watch: &dyn Watch, what: &str) -> Result<(), EvaluateError> {
    if watch.interrupted() {
        return Err(EvaluateError::Interrupted { what: what.into() });
    }
    Ok(())
}

/// The training of a fold, watched.
pub(super) struct Training<'a> {
    watch: &'a mut dyn Watch,
    epochs: usize,
    text_epochs: usize,
}

impl<'a> Training<'a> {
    /// `text_epochs` counts those of the second stage.
    pub(super) fn begin(
        watch: &'a mut dyn Watch,
        what: &str,
        epochs: usize,
        text_epochs: usize,
    ) -> Self {
        watch.begin(what, epochs + text_epochs);
        Self {
            watch,
            epochs,
            text_epochs,
        }
    }
}

impl Progress for Training<'_> {
    fn epoch(&mut self, epoch: usize, _: usize, _: &EpochLoss) {
        self.watch.done(epoch);
    }

    fn text_epoch(&mut self, epoch: usize, epochs: usize, _: f32) {
        // The stage may count its steps otherwise than in epochs.
        let done = epoch * self.text_epochs / epochs.max(1);
        self.watch.done(self.epochs + done);
    }

    fn interrupted(&self) -> bool {
        self.watch.interrupted()
    }
}
