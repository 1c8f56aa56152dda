//! Positions between pixels, rounded so that every machine draws the same picture.

use tiny_skia::{Path, PathBuilder};

/// Rounds to 1/64 px, which hides differences in the last bits of a float.
pub(crate) fn snap(position: f32) -> f32 {
    (position * 64.0).round() / 64.0
}

/// The nearest pixel centre, where a thin line is sharp.
pub(crate) fn crisp(position: f32) -> f32 {
    position.floor() + 0.5
}

/// A closed path through the finite points, each snapped; `None` if nothing is left.
pub(crate) fn polygon(points: &[(f32, f32)]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for &(x, y) in points
        .iter()
        .filter(|(x, y)| x.is_finite() && y.is_finite())
    {
        if builder.is_empty() {
            builder.move_to(snap(x), snap(y));
        } else {
            builder.line_to(snap(x), snap(y));
        }
    }
    builder.close();
    builder.finish()
}
