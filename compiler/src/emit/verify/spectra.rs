//! The spectra that the runtime renders at the vertices, against those of the model.

use super::error::VerifyError;
use asperity_runtime::{Filter, HostTexture};
use asperity_texture::{
    model::ModelGrid,
    signal::spectrum::{ArmaModel, ERROR_POINTS, ErrorBand},
};

/// Largest RMS log-spectral error of a vertex as the runtime renders it, dB.
pub const SPECTRUM_BUDGET_DB: f64 = 0.5;
/// Sound allowed where the model is silent, relative to the loudest vertex.
pub(super) const SILENCE_SHARE: f64 = 1e-4;

fn monic(coefficients: &[f32], order: usize) -> Vec<f64> {
    std::iter::once(1.0)
        .chain(coefficients.iter().take(order).map(|&c| f64::from(c)))
        .collect()
}

/// The runtime's filter as a model to compare.
fn rendered(grid: &ModelGrid, filter: &Filter) -> ArmaModel {
    ArmaModel {
        sample_rate_hz: grid.sample_rate_hz,
        a: monic(&filter.a, grid.order),
        b: monic(&filter.b, filter.b.len()),
        level_m_s2: f64::from(filter.level_m_s2),
    }
}

/// Returns the largest distance of a sounding vertex, dB.
///
/// # Errors
/// [`VerifyError::Spectrum`] with the vertex.
pub(super) fn check(slot: &HostTexture, grid: &ModelGrid) -> Result<f64, VerifyError> {
    let loudest = grid
        .vertices
        .iter()
        .fold(0.0, |m: f64, v| m.max(v.gain * v.sigma_m_s2));
    let band = ErrorBand::new(grid.sample_rate_hz, ERROR_POINTS);
    let mut max_db = 0.0_f64;
    for (index, vertex) in grid.vertices.iter().enumerate() {
        let filter = slot.filter_at(vertex.speed_mm_s as f32, vertex.force_n as f32);
        let found = rendered(grid, &filter);
        // Vertices at one position: the runtime may answer with any of them.
        let distance_db = grid
            .vertices
            .iter()
            .filter(|twin| twin.speed_mm_s == vertex.speed_mm_s && twin.force_n == vertex.force_n)
            .map(|twin| {
                let expected = ArmaModel::at_vertex(grid, twin);
                if expected.level_m_s2 <= SILENCE_SHARE * loudest {
                    let silent = found.level_m_s2 <= 2.0 * SILENCE_SHARE * loudest;
                    if silent { 0.0 } else { f64::INFINITY }
                } else {
                    band.distance_db(&expected, &found)
                }
            })
            .fold(f64::INFINITY, f64::min);
        if distance_db > SPECTRUM_BUDGET_DB {
            return Err(VerifyError::Spectrum {
                vertex: index,
                distance_db,
                budget_db: SPECTRUM_BUDGET_DB,
            });
        }
        max_db = max_db.max(distance_db);
    }
    Ok(max_db)
}
