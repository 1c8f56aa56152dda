//! Friction: a leaking bristle with a dead zone that slips at μF_n.
//!
//! The bristle's deflection d follows the tangential motion; the force opposes it,
//! `F = k·(|d| − h)` beyond a dead zone h, and never exceeds μF_n. Any excess is slip, which moves
//! the bristle's root. The root also creeps, so that
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
//! * **No step in speed.** Steady friction is `F_n·v/v_c − kh` from 0 to μF_n, and d is a positive
//!   average of v·τ that the slider only cuts: if the speed stays within ε of a steady speed, the
//!   force stays within `3/2·F_n·ε/v_c` of the steady force, and in a ramp of any acceleration it
//!   never changes faster than that. The lead, below, adds the half.
//! * **No energy.** k does not depend on the normal force, so the stored energy ½k(|d| − h)² can
//!   only be given back or lost; dashpot and slider only lose. One gain remains, because the force
//!   is held for a tick: up to ½kΔ² in a tick of motion Δ.
//!
//! Therefore the force is taken one tick of motion ahead, and one more for every tick of delay. A
//! held spring then takes ½kΔ² instead of giving it, as long as the motion has no content above
//! 1/(2πT), 159 Hz at 1 kHz. The lead is at most half the stretch, so that the force leaves the
//! dead zone at zero and without a step in speed. Very close to the dead zone's edge less than ½kΔ²
//! remains: 0.2 µJ in four strokes at 40 Hz, a thousandth of what a device's own friction absorbs
//! on the way.

use crate::{
    arithmetic::{Arithmetic, Float},
    config::FrictionConfig,
    math::max,
    quantity::{
        Magnitude, Magnitudes, Quantity, StoredVector, Vector,
        unit::{BristleNewtonPerMetre, FineNewton, Fraction, Metre, MetrePerNewton, Newton},
    },
};

/// The bristle, prepared for a servo loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bristle<A: Arithmetic = Float> {
    /// k, N/m.
    stiffness: Quantity<A, BristleNewtonPerMetre>,
    /// 1/k, m/N.
    compliance: Quantity<A, MetrePerNewton>,
    /// h, m.
    dead_zone: Quantity<A, Metre>,
    /// k·v_c·T, N: with a normal force of this much, half the deflection leaks in a tick.
    leak: Quantity<A, FineNewton>,
    /// k times the ticks that the force is taken ahead, N/m.
    lead: Quantity<A, BristleNewtonPerMetre>,
}

impl<A: Arithmetic> Bristle<A> {
    /// The bristle of a loop at `rate_hz` whose force acts `delay_ticks` late.
    #[must_use]
    pub fn new(config: &FrictionConfig, delay_ticks: u32, rate_hz: f32) -> Self {
        Self {
            stiffness: Quantity::of(config.stiffness_n_m),
            compliance: Quantity::of(1.0 / config.stiffness_n_m),
            dead_zone: Quantity::of(config.dead_zone_m),
            // Above zero, so that nothing of the deflection is left without a normal force.
            leak: Quantity::of(max(
                config.stiffness_n_m * config.leak_speed_m_s / rate_hz,
                f32::MIN_POSITIVE,
            )),
            lead: Quantity::of(config.stiffness_n_m * (1.0 + delay_ticks as f32)),
        }
    }
}

/// State of a [`Bristle`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionState<A: Arithmetic = Float> {
    /// d, m, in the tangent plane.
    deflection: StoredVector<A, Metre>,
}

impl<A: Arithmetic> Default for FrictionState<A> {
    fn default() -> Self {
        Self {
            deflection: StoredVector::ZERO,
        }
    }
}

/// The friction force: its size, N, against a direction in the tangent plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction<A: Arithmetic = Float> {
    /// Direction of the deflection: the force on the hand points the other way.
    pub direction: Vector<A, Fraction>,
    /// Size, N.
    pub size: Quantity<A, Newton>,
}

impl<A: Magnitudes> Friction<A> {
    /// The force on the hand, N.
    #[must_use]
    pub fn force(&self) -> Vector<A, Newton> {
        self.direction * -self.size
    }
}

impl<A: Magnitudes> Bristle<A> {
    /// The deflection that a tick begins with, and the one that a `motion` takes it to before it
    /// slips or creeps, m.
    pub(crate) fn lengths(
        &self,
        state: &FrictionState<A>,
        motion: Vector<A, Metre>,
        normal: Vector<A, Fraction>,
    ) -> [Quantity<A, Metre>; 2] {
        let before = state.deflection.get();
        let after = (before + motion).tangential(normal).settled();
        [before, after].map(|deflection| Magnitude::above_zero(deflection).length())
    }

    /// The force of a deflection of a length, m, without the lead, N.
    pub(crate) fn force(&self, length: Quantity<A, Metre>) -> Quantity<A, Newton> {
        self.stiffness * (length - self.dead_zone).max(Quantity::ZERO)
    }

    /// Advances by a tick: `motion` is the displacement since the last one, m, `normal` n̂, `grip`
    /// F_n, N, 0 out of contact, with what drag adds, and `limit` the largest friction, N: μF_n and
    /// the drag.
    #[inline(always)]
    pub fn step(
        &self,
        state: &mut FrictionState<A>,
        motion: Vector<A, Metre>,
        normal: Vector<A, Fraction>,
        grip: Quantity<A, Newton>,
        limit: Quantity<A, Newton>,
    ) -> Friction<A> {
        let deflection = (state.deflection.get() + motion)
            .tangential(normal)
            .settled();
        let magnitude = Magnitude::above_zero(deflection);

        // Leak and slip: without a load nothing is kept.
        let fine = grip.to::<FineNewton>();
        let leaked = fine.over(fine + self.leak);
        let reach = limit * self.compliance + self.dead_zone;
        let kept = magnitude.divides(reach).min(leaked);
        state.deflection = (deflection * kept).into();

        // The kept length, from the length alone: the inverse is known later.
        let stretch = (magnitude.length() * leaked).min(reach) - self.dead_zone;
        let held = self.stiffness * stretch;
        let most = (Quantity::<A, Fraction>::of(0.5) * held).min(limit - held);
        // The deflection lies in the plane: a motion out of it adds nothing.
        let ahead = self.lead * motion.along(deflection, magnitude);
        // The bounds keep the force from zero to the limit. Inside the dead zone, where the stretch
        // is below zero, they make it zero.
        let lead = ahead.min(most).max(-held);
        Friction {
            direction: deflection.direction(magnitude),
            size: held + lead,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{config::Config, math::norm};

    /// Advances a tick on a plane and returns the force on the hand, N.
    fn step(
        bristle: &Bristle,
        state: &mut FrictionState,
        motion_m: [f32; 3],
        load_n: f32,
        mu: f32,
    ) -> [f32; 3] {
        let (motion, normal) = (Vector::of(motion_m), Vector::of([0.0, 0.0, 1.0]));
        let friction = bristle.step(
            state,
            motion,
            normal,
            Quantity::of(load_n),
            Quantity::of(mu * load_n),
        );
        friction.force().values()
    }

    fn bristle() -> Bristle {
        Bristle::new(&Config::default().friction, 0, 1000.0)
    }

    #[test]
    fn sliding_friction_is_mu_times_the_normal_force_against_the_motion() {
        let mut state = FrictionState::default();
        let mut force = [0.0; 3];
        for _ in 0..100 {
            force = step(&bristle(), &mut state, [1e-4, 1e-4, 3e-4], 0.8, 0.5);
        }
        assert!((norm(force) - 0.4).abs() < 1e-5);
        assert!(force[0] < 0.0 && (force[0] - force[1]).abs() < 1e-6 && force[2] == 0.0);
    }

    /// Before a stroke, and after one: no force, no change of sign.
    #[test]
    fn noise_of_one_count_at_rest_has_no_sign() {
        let mut state = FrictionState::default();
        let mut noise = crate::stage::excitation::Excitation::new(3);
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
            let force = step(&bristle(), &mut state, [x - last, 0.0, 0.0], 1.0, 0.5);
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
        let config = Config::default().friction;
        for beyond_m in [1e-7_f32, 1e-6, 1e-5] {
            let mut state = FrictionState::default();
            let motion_m = config.dead_zone_m + beyond_m;
            let force = step(&bristle(), &mut state, [motion_m, 0.0, 0.0], 1.0, 0.5);
            let bound_n = 2.0 * config.stiffness_n_m * beyond_m + 1e-7;
            assert!(norm(force) <= bound_n, "{beyond_m}: {force:?}");
        }
    }

    #[test]
    fn no_normal_force_is_no_friction_whatever_the_leak() {
        for leak_speed_m_s in [0.0, 4e-3] {
            let config = FrictionConfig {
                leak_speed_m_s,
                ..Config::default().friction
            };
            let bristle = Bristle::<Float>::new(&config, 0, 1000.0);
            let mut state = FrictionState::default();
            for normal_n in [0.0, 1e-40, 0.0, 1.0, 0.0] {
                let force = step(&bristle, &mut state, [1e-3, 0.0, 0.0], normal_n, 0.5);
                assert!(norm(force) <= 0.500_001 * normal_n, "{normal_n}: {force:?}");
            }
        }
    }
}
