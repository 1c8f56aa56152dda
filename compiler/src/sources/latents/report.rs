//! Attributes in a line.

use super::scale::Scale;
use crate::edit_memory::{AXES, Axis};
use asperity_io::shown::rounded;
use asperity_texture::model::attributes::Attributes;

/// The attributes in their units, and where they lie on their sliders, as
/// `rough 2.8 dB (71), …`.
#[must_use]
pub fn attributes_line(attributes: &Attributes, scale: &Scale) -> String {
    let one = |axis: Axis| {
        let Some(value) = axis.of(attributes) else {
            return format!("{} none", axis.name());
        };
        let place = rounded(scale.place(axis, attributes).unwrap_or(0.0), 0);
        match axis {
            Axis::Rough => format!("rough {place:.0} ({value:.1} dB)"),
            Axis::Sharp => format!("sharp {place:.0} ({value:.0} Hz)"),
            Axis::Hard => format!("hard {place:.0} ({value:.0} Hz)"),
            Axis::Slippery => format!("slippery {place:.0} (μ {:.3})", -value),
        }
    };
    AXES.map(one).join(", ")
}
