//! Speed, level and μ of a stroke that meets an axis, in f64.

use super::{Vector, dot};
use asperity_formats::Direction;

/// What the sine's square is regularised by, so that it is ½ where the axis is normal to the surface.
const POLE: f64 = 1.0 / 1024.0;

/// Factors of the grid's speed and level, and of μ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionFactors {
    /// Of the speed that looks up the grid.
    pub speed: f64,
    /// Of the level.
    pub level: f64,
    /// Of μ across the axis.
    pub mu: f64,
}

impl DirectionFactors {
    /// Those of a stroke across the axis.
    pub const ACROSS: Self = Self {
        speed: 1.0,
        level: 1.0,
        mu: 1.0,
    };

    /// Those of a stroke of direction `stroke` on a surface of this normal, both of length 1.
    #[must_use]
    pub fn of(direction: &Direction, stroke: Vector, normal: Vector) -> Self {
        let axis = direction.axis.map(f64::from);
        let length = dot(axis, axis).sqrt();
        let [along, upright] = [stroke, normal].map(|v| dot(v, axis) / length);
        let sine = (along * along + 0.5 * POLE) / (1.0 - upright * upright + POLE);
        let sine = sine.min(1.0);
        let cosine = 1.0 - sine;
        let (power, ratio) = (
            f64::from(direction.power_ratio),
            f64::from(direction.speed_ratio),
        );
        // The squared speed at which each relief is met, weighted by its power.
        let (across, along_power) = (cosine, power * sine);
        let total = across + along_power;
        let squared = (across * cosine + along_power * ratio * ratio * sine) / total;
        let mu = if along > 0.0 {
            direction.mu_forward
        } else {
            direction.mu_backward
        };
        Self {
            speed: squared.sqrt(),
            level: (total / squared).sqrt(),
            mu: cosine + f64::from(mu) * sine,
        }
    }
}
