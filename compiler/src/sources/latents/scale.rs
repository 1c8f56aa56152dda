//! The scale of the sliders: 0 to 100 between the materials of the model that have the least and
//! the most of an attribute.

use crate::{
    edit_memory::{AXES, Axis},
    learned::description::ModelDescription,
};
use asperity_texture::model::{attributes::Attributes, shift::Shift};

/// Share of the materials that lie below 0, and above 100.
const BEYOND: f64 = 0.05;

/// Scale of each slider: its values at 0 and 100, and its gradient in the latent space.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    /// Attribute at 0 and at 100, in the order of [`AXES`].
    ranges: [(f64, f64); 4],
    /// Steps of the slider a unit of the latent, in the order of [`AXES`].
    pub(super) gradients: [Vec<f64>; 4],
}

impl Scale {
    /// The scale of a model: the 5 % and 95 % quantiles of its materials, by the lines of its
    /// description, and of μ by the materials themselves.
    #[must_use]
    pub fn of(description: &ModelDescription) -> Self {
        let axis = |axis: Axis| {
            let line = description
                .axes
                .iter()
                .find(|line| line.attribute == axis.described());
            let sign = if axis == Axis::Slippery { -1.0 } else { 1.0 };
            let direction: Vec<f64> = line.map_or_else(Vec::new, |line| {
                line.direction
                    .iter()
                    .map(|&x| sign * f64::from(x))
                    .collect()
            });
            let offset = line.map_or(0.0, |line| line.offset);
            let mut values: Vec<f64> = description
                .anchors
                .iter()
                .map(|anchor| match axis {
                    Axis::Slippery => -anchor.mu,
                    _ => {
                        let products = direction.iter().zip(&anchor.z);
                        offset + products.map(|(d, &z)| d * f64::from(z)).sum::<f64>()
                    }
                })
                .collect();
            values.sort_by(f64::total_cmp);
            let last = values.len().saturating_sub(1) as f64;
            let quantile = |share: f64| values.get((share * last).round() as usize).copied();
            let low = quantile(BEYOND).unwrap_or(0.0);
            let high = quantile(1.0 - BEYOND).unwrap_or(1.0).max(low + 1e-6);
            let steps = 100.0 / (high - low);
            let gradient = direction.iter().map(|d| d * steps).collect();
            ((low, high), gradient)
        };
        let all = AXES.map(axis);
        Self {
            ranges: [all[0].0, all[1].0, all[2].0, all[3].0],
            gradients: all.map(|(_, gradient)| gradient),
        }
    }

    /// The place of an attribute on its slider; `None` where a texture does not define it.
    #[must_use]
    pub fn place(&self, axis: Axis, attributes: &Attributes) -> Option<f64> {
        let (low, high) = self.ranges[axis as usize];
        axis.of(attributes)
            .map(|x| 100.0 * (x - low) / (high - low))
    }

    /// The shift that moves attributes by these steps from where they are, in the order of
    /// [`AXES`]; the centroid of the vibration stays.
    pub(super) fn shift(&self, from: &Attributes, steps: [f64; 4]) -> Shift {
        let unit = |axis: Axis| {
            let (low, high) = self.ranges[axis as usize];
            (high - low) / 100.0
        };
        let by = |axis: Axis| steps[axis as usize] * unit(axis);
        let log_ratio = |from: f64, to: f64| {
            // No edit asks for less than a hundredth.
            libm::log(to.max(0.01 * from) / from)
        };
        let hard = from.hard_hz.filter(|hz| *hz > 0.0);
        Shift {
            rough_db: by(Axis::Rough),
            slippery: -log_ratio(from.mu, from.mu - by(Axis::Slippery)),
            hard: hard.map_or(0.0, |hz| log_ratio(hz, hz + by(Axis::Hard))),
        }
    }

    /// The attribute at 0 and at 100 of its slider, in its own unit.
    #[must_use]
    pub fn range(&self, axis: Axis) -> (f64, f64) {
        self.ranges[axis as usize]
    }
}
