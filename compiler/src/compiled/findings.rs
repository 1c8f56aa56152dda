//! What a source found besides its texture.

use super::Compiled;
use asperity_plot::PlotError;
use serde_json::Value;
use std::{any::Any, fmt};

/// What a source found, for those who ask.
pub trait Findings: Any + fmt::Debug + Send + Sync {
    /// The report for people, of one line or more.
    fn text(&self, compiled: &Compiled) -> String;

    /// The report for machines.
    fn json(&self, compiled: &Compiled) -> Value {
        compiled.figures()
    }

    /// A picture of what was found as PNG, if there is more to see than in the asset.
    ///
    /// # Errors
    /// [`PlotError`] if it cannot be drawn.
    fn sheet(&self, compiled: &Compiled) -> Result<Option<Vec<u8>>, PlotError> {
        let _ = compiled;
        Ok(None)
    }
}
