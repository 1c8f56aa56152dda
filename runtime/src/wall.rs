//! The virtual wall, no stiffer than the device can bear.
//!
//! A sampled spring held for a period T gives off up to ½K(x_{n+1} − x_n)² a tick, and each
//! tick of delay adds twice that; rendered damping B may give off as much as it takes. The
//! device absorbs `b·v²` and, by its own Coulomb friction, at least `(f_c/V)·v²` up to a speed
//! V. With counts of Δ the force is wrong by up to KΔ/2 + BΔ/T, which friction pays for. So
//! the pair is passive against every hand that stays below V if (after Colgate and Schenkel;
//! Diolaiti et al. for quantisation and friction)
//!
//! ```text
//! K·(T·(1 + 2n)/2 + Δ/2V) + B·(1 + Δ/TV) ≤ b + f_c/V   and   K·Δ/2 ≤ f_c
//! ```
//!
//! A wall within the bound is rendered as the asset says. Beyond it damping goes first, since
//! stiffness is what a wall is felt by, then stiffness as far as the bound asks.

use crate::{
    MechanicsConfig,
    math::{clamp_from_zero, max, min},
};

/// Stiffness and damping of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Stiffness K, N/m.
    pub stiffness_n_m: f32,
    /// Rendered damping B, N·s/m.
    pub damping_n_s_m: f32,
}

/// The bound above, prepared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passivity {
    /// What damping may be without any stiffness, N·s/m.
    damping_n_s_m: f32,
    /// What a unit of stiffness takes of it, s.
    stiffness_cost_s: f32,
    stiffest_n_m: f32,
}

impl Passivity {
    /// Of a device in a loop at `rate_hz`.
    #[must_use]
    pub fn new(mechanics: &MechanicsConfig, rate_hz: f32) -> Self {
        let (coulomb_n, step_m) = (mechanics.coulomb_n, mechanics.position_step_m);
        let per_speed = 1.0 / mechanics.fastest_m_s;
        let budget_n_s_m = mechanics.damping_n_s_m + coulomb_n * per_speed;
        let ticks = 0.5 + mechanics.delay_ticks as f32;
        let stiffness_cost_s = ticks / rate_hz + 0.5 * step_m * per_speed;
        let quantised_n_m = if step_m > 0.0 {
            2.0 * coulomb_n / step_m
        } else {
            f32::MAX
        };
        let damping_share = 1.0 / (1.0 + step_m * rate_hz * per_speed);
        Self {
            damping_n_s_m: budget_n_s_m * damping_share,
            stiffness_cost_s: stiffness_cost_s * damping_share,
            stiffest_n_m: min(budget_n_s_m / stiffness_cost_s, quantised_n_m),
        }
    }

    /// The nearest passive wall to the one of an asset.
    #[inline]
    #[must_use]
    pub fn wall(&self, stiffness_n_m: f32, damping_n_s_m: f32) -> Wall {
        let stiffness_n_m = min(stiffness_n_m, self.stiffest_n_m);
        let left_n_s_m = self.damping_n_s_m - stiffness_n_m * self.stiffness_cost_s;
        Wall {
            stiffness_n_m,
            damping_n_s_m: clamp_from_zero(left_n_s_m, damping_n_s_m),
        }
    }
}

impl Wall {
    /// Normal force `k·δ − b·ḋ`, N, never pulling: `spring_n` is k·δ (0 out of contact),
    /// `outward_m_s` is ḋ.
    #[inline]
    #[must_use]
    pub fn force_n(&self, spring_n: f32, outward_m_s: f32) -> f32 {
        let damped = max(spring_n - self.damping_n_s_m * outward_m_s, 0.0);
        if spring_n > 0.0 { damped } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn device(damping_n_s_m: f32, delay_ticks: u32) -> Passivity {
        let mechanics = MechanicsConfig {
            damping_n_s_m,
            coulomb_n: 0.0,
            fastest_m_s: 1.0,
            position_step_m: 0.0,
            delay_ticks,
        };
        Passivity::new(&mechanics, 1000.0)
    }

    /// Colgate at 1 kHz: 500 N/m asks for 0.25 N·s/m, with one more tick 0.75.
    #[test]
    fn a_wall_is_lowered_exactly_as_far_as_the_bound_asks() {
        for (damping, delay, stiffness, left) in [
            (0.35, 0, 500.0, 0.1),
            (0.30, 0, 500.0, 0.05),
            (0.25, 0, 500.0, 0.0),
            (0.005, 0, 10.0, 0.0),
            (0.75, 1, 500.0, 0.0),
            (0.25, 1, 500.0 / 3.0, 0.0),
            (1.0, 2, 400.0, 0.0),
            (2.0, 2, 500.0, 0.1),
        ] {
            let wall = device(damping, delay).wall(500.0, 0.1);
            assert!((wall.stiffness_n_m - stiffness).abs() < 1e-3, "{wall:?}");
            assert!((wall.damping_n_s_m - left).abs() < 1e-6, "{wall:?}");
        }
    }

    #[test]
    fn the_default_device_bears_the_default_wall() {
        let config = crate::Config::default();
        let wall = Passivity::new(&config.mechanics, config.servo_rate_hz).wall(500.0, 0.1);
        assert_eq!((wall.stiffness_n_m, wall.damping_n_s_m), (500.0, 0.1));
    }

    #[test]
    fn quantisation_without_friction_leaves_no_wall() {
        let mechanics = MechanicsConfig {
            coulomb_n: 0.0,
            ..crate::Config::default().mechanics
        };
        assert_eq!(
            Passivity::new(&mechanics, 1000.0)
                .wall(500.0, 0.1)
                .stiffness_n_m,
            0.0
        );
    }

    #[test]
    fn a_wall_never_pulls() {
        let wall = Wall {
            stiffness_n_m: 500.0,
            damping_n_s_m: 1.0,
        };
        assert_eq!(wall.force_n(0.1, 5.0), 0.0);
        assert_eq!(wall.force_n(0.0, -5.0), 0.0);
        assert_eq!(wall.force_n(0.1, -0.5), 0.6);
    }
}
