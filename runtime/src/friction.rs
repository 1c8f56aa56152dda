//! Friction: a leaking bristle with a dead zone that slips at μF_n.
//!
//! The bristle's deflection d follows the tangential motion; the force opposes it,
//! `F = k·(|d| − h)` beyond a dead zone h, and never exceeds μF_n: what is more is slip,
//! which moves the bristle's root. The root also creeps, so that
//!
//! ```text
//! ḋ = v − d/τ,   τ = F_n/(k·v_c),   |d| ≤ μF_n/k + h
//! ```
//!
//! in closed form by implicit Euler (a spring in series with a dashpot and a slider; after
//! Hayward and Armstrong). Hence
//!
//! * **No sign at rest.** |d| is never more than the range of the positions, which noise of
//!   ±1 count keeps inside the dead zone; the leak brings d back there after a stroke.
//! * **No step in speed.** Steady friction is `F_n·v/v_c − kh` from 0 to μF_n, and d is a
//!   positive average of v·τ that the slider only cuts: if the speed stays within ε of a
//!   steady one, the force stays within `3/2·F_n·ε/v_c` of that one's, and in a ramp of any
//!   acceleration it never changes faster than that (the half is the lead's, below).
//! * **No energy.** k does not depend on the normal force, so the stored energy ½k(|d| − h)²
//!   can only be given back or lost; dashpot and slider only lose. What is left is that the
//!   force is held: up to ½kΔ² a tick of motion Δ.
//!
//! Therefore the force is taken one tick of motion ahead, and one more for every tick of
//! delay: then a held spring takes ½kΔ² instead, as long as the motion has no content above
//! 1/(2πT), 159 Hz at 1 kHz. The lead is at most half the stretch, so that the force leaves
//! the dead zone at zero and without a step in speed. Very close to the dead zone's edge less
//! than ½kΔ² remains: 0.2 µJ in four strokes at 40 Hz, a thousandth of what a device's own
//! friction absorbs on the way.

use crate::{
    FrictionConfig,
    arithmetic::{
        Arithmetic, Float, Four, Number, Three,
        units::{Leak, Metre, Newton, NewtonPerMetre, Ratio, Unit},
    },
    math::max,
};

/// What the bristle is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bristle<A: Arithmetic = Float> {
    stiffness_n_m: Number<A, NewtonPerMetre>,
    /// 1/k, m/N.
    compliance_m_n: Number<A, Unit>,
    dead_zone_m: Number<A, Metre>,
    /// k·v_c·T, N: with a normal force of this much, half the deflection leaks in a tick.
    leak_n: Number<A, Leak>,
    /// k times the ticks that the force is taken ahead, N/m.
    lead_n_m: Number<A, NewtonPerMetre>,
}

/// A deflection is no larger, and a force of the bristle no stronger, where numbers have a range.
const FURTHEST_M: f32 = 1.0;
const STIFFEST_N: f32 = 32_000.0;

impl<A: Arithmetic> Bristle<A> {
    /// Of a loop at `rate_hz` whose force acts `delay_ticks` late.
    #[must_use]
    pub fn new(config: &FrictionConfig, delay_ticks: u32, rate_hz: f32) -> Self {
        Self {
            stiffness_n_m: Number::of(config.stiffness_n_m),
            compliance_m_n: Number::of(1.0 / config.stiffness_n_m),
            dead_zone_m: Number::of(config.dead_zone_m),
            // Above zero, so that no force at all leaves no deflection.
            leak_n: Number::of(max(
                config.stiffness_n_m * config.leak_speed_m_s / rate_hz,
                f32::MIN_POSITIVE,
            )),
            lead_n_m: Number::of(config.stiffness_n_m * (1.0 + delay_ticks as f32)),
        }
    }
}

/// Where the bristle is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionState<A: Arithmetic = Float> {
    deflection_m: Three<A, Metre>,
}

impl<A: Arithmetic> Default for FrictionState<A> {
    fn default() -> Self {
        Self {
            deflection_m: Three::ZERO,
        }
    }
}

/// The bristle after the motion of a tick, before leak and slip.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretched<A: Arithmetic> {
    /// Deflection in the tangent plane, m; the fourth lane means nothing.
    pub(crate) moved_m: Four<A, Metre>,
    /// What belongs to it.
    pub(crate) polar: A::Polar,
}

/// A force vector in the plane, and its size, N.
pub type Force<A> = (
    [<A as Arithmetic>::Scalar<Newton>; 3],
    <A as Arithmetic>::Scalar<Newton>,
);

impl<A: Arithmetic> FrictionState<A> {
    /// One tick. `motion_m` is the displacement since the last tick, `normal_n` is F_n, 0 out
    /// of contact. Returns the force on the hand in the tangent plane and its size, N.
    #[inline]
    pub fn step(
        &mut self,
        bristle: &Bristle<A>,
        motion_m: [A::Scalar<Metre>; 3],
        normal: [A::Scalar<Unit>; 3],
        normal_n: A::Scalar<Newton>,
        mu: A::Scalar<Ratio>,
    ) -> Force<A> {
        let (motion_m, normal) = (Four::vec3(motion_m), Four::vec3(normal));
        let normal_n = Number(normal_n);
        let moved_m = self.moved(motion_m).tangential(normal);
        let limit_n = Number::<A, Ratio>(mu).times(normal_n);
        let stretched = Stretched {
            moved_m,
            polar: A::polar(moved_m.square()),
        };
        let (along, size_n) = self.slip(bristle, stretched, motion_m, normal_n, limit_n);
        let force: Four<A, Newton> = along.scaled(-size_n);
        (force.xyz(), size_n.0)
    }

    /// The deflection with the motion of a tick, not yet in the tangent plane, m.
    #[inline(always)]
    pub(crate) fn moved(&self, motion_m: Four<A, Metre>) -> Four<A, Metre> {
        self.deflection_m.four() + motion_m
    }

    /// Leak, which keeps nothing without a normal force, slip and force: `normal_n` is F_n and
    /// `limit_n` is μF_n. Returns the direction of the deflection and the size of the force against
    /// it, N.
    #[inline(always)]
    pub(crate) fn slip(
        &mut self,
        bristle: &Bristle<A>,
        Stretched { moved_m, polar }: Stretched<A>,
        motion_m: Four<A, Metre>,
        normal_n: Number<A, Newton>,
        limit_n: Number<A, Newton>,
    ) -> (Four<A, Unit>, Number<A, Newton>) {
        let loaded_n = normal_n.to::<Leak>();
        let leaked: Number<A, Unit> = loaded_n.over(loaded_n + bristle.leak_n);
        let slipping_m: Number<A, Metre> = limit_n.times_within(bristle.compliance_m_n, FURTHEST_M);
        let reach_m = slipping_m + bristle.dead_zone_m;
        // What is left of the length: after the leak, and at most the reach.
        let kept = Number::<A, Unit>(A::share(reach_m.0, polar)).min(leaked);
        self.deflection_m = Three::of(moved_m.scaled(kept));

        // The same length, without waiting for its reciprocal.
        let length_m = Number::<A, Metre>(A::length(polar));
        let stretch_m = length_m.times::<_, Metre>(leaked).min(reach_m) - bristle.dead_zone_m;
        let stretch_n: Number<A, Newton> =
            bristle.stiffness_n_m.times_within(stretch_m, STIFFEST_N);
        let half_n = Number::<A, Unit>::of(0.5).times(stretch_n);
        let most_n = half_n.min(limit_n - stretch_n);
        // The deflection lies in the plane: the rest of the motion adds nothing.
        let ahead_n = A::along(motion_m.0, moved_m.0, polar, bristle.lead_n_m.0, STIFFEST_N);
        // From zero to the limit; inside the dead zone the stretch is below zero, and this ends it.
        let lead_n = Number::<A, Newton>(ahead_n).min(most_n).max(-stretch_n);
        (moved_m.direction(polar), stretch_n + lead_n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::norm;

    const UP: [f32; 3] = [0.0, 0.0, 1.0];

    fn bristle() -> Bristle {
        Bristle::new(&crate::Config::default().friction, 0, 1000.0)
    }

    #[test]
    fn sliding_friction_is_mu_times_the_normal_force_against_the_motion() {
        let mut state = FrictionState::default();
        let mut force = [0.0; 3];
        for _ in 0..100 {
            (force, _) = state.step(&bristle(), [1e-4, 1e-4, 3e-4], UP, 0.8, 0.5);
        }
        assert!((norm(force) - 0.4).abs() < 1e-5);
        assert!(force[0] < 0.0 && (force[0] - force[1]).abs() < 1e-6 && force[2] == 0.0);
    }

    /// Before a stroke, and after one: no force, no change of sign.
    #[test]
    fn noise_of_one_count_at_rest_has_no_sign() {
        let mut state = FrictionState::default();
        let mut noise = crate::excitation::Excitation::new(3);
        let (mut last, mut base) = (0.0, 0.0);
        for n in 0..100_000 {
            let gaussian = noise.next_gaussian();
            let count = if gaussian > 0.4 {
                55e-6
            } else if gaussian < -0.4 {
                -55e-6
            } else {
                0.0
            };
            if (40_000..40_100).contains(&n) {
                base += 1e-4;
            }
            let x = base + count;
            let (force, _) = state.step(&bristle(), [x - last, 0.0, 0.0], UP, 1.0, 0.5);
            last = x;
            match n {
                ..40_000 => assert_eq!(norm(force), 0.0),
                40_100.. => assert!(force[0] <= 0.0),
                _ => {}
            }
        }
    }

    #[test]
    fn a_fast_stroke_leaves_the_dead_zone_without_a_step() {
        let config = crate::Config::default().friction;
        for beyond_m in [1e-7_f32, 1e-6, 1e-5] {
            let mut state = FrictionState::default();
            let motion_m = config.dead_zone_m + beyond_m;
            let (force, _) = state.step(&bristle(), [motion_m, 0.0, 0.0], UP, 1.0, 0.5);
            let bound_n = 2.0 * config.stiffness_n_m * beyond_m + 1e-7;
            assert!(norm(force) <= bound_n, "{beyond_m}: {force:?}");
        }
    }

    #[test]
    fn no_normal_force_is_no_friction_whatever_the_leak() {
        for leak_speed_m_s in [0.0, 4e-3] {
            let config = FrictionConfig {
                leak_speed_m_s,
                ..crate::Config::default().friction
            };
            let bristle = Bristle::<Float>::new(&config, 0, 1000.0);
            let mut state = FrictionState::default();
            for normal_n in [0.0, 1e-40, 0.0, 1.0, 0.0] {
                let (force, _) = state.step(&bristle, [1e-3, 0.0, 0.0], UP, normal_n, 0.5);
                assert!(norm(force) <= 0.500_001 * normal_n, "{normal_n}: {force:?}");
            }
        }
    }
}
