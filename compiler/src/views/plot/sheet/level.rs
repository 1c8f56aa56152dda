//! Level of a model, and its colour.

use asperity_plot::{ColorMap, ColorScale};

use asperity_texture::model::GridVertex;

/// Standard deviation of the excitation times the gain, m/s².
pub(super) fn level(vertex: &GridVertex) -> f64 {
    vertex.gain * vertex.sigma_m_s2
}

/// A scale of colours from silence to the loudest vertex.
pub(super) fn level_scale(vertices: &[GridVertex]) -> ColorScale {
    let loudest = vertices
        .iter()
        .map(level)
        .filter(|level| level.is_finite())
        .fold(0.0, f64::max);
    ColorScale::new(ColorMap::Viridis, 0.0, loudest)
}
