//! The pictures of a comparison, each as SVG and PNG.

mod costs;
mod errors;
mod factors;
mod fidelity;
mod front;
mod held_out;
mod labels;
mod mark;
mod picture;
mod rows;

pub use picture::Picture;

use super::held_out::MethodSummary;
use super::measure::Results;
use asperity_plot::PlotError;

/// Every picture by the name of its file: `front`, `factors`, `held-out`, `fidelity`.
///
/// # Errors
/// [`PlotError`] of the encoder.
pub fn all(
    results: &Results,
    held_out: &[MethodSummary],
) -> Result<Vec<(&'static str, Picture)>, PlotError> {
    Ok(vec![
        ("front", front::draw(results)?),
        ("factors", factors::draw(results)?),
        ("held-out", held_out::draw(held_out)?),
        ("fidelity", fidelity::draw(results)?),
    ])
}
