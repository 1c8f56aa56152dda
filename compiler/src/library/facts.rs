//! What a report says of a texture besides its bytes; cached with them.

use crate::model::{TextureModel, attributes::Attributes};
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
    /// Certainty of a prompt, 0..=1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certainty: Option<f64>,
    /// Factor that the auto-gain put on the vibration; 1 where it fits the device as it is.
    pub vibration_factor: f64,
    /// What a user should be told.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

impl Facts {
    /// The figures of a texture with these attributes, whose vibration gain was `asked_s2_m` before
    /// the auto-gain.
    #[must_use]
    pub fn of(
        texture: &TextureModel,
        attributes: &Attributes,
        haptic_bytes: usize,
        asked_s2_m: f64,
    ) -> Self {
        Self {
            haptic_bytes,
            rough_db: attributes.rough_db,
            sharp_hz: attributes.sharp_hz,
            hard_hz: attributes.hard_hz,
            mu: attributes.mu,
            certainty: None,
            vibration_factor: if asked_s2_m > 0.0 {
                texture.gains.vib_s2_m / asked_s2_m
            } else {
                1.0
            },
            warnings: Vec::new(),
        }
    }
}
