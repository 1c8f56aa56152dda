//! The unified speed–force grid that all materials of a corpus share.

use crate::{BINS, Instance, ORDER, SAMPLE_RATE_HZ};
use asperity::{
    learned::{DecodedGrid, description::GridDescription, texture},
    model::ModelGrid,
};
use serde::{Deserialize, Serialize};

/// Centre of a bin.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bin {
    /// Tangential speed, mm/s.
    pub speed_mm_s: f64,
    /// Normal force, N.
    pub force_n: f64,
}

/// The bins and the rectangle `[0, max_speed_mm_s] × [0, max_force_n]` around them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UnifiedGrid {
    /// [`BINS`] centres, in ascending order of force, then speed.
    pub bins: Vec<Bin>,
    /// Right border, mm/s.
    pub max_speed_mm_s: f64,
    /// Upper border, N.
    pub max_force_n: f64,
}

impl UnifiedGrid {
    /// The grid of the reference corpus: 6 × 3 points, staggered because collinear points would
    /// make thin triangles.
    #[must_use]
    pub fn reference() -> Self {
        const SPEEDS_MM_S: [f64; 6] = [25.0, 60.0, 100.0, 140.0, 180.0, 218.0];
        const FORCES_N: [f64; 3] = [0.4, 1.2, 2.4];
        let mut bins = Vec::with_capacity(BINS);
        for (row, force_n) in FORCES_N.into_iter().enumerate() {
            for (column, speed_mm_s) in SPEEDS_MM_S.into_iter().enumerate() {
                bins.push(Bin {
                    speed_mm_s: speed_mm_s + [6.0, -5.0, 2.0][(row + column) % 3],
                    force_n: force_n * [1.0, 1.1, 0.92][(row + 2 * column) % 3],
                });
            }
        }
        Self {
            bins,
            max_speed_mm_s: 240.0,
            max_force_n: 3.2,
        }
    }

    /// The grid as a model describes it.
    #[must_use]
    pub fn description(&self) -> GridDescription {
        GridDescription {
            order: ORDER,
            sample_rate_hz: SAMPLE_RATE_HZ,
            speeds_mm_s: self.bins.iter().map(|bin| bin.speed_mm_s).collect(),
            forces_n: self.bins.iter().map(|bin| bin.force_n).collect(),
            max_speed_mm_s: self.max_speed_mm_s,
            max_force_n: self.max_force_n,
        }
    }
}

impl Instance {
    /// The models of the bins, with edge models around them, as the compiler lays them out.
    #[must_use]
    pub fn grid(&self, description: &GridDescription) -> ModelGrid {
        let decoded = DecodedGrid {
            lsf_rad: self.lsf_rad.as_flattened().to_vec(),
            level_db: self.level_db.to_vec(),
        };
        texture::grid(description, &decoded)
    }
}
