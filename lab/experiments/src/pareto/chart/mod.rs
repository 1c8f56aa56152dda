//! The pictures of a comparison, each as SVG and PNG.

mod costs;
mod errors;
mod factors;
mod fidelity;
mod front;
mod labels;
mod mark;
mod picture;

pub use picture::Picture;

use super::measure::Results;
use asperity_plot::PlotError;

/// Every picture by the name of its file: `front`, `factors`, `fidelity`.
///
/// # Errors
/// [`PlotError`] of the encoder.
pub fn all(results: &Results) -> Result<Vec<(&'static str, Picture)>, PlotError> {
    Ok(vec![
        ("front", front::draw(results)?),
        ("factors", factors::draw(results)?),
        ("fidelity", fidelity::draw(results)?),
    ])
}
