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
    lanes::F4,
    math::{Vec3, clamp_from_zero, max, min, rsqrt},
};

/// What the bristle is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bristle {
    stiffness_n_m: f32,
    dead_zone_m: f32,
    /// k·v_c·T, N: with a normal force of this much, half the deflection leaks in a tick.
    leak_n: f32,
    lead_ticks: f32,
}

impl Bristle {
    /// Of a loop at `rate_hz` whose force acts `delay_ticks` late.
    #[must_use]
    pub fn new(config: &FrictionConfig, delay_ticks: u32, rate_hz: f32) -> Self {
        Self {
            stiffness_n_m: config.stiffness_n_m,
            dead_zone_m: config.dead_zone_m,
            // Above zero, so that no force at all leaves no deflection.
            leak_n: max(
                config.stiffness_n_m * config.leak_speed_m_s / rate_hz,
                f32::MIN_POSITIVE,
            ),
            lead_ticks: 1.0 + delay_ticks as f32,
        }
    }
}

/// Where the bristle is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionState {
    deflection_m: F4,
}

impl Default for FrictionState {
    fn default() -> Self {
        Self {
            deflection_m: F4::ZERO,
        }
    }
}

impl FrictionState {
    /// One tick. `motion_m` is the displacement since the last tick, `normal_n` is F_n, 0 out
    /// of contact. Returns the force on the hand in the tangent plane and its size, N.
    #[inline]
    pub fn step(
        &mut self,
        bristle: &Bristle,
        motion_m: Vec3,
        normal: Vec3,
        normal_n: f32,
        mu: f32,
        touching: bool,
    ) -> (Vec3, f32) {
        let (motion_m, normal) = (F4::vec3(motion_m), F4::vec3(normal));
        let (force, size_n) = self.advance(bristle, motion_m, normal, normal_n, mu, touching);
        (force.xyz(), size_n)
    }

    /// [`FrictionState::step`] on lanes; the fourth ones are zero.
    #[inline(always)]
    pub(crate) fn advance(
        &mut self,
        bristle: &Bristle,
        motion_m: F4,
        normal: F4,
        normal_n: f32,
        mu: f32,
        touching: bool,
    ) -> (F4, f32) {
        let limit_n = mu * normal_n;
        let reach_m = limit_n / bristle.stiffness_n_m + bristle.dead_zone_m;
        let kept = normal_n / (normal_n + bristle.leak_n);
        let moved = (self.deflection_m + motion_m) * F4::splat(kept);
        let moved = moved.tangential(normal);
        let squared = moved.dot3(moved);
        let inverse = rsqrt(squared);
        let slip = min(reach_m * inverse, 1.0);
        self.deflection_m = if touching {
            moved * F4::splat(slip)
        } else {
            F4::ZERO
        };

        let along = moved * F4::splat(inverse);
        let stretch_m = squared * inverse * slip - bristle.dead_zone_m;
        // `along` lies in the plane: the rest of the motion adds nothing.
        let ahead_m = bristle.lead_ticks * along.dot3(motion_m);
        let lead_m = min(ahead_m, 0.5 * stretch_m);
        let force_n = clamp_from_zero(bristle.stiffness_n_m * (stretch_m + lead_m), limit_n);
        let force_n = if stretch_m > 0.0 { force_n } else { 0.0 };
        (along * F4::splat(-force_n), force_n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::norm;

    const UP: Vec3 = [0.0, 0.0, 1.0];

    fn bristle() -> Bristle {
        Bristle::new(&crate::Config::default().friction, 0, 1000.0)
    }

    #[test]
    fn sliding_friction_is_mu_times_the_normal_force_against_the_motion() {
        let mut state = FrictionState::default();
        let mut force = [0.0; 3];
        for _ in 0..100 {
            (force, _) = state.step(&bristle(), [1e-4, 1e-4, 3e-4], UP, 0.8, 0.5, true);
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
            let (force, _) = state.step(&bristle(), [x - last, 0.0, 0.0], UP, 1.0, 0.5, true);
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
            let (force, _) = state.step(&bristle(), [motion_m, 0.0, 0.0], UP, 1.0, 0.5, true);
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
            let bristle = Bristle::new(&config, 0, 1000.0);
            let mut state = FrictionState::default();
            for normal_n in [0.0, 1e-40, 0.0, 1.0, 0.0] {
                let (force, _) = state.step(&bristle, [1e-3, 0.0, 0.0], UP, normal_n, 0.5, true);
                assert!(norm(force) <= 0.500_001 * normal_n, "{normal_n}: {force:?}");
            }
        }
    }
}
