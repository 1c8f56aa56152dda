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
    arithmetic::{
        Arithmetic, Float, Number, Zero as _,
        units::{
            Metre, MetrePerSecond, Newton, NewtonPerMetre, NewtonSecondPerMetre, STRONGEST_N, Unit,
        },
    },
    math::min,
};

/// Stiffness and damping of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall<A: Arithmetic = Float> {
    /// Stiffness K, N/m.
    pub stiffness_n_m: A::Scalar<NewtonPerMetre>,
    /// Rendered damping B, N·s/m.
    pub damping_n_s_m: A::Scalar<NewtonSecondPerMetre>,
}

/// The bound above, prepared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passivity<A: Arithmetic = Float> {
    /// What damping may be without any stiffness, N·s/m.
    damping_n_s_m: Number<A, NewtonSecondPerMetre>,
    /// What a unit of stiffness takes of it, s.
    stiffness_cost_s: Number<A, Unit>,
    stiffest_n_m: Number<A, NewtonPerMetre>,
}

/// Budgets of damping are no larger, N·s/m, where numbers have a range.
const DAMPEST_N_S_M: f32 = 16_384.0;

impl<A: Arithmetic> Passivity<A> {
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
            damping_n_s_m: Number::of(budget_n_s_m * damping_share),
            stiffness_cost_s: Number::of(stiffness_cost_s * damping_share),
            stiffest_n_m: Number::of(min(budget_n_s_m / stiffness_cost_s, quantised_n_m)),
        }
    }

    /// The nearest passive wall to the one of an asset.
    #[inline]
    #[must_use]
    pub fn wall(
        &self,
        stiffness_n_m: A::Scalar<NewtonPerMetre>,
        damping_n_s_m: A::Scalar<NewtonSecondPerMetre>,
    ) -> Wall<A> {
        let stiffness_n_m = Number::min(Number(stiffness_n_m), self.stiffest_n_m);
        let taken_n_s_m = stiffness_n_m.times_within(self.stiffness_cost_s, DAMPEST_N_S_M);
        let left_n_s_m: Number<A, NewtonSecondPerMetre> = self.damping_n_s_m - taken_n_s_m;
        Wall {
            stiffness_n_m: stiffness_n_m.0,
            damping_n_s_m: left_n_s_m.clamp_from_zero(Number(damping_n_s_m)).0,
        }
    }
}

impl<A: Arithmetic> Wall<A> {
    /// None at all.
    pub(crate) const NONE: Self = Self {
        stiffness_n_m: A::Scalar::ZERO,
        damping_n_s_m: A::Scalar::ZERO,
    };

    /// k·δ, N, of a depth δ ≥ 0.
    #[inline(always)]
    pub(crate) fn spring_n(&self, depth_m: Number<A, Metre>) -> Number<A, Newton> {
        Number(self.stiffness_n_m).times_within(depth_m, STRONGEST_N)
    }

    /// Normal force `k·δ − b·ḋ`, N, never pulling: `spring_n` is k·δ (0 out of contact),
    /// `outward_m_s` is ḋ.
    #[inline]
    #[must_use]
    pub fn force_n(
        &self,
        spring_n: A::Scalar<Newton>,
        outward_m_s: A::Scalar<MetrePerSecond>,
    ) -> A::Scalar<Newton> {
        let spring_n = Number::<A, Newton>(spring_n);
        let outward_m_s = Number::<A, MetrePerSecond>(outward_m_s);
        let damping_n_s_m = Number::<A, NewtonSecondPerMetre>(self.damping_n_s_m);
        let damped_n = damping_n_s_m.times_within(outward_m_s, STRONGEST_N);
        A::left_of(spring_n.0, damped_n.0)
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
        let wall =
            Passivity::<Float>::new(&config.mechanics, config.servo_rate_hz).wall(500.0, 0.1);
        assert_eq!((wall.stiffness_n_m, wall.damping_n_s_m), (500.0, 0.1));
    }

    #[test]
    fn quantisation_without_friction_leaves_no_wall() {
        let mechanics = MechanicsConfig {
            coulomb_n: 0.0,
            ..crate::Config::default().mechanics
        };
        assert_eq!(
            Passivity::<Float>::new(&mechanics, 1000.0)
                .wall(500.0, 0.1)
                .stiffness_n_m,
            0.0
        );
    }

    #[test]
    fn a_wall_never_pulls() {
        let wall = Wall::<Float> {
            stiffness_n_m: 500.0,
            damping_n_s_m: 1.0,
        };
        assert_eq!(wall.force_n(0.1, 5.0), 0.0);
        assert_eq!(wall.force_n(0.0, -5.0), 0.0);
        assert_eq!(wall.force_n(0.1, -0.5), 0.6);
    }
}
