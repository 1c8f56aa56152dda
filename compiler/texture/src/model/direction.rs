//! The direction of ribs, a grain or a nap: how strokes along an axis differ from those across it.
//!
//! ```
//! use asperity_texture::model::Direction;
//!
//! let ribs = Direction { power_ratio: 0.0, ..Direction::NONE };
//! // At 60° from across bare ribs are crossed at half the speed, and nothing is felt along them.
//! let across = ribs.at(0.75);
//! assert!((across.speed - 0.5).abs() < 1e-9 && (across.level - 1.0).abs() < 1e-9);
//! assert_eq!(ribs.at(1.0).level, 0.0);
//! ```

use super::{GridVertex, TextureModel, mixture::Field};
use serde::{Deserialize, Serialize};
use std::fmt;

/// How strokes along an axis differ from those across it, of which the grid and μ are.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Direction {
    /// Direction of the ribs, the grain or the nap, of length 1, in the frame of the scene.
    #[serde(default = "along_y")]
    pub axis: [f64; 3],
    /// P, the power along the axis over that across it at the same speed.
    pub power_ratio: f64,
    /// r: a stroke along the axis sounds as one across it at r times its speed.
    pub speed_ratio: f64,
    /// μ of a stroke towards the axis, over μ across it.
    pub mu_forward: f64,
    /// μ of a stroke against the axis, over μ across it.
    pub mu_backward: f64,
}

/// Ribs run along y, so that strokes in x cross them.
const fn along_y() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

/// Direction of strokes relative to an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bearing {
    /// At right angles to it.
    Across,
    /// To and fro along it.
    Along,
    /// Towards it: with the nap.
    With,
    /// Against it: against the nap.
    Against,
}

impl fmt::Display for Bearing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Across => "across its axis",
            Self::Along => "along its axis",
            Self::With => "with its nap",
            Self::Against => "against its nap",
        })
    }
}

/// Factors of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeFactors {
    /// Speed that looks up the grid, over that of the stroke.
    pub speed: f64,
    /// Level over that of the grid.
    pub level: f64,
    /// μ over that across the axis, the larger one of both senses.
    pub mu: f64,
}

impl Direction {
    /// The same in every direction, with an axis along y.
    pub const NONE: Self = Self {
        axis: along_y(),
        power_ratio: 1.0,
        speed_ratio: 1.0,
        mu_forward: 1.0,
        mu_backward: 1.0,
    };

    /// Factors where the sine of the angle from across the axis has this square, 0 to 1: a relief is met at the cosine of the speed
    /// across the axis and at the sine along it, and both count by their powers.
    #[must_use]
    pub fn at(&self, sine_squared: f64) -> StrokeFactors {
        let (s, c) = (sine_squared, 1.0 - sine_squared);
        let power = c + self.power_ratio * s;
        let fast = c * c + self.power_ratio * self.speed_ratio * self.speed_ratio * s * s;
        let (speed, level) = if fast > 0.0 {
            ((fast / power).sqrt(), power / fast.sqrt())
        } else {
            (0.0, 0.0)
        };
        StrokeFactors {
            speed,
            level,
            mu: c + self.mu_forward.max(self.mu_backward) * s,
        }
    }

    /// The direction of a mixture of textures, each with its weight and its direction, if it has one: the mean of the logarithms, so
    /// that halfway between 1 and ¼ is ½. What the weights lack of 1 has no direction.
    #[must_use]
    pub fn mixed<'a>(shares: impl Iterator<Item = (f64, &'a Self)>) -> Self {
        let mut logs = [0.0; 4];
        for (weight, direction) in shares {
            for (log, ratio) in logs.iter_mut().zip(direction.ratios()) {
                // A power of nothing has no logarithm; −40 dB are next to nothing.
                *log += weight * libm::log(ratio.max(1e-4));
            }
        }
        let [power_ratio, speed_ratio, mu_forward, mu_backward] = logs.map(libm::exp);
        Self {
            axis: along_y(),
            power_ratio,
            speed_ratio,
            mu_forward,
            mu_backward,
        }
    }

    /// Returns true if μ against the axis is another than towards it: if there is a nap.
    #[must_use]
    pub fn leans(&self) -> bool {
        (self.mu_backward / self.mu_forward - 1.0).abs() > 5e-3
    }

    /// The numbers beside the axis: of power, of speed, and of μ towards the axis and against it.
    #[must_use]
    pub const fn ratios(&self) -> [f64; 4] {
        [
            self.power_ratio,
            self.speed_ratio,
            self.mu_forward,
            self.mu_backward,
        ]
    }
}

/// "axis (0, 1, 0); along it as across at 0.42 of the speed, +1.9 dB, μ × 0.84; against the nap × 1.2".
impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Without the sign of a zero.
        let [x, y, z] = self.axis.map(|c| (1e3 * c).round() / 1e3 + 0.0);
        let along = self.at(1.0);
        write!(f, "axis ({x}, {y}, {z}); along it ")?;
        if along.level > 0.0 {
            let level_db = 20.0 * libm::log10(along.level);
            write!(
                f,
                "as across at {:.2} of the speed, {level_db:+.1} dB",
                along.speed
            )?;
        } else {
            write!(f, "nothing vibrates")?;
        }
        write!(f, ", μ × {:.2}", self.mu_forward)?;
        if !self.leans() {
            return Ok(());
        }
        write!(f, "; against the nap × {:.2}", self.mu_backward)
    }
}

impl TextureModel {
    /// The texture as strokes of this bearing feel it, the same in every direction. One without a direction stays as it is.
    #[must_use]
    pub fn stroked(mut self, bearing: Bearing) -> Self {
        let Some(direction) = self.direction.take() else {
            return self;
        };
        let mu = match bearing {
            Bearing::Across => return self,
            Bearing::Along => 0.5 * (direction.mu_forward + direction.mu_backward),
            Bearing::With => direction.mu_forward,
            Bearing::Against => direction.mu_backward,
        };
        let along = direction.at(1.0);
        let field = Field::new(&self.grid);
        let vertices = self.grid.vertices.iter().map(|vertex| {
            let Some(place) = field.locate(along.speed * vertex.speed_mm_s, vertex.force_n) else {
                return vertex.clone();
            };
            let mixture = field.mixture(&place);
            let angles = |cosines: Vec<f64>| cosines.into_iter().map(libm::acos).collect();
            GridVertex {
                gain: 1.0,
                sigma_m_s2: along.level * mixture.level_m_s2,
                lsf_rad: angles(mixture.ar_cosines),
                ma_lsf_rad: (vertex.ma_lsf_rad.is_some()).then(|| angles(mixture.ma_cosines)),
                ..*vertex
            }
        });
        self.grid.vertices = vertices.collect();
        self.friction.mu *= mu;
        for anchor in &mut self.friction.anchors {
            anchor.mu *= mu;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RIBS: Direction = Direction {
        power_ratio: 0.25,
        speed_ratio: 0.5,
        mu_forward: 0.8,
        mu_backward: 1.2,
        ..Direction::NONE
    };

    #[test]
    fn the_ends_are_across_and_along() {
        let across = RIBS.at(0.0);
        assert_eq!((across.speed, across.level, across.mu), (1.0, 1.0, 1.0));
        let along = RIBS.at(1.0);
        assert!((along.speed - 0.5).abs() < 1e-12 && (along.level - 1.0).abs() < 1e-12);
        assert!((along.mu - 1.2).abs() < 1e-12);
    }

    #[test]
    fn a_mixture_lies_between_its_parts() {
        let half = Direction::mixed([(0.5, &RIBS), (0.5, &Direction::NONE)].into_iter());
        assert!((half.power_ratio - 0.5).abs() < 1e-12, "{half:?}");
        assert!(
            (half.speed_ratio - 0.5_f64.sqrt()).abs() < 1e-12,
            "{half:?}"
        );
        let alone = Direction::mixed([(1.0, &RIBS)].into_iter());
        for (found, exact) in alone.ratios().into_iter().zip(RIBS.ratios()) {
            assert!((found - exact).abs() < 1e-12);
        }
    }
}
