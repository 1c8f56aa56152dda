//! AXIS, in version 3: how a texture differs along an axis and across it.

use crate::{
    error::{FormatError, in_range},
    friction::Friction,
    limits,
    wire::Reader,
};

/// How far the square of an axis's length may be from 1.
const UNIT_TOLERANCE: f32 = 1.0e-4;

/// The direction of a texture whose ribs, grain or nap lie along an axis: factors on the speed that
/// looks up the grid, on the level and on μ. The grid is that of strokes across the axis.
///
/// With θ the angle of a stroke of speed v from across the axis, c = |cos θ|, s = |sin θ|, and P the
/// power of the relief along the axis over that across it at the same speed:
///
/// ```text
/// v_grid² = v²·(c⁴ + P·r²·s⁴)/(c² + P·s²)
/// gain²   = (c² + P·s²)²/(c⁴ + P·r²·s⁴)
/// μ       = μ·(c² + m·s²)     m of the sense of the stroke along the axis
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction {
    /// Direction of the ribs, the grain or the nap, of length 1, in the frame of the scene.
    pub axis: [f32; 3],
    /// P, the power along the axis over that across it.
    pub power_ratio: f32,
    /// r: a stroke along the axis sounds as one across it at r times its speed.
    pub speed_ratio: f32,
    /// μ of a stroke towards the axis over μ across it.
    pub mu_forward: f32,
    /// μ of a stroke against the axis over μ across it.
    pub mu_backward: f32,
}

impl Direction {
    pub(crate) fn parse(bytes: &[u8], friction: &Friction<'_>) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let mut number = |field| reader.f32(field);
        let direction = Self {
            axis: [
                number("direction.axis")?,
                number("direction.axis")?,
                number("direction.axis")?,
            ],
            power_ratio: number("direction.power_ratio")?,
            speed_ratio: number("direction.speed_ratio")?,
            mu_forward: number("direction.mu_forward")?,
            mu_backward: number("direction.mu_backward")?,
        };
        reader.finish("direction")?;
        direction.check(friction)?;
        Ok(direction)
    }

    fn check(&self, friction: &Friction<'_>) -> Result<(), FormatError> {
        for (index, part) in self.axis.into_iter().enumerate() {
            in_range("direction.axis", index, part, (-1.001, 1.001), "-1 to 1")?;
        }
        let square = self.axis.iter().fold(0.0, |sum, x| sum + x * x);
        let unit = (1.0 - UNIT_TOLERANCE, 1.0 + UNIT_TOLERANCE);
        in_range("direction.axis", 0, square, unit, "must have length 1")?;
        for (field, value, range, rule) in [
            (
                "direction.power_ratio",
                self.power_ratio,
                (0.0, limits::MAX_POWER_RATIO),
                "0 to 2",
            ),
            (
                "direction.speed_ratio",
                self.speed_ratio,
                limits::SPEED_RATIO,
                "0.125 to 2",
            ),
            (
                "direction.mu_forward",
                self.mu_forward,
                limits::MU_RATIO,
                "0.0625 to 4",
            ),
            (
                "direction.mu_backward",
                self.mu_backward,
                limits::MU_RATIO,
                "0.0625 to 4",
            ),
        ] {
            in_range(field, 0, value, range, rule)?;
        }
        let highest = friction.highest_mu();
        for (field, ratio) in [
            ("direction.mu_forward", self.mu_forward),
            ("direction.mu_backward", self.mu_backward),
        ] {
            if highest * ratio > limits::MAX_MU {
                let rule = "μ times the ratio must be 10 at most";
                return Err(FormatError::invalid(field, 0, f64::from(ratio), rule));
            }
        }
        Ok(())
    }
}
