//! The pictures of a comparison.

mod contact;
mod costs;
mod errors;
mod factors;
mod fidelity;
mod front;
mod labels;
mod mark;

use super::measure::Results;
use asperity_plot::PlotError;

/// The PNG of every picture, by the name of its file; without counts, that of contact laws is left out.
///
/// # Errors
/// [`PlotError`] of the encoder.
pub fn all(results: &Results) -> Result<Vec<(&'static str, Vec<u8>)>, PlotError> {
    let mut pictures = vec![
        ("front.png", front::draw(results)?),
        ("factors.png", factors::draw(results)?),
        ("fidelity.png", fidelity::draw(results)?),
    ];
    let contact = contact::draw(&results.contact)?;
    pictures.extend(contact.map(|picture| ("contact.png", picture)));
    Ok(pictures)
}
