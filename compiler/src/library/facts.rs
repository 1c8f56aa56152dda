//! Reported figures of a texture; cached with its bytes.

use crate::learned::Certainty;
use crate::{driver::Compiled, passes::reduce::Fidelity};
use asperity_texture::model::attributes::Attributes;
use serde::{Deserialize, Serialize};

/// Figures of a texture.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Facts {
    /// Bytes that a runtime needs.
    pub haptic_bytes: usize,
    /// Level of the vibration, dB re 1 (m/s²)².
    pub rough_db: Option<f64>,
    /// Spectral centroid of the vibration, Hz.
    pub sharp_hz: Option<f64>,
    /// Spectral centroid of the fastest tap, Hz.
    pub hard_hz: Option<f64>,
    /// Coefficient of kinetic friction.
    pub mu: f64,
    /// Certainty of the prompt's interpretation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certainty_level: Option<Certainty>,
    /// The share of such prompts that came out right, 0..=1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certainty: Option<f64>,
    /// Largest spectral distance from the whole texture where the fidelity left something out, dB.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduced_db: Option<f64>,
    /// Factor that the auto-gain put on the vibration; 1 where it fits the device as it is.
    pub vibration_factor: f64,
    /// Warnings for the user.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

impl Facts {
    /// The figures of a compiled texture.
    #[must_use]
    pub fn of(compiled: &Compiled) -> Self {
        let Attributes {
            rough_db,
            sharp_hz,
            hard_hz,
            mu,
        } = compiled.attributes();
        let asked_s2_m = compiled.whole.gains.vib_s2_m;
        Self {
            haptic_bytes: compiled.lowered.haptic_bytes,
            rough_db,
            sharp_hz,
            hard_hz,
            mu,
            certainty_level: compiled.certainty,
            certainty: compiled.certainty.map(Certainty::share),
            reduced_db: (compiled.fidelity != Fidelity::Full)
                .then_some(compiled.reduction.worst_db),
            vibration_factor: if asked_s2_m > 0.0 {
                compiled.texture.gains.vib_s2_m / asked_s2_m
            } else {
                1.0
            },
            warnings: compiled.warnings.clone(),
        }
    }
}
