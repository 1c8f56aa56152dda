//! Slot capacities that a texture needs.

use crate::{
    capacity::{Capacity, HostCapacities},
    load_error::LoadError,
    stage::{tap::bank::TapBank, upsample::ticks_per_sample},
};
use asperity_formats::Asset;

/// Capacities that a texture needs at a servo rate, in the terms of [`Capacity`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Vertices of the grid.
    pub vertices: usize,
    /// Triangles of the grid.
    pub triangles: usize,
    /// Order of A(z).
    pub ar_order: usize,
    /// Order of B(z).
    pub ma_order: usize,
    /// Tap samples at the servo rate, all traces together.
    pub tap_samples: usize,
    /// Ticks that a sample of the models lasts.
    pub(super) ticks_per_sample: u8,
}

impl Needs {
    /// The needs of a validated asset.
    ///
    /// # Errors
    /// [`LoadError::Rate`] if the servo rate is not 1, 2, 3, … 20 times the models' rate.
    pub fn of(asset: &Asset<'_>, servo_rate_hz: f32) -> Result<Self, LoadError> {
        let grid = asset.grid();
        // Exact: a rate is a number that both sides were given, not one they measured.
        let ticks = ticks_per_sample(grid.sample_rate_hz(), servo_rate_hz);
        let ticks_per_sample = ticks.ok_or(LoadError::Rate {
            model_hz: grid.sample_rate_hz(),
            servo_hz: servo_rate_hz,
        })?;
        Ok(Self {
            vertices: grid.vertices().len(),
            triangles: grid.triangles().len(),
            ar_order: grid.ar_order(),
            ma_order: grid.ma_order(),
            tap_samples: TapBank::<HostCapacities>::needed(asset.taps(), servo_rate_hz),
            ticks_per_sample,
        })
    }

    /// Checks that a slot of capacities `S` has room.
    ///
    /// # Errors
    /// [`LoadError::Capacity`] names the first of which there is too little.
    pub fn fit<S: Capacity>(&self) -> Result<(), LoadError> {
        let fits = |field, found, capacity| {
            if found > capacity {
                return Err(LoadError::Capacity {
                    field,
                    found,
                    capacity,
                });
            }
            Ok(())
        };
        fits("vertices", self.vertices, S::VERTICES)?;
        fits("triangles", self.triangles, S::TRIANGLES)?;
        fits("ar_order", self.ar_order, S::AR_ORDER)?;
        fits("ma_order", self.ma_order, S::MA_ORDER)?;
        fits("tap samples", self.tap_samples, S::TAP_SAMPLES)
    }
}
