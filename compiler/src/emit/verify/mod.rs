//! The gate before an asset is written: the runtime itself renders it over its whole domain.

mod error;
mod queries;
mod spectra;
mod ticks;

pub use error::VerifyError;
pub use spectra::SPECTRUM_BUDGET_DB;

use crate::model::TextureModel;
use asperity_formats::Asset;
use asperity_runtime::HostTexture;
use serde::Serialize;

/// What verification found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VerifyReport {
    /// Queries of speed and force.
    pub queries: usize,
    /// Ticks of the scripted run.
    pub ticks: usize,
    /// Largest distance of a sounding vertex's rendered spectrum from its model, dB.
    pub max_db: f64,
    /// Largest reflection coefficient met, below 1.
    pub max_reflection: f64,
    /// Largest force of the scripted run, N.
    pub peak_force_n: f32,
}

/// Loads the asset into the runtime, queries it at vertices, on edges, over a grid, along the border,
/// beyond it, and at NaN and infinities, then runs it through a script of ticks.
///
/// `texture` is what the asset was made from.
///
/// # Errors
/// The first [`VerifyError`] met.
pub fn verify(texture: &TextureModel, bytes: &[u8]) -> Result<VerifyReport, VerifyError> {
    let asset = Asset::parse(bytes)?;
    let rate_hz = asset.grid().sample_rate_hz();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, rate_hz)?;
    let (queries, max_reflection) = queries::check(&slot, &texture.grid)?;
    let max_db = spectra::check(&slot, &texture.grid)?;
    let (ticks, peak_force_n) = ticks::check(&slot, rate_hz)?;
    Ok(VerifyReport {
        queries,
        ticks,
        max_db,
        max_reflection,
        peak_force_n,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};

    #[test]
    fn the_builtin_texture_passes() {
        let texture = builtin::texture();
        let report = verify(&texture, &lower(&texture, None).unwrap().bytes).unwrap();
        assert!(report.max_db < 0.1, "{report:?}");
        assert!(report.queries > 2000 && report.ticks > 1000);
        assert!(report.peak_force_n > 1.0);
    }

    #[test]
    fn an_asset_of_another_texture_is_refused() {
        let texture = builtin::texture();
        let mut other = texture.clone();
        other.grid.vertices[3].sigma_m_s2 *= 1.2;
        let bytes = lower(&other, None).unwrap().bytes;
        assert!(matches!(
            verify(&texture, &bytes),
            Err(VerifyError::Spectrum { vertex: 3, .. })
        ));
    }

    #[test]
    fn a_deafening_texture_is_refused() {
        let mut texture = builtin::texture();
        for vertex in &mut texture.grid.vertices {
            vertex.sigma_m_s2 *= 4_000.0;
        }
        let bytes = lower(&texture, None).unwrap().bytes;
        assert!(matches!(
            verify(&texture, &bytes),
            Err(VerifyError::Tick { .. })
        ));
    }
}
