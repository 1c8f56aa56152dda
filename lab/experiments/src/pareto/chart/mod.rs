//! The pictures of a comparison.

mod costs;
mod errors;
mod factors;
mod fidelity;
mod front;
mod labels;
mod mark;

use super::measure::Results;
use asperity_plot::PlotError;

/// The PNG of every picture, by the name of its file.
///
/// # Errors
/// [`PlotError`] of the encoder.
pub fn all(results: &Results) -> Result<Vec<(&'static str, Vec<u8>)>, PlotError> {
    Ok(vec![
        ("front.png", front::draw(results)?),
        ("factors.png", factors::draw(results)?),
        ("fidelity.png", fidelity::draw(results)?),
    ])
}
