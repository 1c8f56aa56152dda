//! The sliders of an edit.

use super::scale::Axis;
use serde::{Deserialize, Serialize};

/// How far an edit moves each attribute, in steps of the [`Scale`](super::Scale); 0 keeps it.
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

    /// How far one attribute is moved.
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
    pub(super) fn along_mut(&mut self, axis: Axis) -> &mut f64 {
        match axis {
            Axis::Rough => &mut self.rougher,
            Axis::Sharp => &mut self.sharper,
            Axis::Hard => &mut self.harder,
            Axis::Slippery => &mut self.slipperier,
        }
    }

    /// Whether nothing is moved.
    #[must_use]
    pub fn are_still(&self) -> bool {
        *self == Self::default()
    }
}
