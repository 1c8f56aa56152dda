//! Cost of a tick on a processor, as far as it depends on the texture and the scene.

use asperity_formats::Solid;
use asperity_texture::model::{ModelGrid, Numerator, TextureModel};

/// A model of the executed instructions of the costliest tick on a processor: a sum over poles,
/// zeros, triangles, a law of friction, a contact law, a direction and surfaces that is never below what was counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cost {
    /// Name of the processor.
    pub(super) processor: &'static str,
    /// Cost of every tick.
    pub(super) base: f64,
    /// Cost per pole.
    pub(super) pole: f64,
    /// Cost per zero that is mixed and converted; 1 + z⁻¹ costs nothing.
    pub(super) zero: f64,
    /// Cost per triangle.
    pub(super) triangle: f64,
    /// Cost of the texture's law of friction.
    pub(super) law: f64,
    /// Cost of the texture's contact law.
    pub(super) contact: f64,
    /// Cost of the texture's direction.
    pub(super) axis: f64,
    /// Cost of the distance to a plane, a sphere and a box.
    pub(super) surfaces: [f64; 3],
    /// The most that the sum is above a count, percent.
    pub(super) above_percent: f64,
}

/// The number of planes, spheres and boxes of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Surfaces(pub(super) [usize; 3]);

impl Surfaces {
    /// Counts solids.
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
        [poles, zeros, triangles, laws, contacts, axes]: [usize; 6],
        surfaces: Surfaces,
    ) -> u64 {
        let surfaces = self.surfaces.iter().zip(surfaces.0);
        let cost = self.base
            + self.pole * poles as f64
            + self.zero * zeros as f64
            + self.triangle * triangles as f64
            + self.law * laws as f64
            + self.contact * contacts as f64
            + self.axis * axes as f64
            + surfaces.map(|(cost, n)| cost * n as f64).sum::<f64>();
        cost.ceil() as u64
    }
}

/// Returns the counts that the cost of a texture depends on: poles, zeros, triangles, laws of friction, contact laws and
/// directions (0 or 1).
pub(super) fn sizes(texture: &TextureModel) -> [usize; 6] {
    let grid = &texture.grid;
    let laws = usize::from(texture.friction.law.is_some());
    let contacts = usize::from(texture.contact.is_some());
    [
        grid.order,
        zeros(grid),
        grid.triangles.len(),
        laws,
        contacts,
        usize::from(texture.direction.is_some()),
    ]
}

/// Number of zeros of a grid that are mixed and converted.
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
