//! What a tick costs on a processor, as far as it depends on the texture and the scene.

use crate::model::{ModelGrid, Numerator};
use asperity_formats::Shape as Solid;

/// Executed instructions of the costliest tick on a processor: a sum over what texture and
/// scene have, never below what was counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cost {
    /// Name of the processor.
    pub(super) processor: &'static str,
    /// Everything that is always the same.
    pub(super) base: f64,
    pub(super) pole: f64,
    /// A zero of a numerator that is mixed and converted; 1 + z⁻¹ costs nothing.
    pub(super) zero: f64,
    pub(super) triangle: f64,
    /// A plane's distance, a sphere's, a box's.
    pub(super) surfaces: [f64; 3],
    /// The most that the sum is above a count, percent.
    pub(super) above_percent: f64,
}

/// Planes, spheres and boxes of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Surfaces(pub(super) [usize; 3]);

impl Surfaces {
    /// How many of each there are.
    #[must_use]
    pub fn of(solids: impl IntoIterator<Item = Solid>) -> Self {
        let mut counts = Self::default();
        for solid in solids {
            counts.0[match solid {
                Solid::Plane { .. } => 0,
                Solid::Sphere { .. } => 1,
                Solid::Box { .. } => 2,
            }] += 1;
        }
        counts
    }
}

impl Cost {
    /// Executed instructions of the costliest tick.
    pub(super) fn instructions(
        &self,
        [poles, zeros, triangles]: [usize; 3],
        surfaces: Surfaces,
    ) -> u64 {
        let surfaces = self.surfaces.iter().zip(surfaces.0);
        let cost = self.base
            + self.pole * poles as f64
            + self.zero * zeros as f64
            + self.triangle * triangles as f64
            + surfaces.map(|(cost, n)| cost * n as f64).sum::<f64>();
        cost.ceil() as u64
    }
}

/// Zeros that are mixed and converted.
#[must_use]
pub(super) fn zeros(grid: &ModelGrid) -> usize {
    match grid.numerator {
        Numerator::None | Numerator::Nyquist => 0,
        Numerator::Lsf => grid
            .vertices
            .iter()
            .map(|vertex| vertex.ma_lsf_rad.as_ref().map_or(0, Vec::len))
            .max()
            .unwrap_or(0),
    }
}
