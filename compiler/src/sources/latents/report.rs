//! Attributes in a line.

use super::scale::Scale;
use crate::edit_memory::{AXES, Axis};
use asperity_texture::model::attributes::Attributes;

/// The attributes in their units, and where they lie on their sliders, as
/// `rough 2.8 dB (71), …`.
#[must_use]
pub fn attributes_line(attributes: &Attributes, scale: &Scale) -> String {
    let one = |axis: Axis| {
        let Some(value) = axis.of(attributes) else {
            return format!("{} none", axis.name());
        };
        let place = scale.place(axis, attributes).unwrap_or(0.0);
        match axis {
            Axis::Rough => format!("rough {value:.1} dB ({place:.0})"),
            Axis::Sharp => format!("sharp {value:.1} Hz ({place:.0})"),
            Axis::Hard => format!("hard {value:.1} Hz ({place:.0})"),
            Axis::Slippery => format!("slippery μ {:.3} ({place:.0})", -value),
        }
    };
    AXES.map(one).join(", ")
}
