//! Friction from an estimated velocity.
//!
//! [`Sign`] is the paper's law, F_t = μF_n against t̂. [`Regularised`] is the reference
//! renderer's, viscous below v = μ/0.004 mm/s and Coulomb above. Both take the velocity from the
//! reference's second-order low-pass at 20 Hz.

use asperity_runtime::quantity::{Quantity, Vector};
use asperity_runtime::stage::velocity::{VelocityEstimator, VelocityState};

/// Estimates a velocity in one dimension, m/s, from positions.
#[derive(Debug, Clone)]
struct Velocity {
    filter: VelocityEstimator,
    state: VelocityState,
    last_m: Option<f64>,
}

impl Velocity {
    fn new(rate_hz: f64) -> Self {
        Self {
            filter: VelocityEstimator::new(20.0, 20.0, rate_hz as f32),
            state: VelocityState::REST,
            last_m: None,
        }
    }

    fn step(&mut self, position_m: f64) -> f64 {
        let motion_m = position_m - self.last_m.replace(position_m).unwrap_or(position_m);
        let motion = Vector::of([motion_m as f32, 0.0, 0.0]);
        let velocity = self.filter.step(&mut self.state, motion, Quantity::ZERO, 1);
        f64::from(velocity.world.values()[0])
    }
}

/// The paper's law: full force against the sign of the velocity.
#[derive(Debug, Clone)]
pub struct Sign {
    velocity: Velocity,
}

impl Sign {
    /// At rest.
    #[must_use]
    pub fn new(rate_hz: f64) -> Self {
        Self {
            velocity: Velocity::new(rate_hz),
        }
    }

    /// Force along the axis, N.
    pub fn step(&mut self, position_m: f64, mu: f64, normal_n: f64) -> f64 {
        let speed = self.velocity.step(position_m);
        if speed == 0.0 {
            0.0
        } else {
            -mu * normal_n * speed.signum()
        }
    }
}

/// The reference renderer's law: viscous at low speed, Coulomb above.
#[derive(Debug, Clone)]
pub struct Regularised {
    velocity: Velocity,
}

/// Slope of the viscous part, (N/N)/(m/s): 0.004 per mm/s.
const SLOPE: f64 = 4.0;

impl Regularised {
    /// At rest.
    #[must_use]
    pub fn new(rate_hz: f64) -> Self {
        Self {
            velocity: Velocity::new(rate_hz),
        }
    }

    /// Force along the axis, N.
    pub fn step(&mut self, position_m: f64, mu: f64, normal_n: f64) -> f64 {
        let speed = self.velocity.step(position_m);
        -normal_n * (SLOPE * speed).clamp(-mu, mu)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_give_coulomb_friction_when_fast() {
        let (mut sign, mut regularised) = (Sign::new(1000.0), Regularised::new(1000.0));
        let mut last = (0.0, 0.0);
        for n in 0..500 {
            let x = 0.3e-3 * f64::from(n);
            last = (sign.step(x, 0.5, 2.0), regularised.step(x, 0.5, 2.0));
        }
        assert_eq!(last, (-1.0, -1.0));
    }
}
