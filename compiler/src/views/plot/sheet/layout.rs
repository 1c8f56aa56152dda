//! Margins and ranges that several panels have in common.

use asperity_plot::Margins;

use asperity_texture::model::GridVertex;

/// Margins with room for a legend between title and frame.
pub(super) fn margins(right: f32) -> Margins {
    Margins {
        top: 96.0,
        right,
        ..Margins::default()
    }
}

/// Highest speed (mm/s) and force (N) of the grid.
pub(super) fn reach(vertices: &[GridVertex]) -> (f64, f64) {
    let highest = |value: fn(&GridVertex) -> f64| vertices.iter().map(value).fold(0.0, f64::max);
    (
        highest(|vertex| vertex.speed_mm_s),
        highest(|vertex| vertex.force_n),
    )
}
