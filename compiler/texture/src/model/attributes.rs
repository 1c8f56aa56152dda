//! Objective attributes of a texture: what rough, sharp, hard and slippery mean here.

use crate::{
    model::{TextureModel, VertexKind},
    signal::spectrum::{ArmaModel, TraceBand, Vibration, VibrationBand},
};
use serde::Serialize;

/// Lowest rate of a trace whose centroid counts as hardness, Hz.
const MIN_TAP_RATE_HZ: f64 = 5000.0;

/// Objective attributes. An attribute is `None` where a texture does not define it, because it
/// has no taps, or no interior vertex that sounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Attributes {
    /// Mean over interior vertices of the level above 40 Hz, excitation included,
    /// before device gain, dB re 1 (m/s²)². Silent vertices do not count.
    pub rough_db: Option<f64>,
    /// Mean over the same of the power-weighted spectral centroid above 40 Hz, Hz.
    pub sharp_hz: Option<f64>,
    /// Power-weighted spectral centroid of the fastest trace, Hz.
    pub hard_hz: Option<f64>,
    /// Coefficient of kinetic friction; slipperiness is −μ.
    pub mu: f64,
}

/// The attributes of a texture.
#[must_use]
pub fn of(texture: &TextureModel) -> Attributes {
    Meter::default().of(texture)
}

/// Takes the attributes of one texture after the other. What depends on a sample rate alone is
/// computed when the rate changes.
#[derive(Debug, Clone, Default)]
pub struct Meter {
    /// The band of the last texture's models, by their rate.
    vibration: Option<(f64, Option<VibrationBand>)>,
    /// The band of the last texture's taps, by their rate.
    taps: Option<(f64, TraceBand)>,
}

impl Meter {
    /// The attributes of a texture.
    #[must_use]
    pub fn of(&mut self, texture: &TextureModel) -> Attributes {
        let rate_hz = texture.grid.sample_rate_hz;
        if self.vibration.as_ref().is_none_or(|(of, _)| *of != rate_hz) {
            self.vibration = Some((rate_hz, VibrationBand::new(rate_hz)));
        }
        let band = self.vibration.as_ref().and_then(|(_, band)| band.as_ref());
        let vibrations: Vec<Vibration> = texture
            .grid
            .vertices
            .iter()
            .filter(|vertex| vertex.kind == VertexKind::Interior)
            .filter_map(|vertex| {
                let model = ArmaModel::at_vertex(&texture.grid, vertex);
                band?.vibration(&model)
            })
            .collect();
        let mean = |value: fn(&Vibration) -> f64| {
            let sum: f64 = vibrations.iter().map(value).sum();
            (!vibrations.is_empty()).then(|| sum / vibrations.len() as f64)
        };
        Attributes {
            rough_db: mean(|v| 10.0 * libm::log10(v.power)),
            sharp_hz: mean(|v| v.centroid_hz),
            hard_hz: self.hard_hz(texture),
            mu: texture.friction.mu,
        }
    }

    fn hard_hz(&mut self, texture: &TextureModel) -> Option<f64> {
        let rate_hz = texture.taps.sample_rate_hz;
        let fastest = texture.taps.traces.last()?;
        if rate_hz.is_nan() || rate_hz < MIN_TAP_RATE_HZ {
            return None;
        }
        if self.taps.as_ref().is_none_or(|(of, _)| *of != rate_hz) {
            self.taps = Some((rate_hz, TraceBand::new(rate_hz)));
        }
        let (_, band) = self.taps.as_ref()?;
        band.centroid_hz(&fastest.accel_m_s2)
    }
}
