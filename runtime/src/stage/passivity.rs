//! Passivity: how stiff and how damped a wall the device can bear.
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
//! stiffness is what a wall is felt by, then stiffness as far as the bound asks. Of a contact law K
//! is the spring's steepest slope, the Maxwell branch's and adhesion's together, and B the damping at
//! the greatest force of the device.

use super::wall::Wall;
use crate::{
    arithmetic::{Arithmetic, Float},
    config::MechanicsConfig,
    math::min,
    quantity::{
        Quantity,
        unit::{NewtonPerMetre, NewtonSecondPerMetre, PerNewton, Second, SecondPerMetre},
    },
};

/// The bound above, prepared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passivity<A: Arithmetic = Float> {
    /// The damping that may be rendered without any stiffness, N·s/m.
    damping: Quantity<A, NewtonSecondPerMetre>,
    /// The part of that damping that a unit of stiffness takes, s.
    stiffness_cost: Quantity<A, Second>,
    /// The largest stiffness, N/m.
    stiffest: Quantity<A, NewtonPerMetre>,
    /// 1 over the greatest force of the device, 1/N.
    per_peak: Quantity<A, PerNewton>,
    /// The servo period, s.
    period: Quantity<A, Second>,
}

/// A wall and a [contact law](super::contact_law) on it: what counts of them against the bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lowered<A: Arithmetic = Float> {
    /// The wall, with the steepest slope of the spring.
    pub wall: Wall<A>,
    /// Stiffness k₁ of the Maxwell branch, N/m.
    pub relaxing: Quantity<A, NewtonPerMetre>,
    /// Stiffness k_a of adhesion, N/m.
    pub sticking: Quantity<A, NewtonPerMetre>,
    /// Damping λ over the load, s/m.
    pub damping: Quantity<A, SecondPerMetre>,
}

impl<A: Arithmetic> Lowered<A> {
    /// Nothing at all.
    pub(crate) const NONE: Self = Self {
        wall: Wall::NONE,
        relaxing: Quantity::ZERO,
        sticking: Quantity::ZERO,
        damping: Quantity::ZERO,
    };
}

impl<A: Arithmetic> Passivity<A> {
    /// The bound of a device of a peak force in a loop at `rate_hz`.
    #[must_use]
    pub fn new(mechanics: &MechanicsConfig, peak_n: f32, rate_hz: f32) -> Self {
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
        let damping_part = 1.0 / (1.0 + step_m * rate_hz * per_speed);
        Self {
            damping: Quantity::of(budget_n_s_m * damping_part),
            stiffness_cost: Quantity::of(stiffness_cost_s * damping_part),
            stiffest: Quantity::of(min(budget_n_s_m / stiffness_cost_s, quantised_n_m)),
            per_peak: Quantity::of(1.0 / peak_n),
            period: Quantity::of(1.0 / rate_hz),
        }
    }

    /// The nearest passive wall.
    #[inline]
    #[must_use]
    pub fn bear(&self, wall: Wall<A>) -> Wall<A> {
        let stiffness = wall.stiffness.min(self.stiffest);
        let left = self.damping - stiffness * self.stiffness_cost;
        Wall {
            stiffness,
            damping: left.clamp_from_zero(wall.damping),
        }
    }

    /// The nearest passive law on a wall that is passive. The spring keeps what it has; then come
    /// relaxation, adhesion, the wall's damping, and the damping over the load at the greatest force.
    #[inline]
    #[must_use]
    pub fn lower(&self, asked: Lowered<A>) -> Lowered<A> {
        let left = (self.stiffest - asked.wall.stiffness).max(Quantity::ZERO);
        let relaxing = asked.relaxing.min(left);
        let sticking = asked.sticking.min(left - relaxing);
        let stiffness = asked.wall.stiffness + relaxing + sticking;
        let left = (self.damping - stiffness * self.stiffness_cost).max(Quantity::ZERO);
        let damping = asked.wall.damping.min(left);
        Lowered {
            wall: Wall {
                damping,
                ..asked.wall
            },
            relaxing,
            sticking,
            damping: asked.damping.min((left - damping) * self.per_peak),
        }
    }

    /// The servo period, s.
    #[inline(always)]
    pub(crate) const fn period(&self) -> Quantity<A, Second> {
        self.period
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    fn device(damping_n_s_m: f32, delay_ticks: u32) -> Passivity {
        let mechanics = MechanicsConfig {
            damping_n_s_m,
            coulomb_n: 0.0,
            fastest_m_s: 1.0,
            position_step_m: 0.0,
            delay_ticks,
        };
        Passivity::new(&mechanics, 3.3, 1000.0)
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
            let wall = device(damping, delay).bear(Wall::of(500.0, 0.1));
            assert!(
                (wall.stiffness.value() - stiffness).abs() < 1e-3,
                "{wall:?}"
            );
            assert!((wall.damping.value() - left).abs() < 1e-6, "{wall:?}");
        }
    }

    #[test]
    fn the_default_device_bears_the_default_wall() {
        let config = Config::default();
        let wall = Passivity::<Float>::new(&config.mechanics, 3.3, config.servo_rate_hz)
            .bear(Wall::of(500.0, 0.1));
        assert_eq!(wall, Wall::of(500.0, 0.1));
    }

    #[test]
    fn quantisation_without_friction_leaves_no_wall() {
        let mechanics = MechanicsConfig {
            coulomb_n: 0.0,
            ..Config::default().mechanics
        };
        assert_eq!(
            Passivity::<Float>::new(&mechanics, 3.3, 1000.0)
                .bear(Wall::of(500.0, 0.1))
                .stiffness
                .value(),
            0.0
        );
    }
}
