//! The sliders of an edit.

use asperity_texture::model::attributes::Attributes;
use serde::{Deserialize, Serialize};

/// An attribute that a slider moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// `rough_db`.
    Rough,
    /// `sharp_hz`.
    Sharp,
    /// `hard_hz`.
    Hard,
    /// −μ.
    Slippery,
}

/// All axes, in the order of reports.
pub const AXES: [Axis; 4] = [Axis::Rough, Axis::Sharp, Axis::Hard, Axis::Slippery];

impl Axis {
    /// The name that reports use.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rough => "rough",
            Self::Sharp => "sharp",
            Self::Hard => "hard",
            Self::Slippery => "slippery",
        }
    }

    /// The attribute in its own unit, −μ for the last.
    #[must_use]
    pub fn of(self, attributes: &Attributes) -> Option<f64> {
        match self {
            Self::Rough => attributes.rough_db,
            Self::Sharp => attributes.sharp_hz,
            Self::Hard => attributes.hard_hz,
            Self::Slippery => Some(-attributes.mu),
        }
    }

    /// The attribute's name in a model description.
    pub(crate) fn described(self) -> &'static str {
        match self {
            Self::Rough => "rough_db",
            Self::Sharp => "sharp_hz",
            Self::Hard => "hard_hz",
            Self::Slippery => "mu",
        }
    }
}

/// Change of each attribute, in steps of the [`Scale`](crate::sources::latents::Scale); 0 keeps it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sliders {
    /// Level of the vibration.
    #[serde(skip_serializing_if = "is_zero")]
    pub rougher: f64,
    /// Spectral centroid of the vibration.
    #[serde(skip_serializing_if = "is_zero")]
    pub sharper: f64,
    /// Spectral centroid of the fastest tap.
    #[serde(skip_serializing_if = "is_zero")]
    pub harder: f64,
    /// −μ.
    #[serde(skip_serializing_if = "is_zero")]
    pub slipperier: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

impl Sliders {
    /// Largest step of a slider.
    pub const LARGEST: f64 = 100.0;

    /// Returns the change of an attribute, in steps.
    #[must_use]
    pub fn along(&self, axis: Axis) -> f64 {
        match axis {
            Axis::Rough => self.rougher,
            Axis::Sharp => self.sharper,
            Axis::Hard => self.harder,
            Axis::Slippery => self.slipperier,
        }
    }

    /// The same, to be set.
    pub(crate) fn along_mut(&mut self, axis: Axis) -> &mut f64 {
        match axis {
            Axis::Rough => &mut self.rougher,
            Axis::Sharp => &mut self.sharper,
            Axis::Hard => &mut self.harder,
            Axis::Slippery => &mut self.slipperier,
        }
    }

    /// Returns true if all sliders are zero.
    #[must_use]
    pub fn are_still(&self) -> bool {
        *self == Self::default()
    }
}
