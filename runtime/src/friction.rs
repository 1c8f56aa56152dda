//! Friction: a bristle with a dead zone that slips at μF_n.
//!
//! The bristle's deflection d follows the tangential motion; the force opposes it,
//! `F = k·(|d| − h)` beyond a dead zone h, and never exceeds μF_n: what is more is slip,
//! which moves the bristle's root (implicit Euler in closed form, after Hayward and
//! Armstrong). k does not depend on the normal force, so the stored energy
//! ½k(|d| − h)² can only be given back or lost: no closed path gains energy. The force is
//! continuous in position, has no sign to chatter at rest, and can be held at rest; after a
//! reset there is none.
//!
//! While the bristle pulls, its force is taken one tick of motion ahead. A sampled spring
//! held over the following period gives off ½kΔ² a tick; with the lead it takes ½kΔ² as
//! long as the motion has no content above 1/(2πT), 159 Hz at 1 kHz. The lead is never more
//! than the stretch, so the force leaves the dead zone at zero.

use crate::{
    FrictionConfig,
    lanes::F4,
    math::{Vec3, clamp_from_zero, min, rsqrt},
};

/// The bristle.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrictionState {
    deflection_m: Vec3,
}

impl FrictionState {
    /// One tick. `motion_m` is the displacement since the last tick, `limit_n` is
    /// μF_n, 0 out of contact. Returns the force on the hand in the tangent plane and its size,
    /// N.
    #[inline]
    pub fn step(
        &mut self,
        config: &FrictionConfig,
        motion_m: Vec3,
        normal: Vec3,
        limit_n: f32,
        touching: bool,
    ) -> (Vec3, f32) {
        let normal = F4::vec3(normal);
        let reach_m = limit_n / config.stiffness_n_m + config.dead_zone_m;
        let motion_m = F4::vec3(motion_m).tangential(normal);
        let moved = (F4::vec3(self.deflection_m) + motion_m).tangential(normal);
        let squared = moved.dot3(moved);
        let inverse = rsqrt(squared);
        let slip = min(reach_m * inverse, 1.0);
        self.deflection_m = if touching {
            (moved * F4::splat(slip)).xyz()
        } else {
            [0.0; 3]
        };

        let along = moved * F4::splat(inverse);
        let stretch_m = squared * inverse * slip - config.dead_zone_m;
        let lead_m = min(along.dot3(motion_m), stretch_m);
        let force_n = clamp_from_zero(config.stiffness_n_m * (stretch_m + lead_m), limit_n);
        let force_n = if stretch_m > 0.0 { force_n } else { 0.0 };
        ((along * F4::splat(-force_n)).xyz(), force_n)
    }
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "tests run on the host")]
mod tests {
    extern crate std;
    use super::*;
    use crate::math::norm;

    const UP: Vec3 = [0.0, 0.0, 1.0];

    fn config() -> FrictionConfig {
        crate::Config::default().friction
    }

    #[test]
    fn sliding_friction_is_mu_times_the_normal_force_against_the_motion() {
        let mut state = FrictionState::default();
        let mut force = [0.0; 3];
        for _ in 0..100 {
            (force, _) = state.step(&config(), [1e-4, 1e-4, 3e-4], UP, 0.4, true);
        }
        assert!((norm(force) - 0.4).abs() < 1e-5);
        assert!(force[0] < 0.0 && (force[0] - force[1]).abs() < 1e-6 && force[2] == 0.0);
    }

    #[test]
    fn noise_of_one_count_at_rest_gives_no_force() {
        let mut state = FrictionState::default();
        let mut noise = crate::excitation::Excitation::new(3);
        let mut last = 0.0;
        for _ in 0..100_000 {
            let gaussian = noise.next_gaussian();
            let x = if gaussian > 0.4 {
                55e-6
            } else if gaussian < -0.4 {
                -55e-6
            } else {
                0.0
            };
            let (force, _) = state.step(&config(), [x - last, 0.0, 0.0], UP, 0.5, true);
            last = x;
            assert_eq!(norm(force), 0.0);
        }
    }

    #[test]
    fn a_fast_stroke_leaves_the_dead_zone_without_a_step() {
        for beyond_m in [1e-7_f32, 1e-6, 1e-5] {
            let mut state = FrictionState::default();
            let motion_m = config().dead_zone_m + beyond_m;
            let (force, _) = state.step(&config(), [motion_m, 0.0, 0.0], UP, 0.5, true);
            let bound_n = 2.0 * config().stiffness_n_m * beyond_m + 1e-7;
            assert!(norm(force) <= bound_n, "{beyond_m}: {force:?}");
        }
    }

    /// Work done on the hand over closed paths, the force of a tick held until the next.
    #[test]
    fn no_closed_path_gains_energy() {
        let tau = core::f32::consts::TAU;
        for amplitude_m in [1e-4_f32, 3e-4, 1e-3, 1e-2] {
            for frequency_hz in [0.5_f32, 2.0, 10.0, 40.0] {
                for phase in [0.0_f32, 0.25, 0.5, 0.75] {
                    let mut state = FrictionState::default();
                    let (mut work_j, mut force) = (0.0_f64, [0.0; 3]);
                    let ticks = (4.0 * 1000.0 / frequency_hz) as i32;
                    let mut last = 0.0;
                    for n in 0..=ticks {
                        let t = n as f32 * 1e-3 * frequency_hz;
                        let x = amplitude_m * (tau * t).sin();
                        // Pressed harder on the way back: a stiffness tied to the
                        // normal force would gain energy here.
                        let limit_n = 0.4 + 0.3 * (tau * (t + phase)).cos();
                        work_j += f64::from(force[0]) * f64::from(x - last);
                        (force, _) = state.step(&config(), [x - last, 0.0, 0.0], UP, limit_n, true);
                        last = x;
                    }
                    assert!(
                        work_j < 1e-9,
                        "{amplitude_m} {frequency_hz} {phase}: {work_j}"
                    );
                }
            }
        }
    }
}
