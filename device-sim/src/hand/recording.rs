//! Script of a person recording a surface: taps, and strokes at all speeds and forces, steady or free.

use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::hand::{HOVER_M, Motion, Script};
use crate::random::unit;

/// Impact speeds that a person tries, m/s.
const TAPS_M_S: [f64; 4] = [0.06, 0.11, 0.19, 0.32];
/// Strokes between two lifts.
const STROKES: usize = 10;
const FREE_STROKES: usize = 15;
/// Largest speed of a minimum-jerk motion over its mean (Flash and Hogan, 1985).
const PEAK: f64 = 1.875;
/// Slowest stroke, mm/s, and least load, N.
const LEAST: (f64, f64) = (20.0, 0.25);
/// Fastest stroke, mm/s, and largest load, N: what the device can bear with friction and vibration.
const MOST: (f64, f64) = (230.0, 2.2);
/// Half the width and depth that strokes use, m.
const REACH_M: [f64; 2] = [0.06, 0.04];

/// An irregular session of at least `seconds` over a grid that reaches to a speed and a force.
#[must_use]
pub fn script(seed: u64, seconds: f64, (max_speed_mm_s, max_force_n): (f64, f64)) -> Script {
    let (fastest, hardest) = (MOST.0.min(max_speed_mm_s), MOST.1.min(max_force_n));
    rounds(seed, seconds, |between, mut at_m, motions, planned_s| {
        for _ in 0..STROKES {
            // As many slow strokes as fast ones, as many light ones as hard ones.
            let speed_m_s = 1e-3 * LEAST.0 * libm::pow(fastest / LEAST.0, between(0.0, 1.0));
            let force_n = LEAST.1 * libm::pow(hardest / LEAST.1, between(0.0, 1.0));
            if between(0.0, 1.0) < 0.3 {
                let amplitude_m = between(0.012, 0.03);
                let room_m = REACH_M[0] - amplitude_m;
                let to_m = [at_m[0].clamp(-room_m, room_m), at_m[1]];
                motions.push(Motion::Stroke {
                    to_m,
                    speed_m_s: 0.08,
                    force_n,
                });
                let frequency_hz = (speed_m_s / (std::f64::consts::TAU * amplitude_m)).min(2.0);
                motions.push(Motion::Scrub {
                    amplitude_m,
                    frequency_hz,
                    cycles: 2.0,
                    force_n,
                });
                *planned_s += 2.0 / frequency_hz + 0.4;
                at_m = to_m;
                continue;
            }
            // To the other side, and not further than a slow stroke goes in two seconds.
            let side = if at_m[0] > 0.0 { -1.0 } else { 1.0 };
            let length_m = (2.0 * speed_m_s).clamp(0.015, 0.11);
            let to_m = [
                (at_m[0] + side * length_m * between(0.7, 1.0)).clamp(-REACH_M[0], REACH_M[0]),
                (at_m[1] + between(-0.02, 0.02)).clamp(-REACH_M[1], REACH_M[1]),
            ];
            motions.push(Motion::Stroke {
                to_m,
                speed_m_s,
                force_n,
            });
            *planned_s += libm::hypot(to_m[0] - at_m[0], to_m[1] - at_m[1]) / speed_m_s + 0.3;
            at_m = to_m;
        }
    })
}

/// The same session by a hand that strokes as it likes: to and fro with minimum-jerk reversals, in arcs and
/// in ellipses, while its force changes.
#[must_use]
pub fn free(seed: u64, seconds: f64, (max_speed_mm_s, max_force_n): (f64, f64)) -> Script {
    let (fastest, hardest) = (MOST.0.min(max_speed_mm_s), MOST.1.min(max_force_n));
    rounds(seed, seconds, |between, mut at_m, motions, planned_s| {
        for _ in 0..FREE_STROKES {
            // The largest speed of the motion, which begins and ends at rest.
            let (least, most) = (3.0 * LEAST.0, fastest.max(3.0 * LEAST.0));
            let peak_m_s = 1e-3 * least * libm::pow(most / least, between(0.0, 1.0));
            let force_n = LEAST.1 * libm::pow(hardest / LEAST.1, between(0.0, 1.0));
            let side = if at_m[0] > 0.0 { -1.0 } else { 1.0 };
            if between(0.0, 1.0) < 0.25 {
                // Around the middle, which keeps it in reach.
                let turns = between(1.0, 4.0).round();
                let duration_s = turns * between(0.45, 0.8);
                motions.push(Motion::Loop {
                    radius_m: side * peak_m_s * duration_s / (PEAK * std::f64::consts::TAU * turns),
                    aspect: between(0.3, 0.8),
                    turns,
                    duration_s,
                    force_n,
                });
                *planned_s += duration_s;
                continue;
            }
            let duration_s = between(0.25, 0.7);
            let length_m = peak_m_s * duration_s / PEAK;
            let rise = between(-0.5, 0.5);
            let to_m = [
                (at_m[0] + side * length_m * (1.0 - rise * rise).sqrt())
                    .clamp(-REACH_M[0], REACH_M[0]),
                (at_m[1] + length_m * rise).clamp(-0.75 * REACH_M[1], 0.75 * REACH_M[1]),
            ];
            motions.push(Motion::Sweep {
                to_m,
                bow_m: length_m * between(-0.15, 0.15),
                duration_s,
                force_n,
            });
            *planned_s += duration_s;
            at_m = to_m;
        }
    })
}

/// Time of an approach and its taps, s.
const LANDING_S: f64 = 5.5;
const LIFT: Motion = Motion::Lift {
    height_m: HOVER_M,
    duration_s: 0.5,
};

/// Rounds of an approach, taps, strokes and a lift, until the planned time is over. `strokes` gets a draw between
/// two numbers, the place in the plane, m, the motions so far and their planned time, s.
fn rounds(
    seed: u64,
    seconds: f64,
    strokes: impl Fn(&mut dyn FnMut(f64, f64) -> f64, [f64; 2], &mut Vec<Motion>, &mut f64),
) -> Script {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * unit(&mut rng);
    let mut motions = Vec::new();
    let mut planned_s = 0.0;
    while planned_s < seconds {
        let hover_m = [between(-0.05, 0.0), between(-0.03, 0.03), HOVER_M];
        motions.push(Motion::Approach {
            to_m: hover_m,
            duration_s: between(1.2, 1.8),
        });
        for speed_m_s in TAPS_M_S.into_iter().chain(TAPS_M_S) {
            motions.push(Motion::Tap {
                speed_m_s: speed_m_s * between(0.92, 1.08),
            });
        }
        planned_s += LANDING_S;
        strokes(
            &mut between,
            [hover_m[0], hover_m[1]],
            &mut motions,
            &mut planned_s,
        );
        motions.push(LIFT);
        planned_s += 0.5;
    }
    Script::new(motions)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half of the Touch's workspace in the plane, m.
    const TOUCH_M: [f64; 2] = [0.08, 0.06];

    #[test]
    fn free_strokes_stay_in_the_workspace_below_their_speed_and_their_force() {
        for seed in 0..200 {
            let mut at_m = [0.0; 2];
            let mut strokes = 0;
            for motion in free(seed, 60.0, (300.0, 3.0)).motions() {
                // Largest distance from the origin along x and y, and the largest speed.
                let (reach_m, peak_m_s, force_n) = match *motion {
                    Motion::Approach { to_m, .. } => {
                        at_m = [to_m[0], to_m[1]];
                        continue;
                    }
                    Motion::Sweep {
                        to_m,
                        bow_m,
                        duration_s,
                        force_n,
                    } => {
                        let length_m = libm::hypot(to_m[0] - at_m[0], to_m[1] - at_m[1]);
                        let reach = |axis: usize| {
                            f64::abs(at_m[axis]).max(f64::abs(to_m[axis])) + f64::abs(bow_m)
                        };
                        let reach_m = [reach(0), reach(1)];
                        at_m = to_m;
                        (reach_m, PEAK * length_m / duration_s, force_n)
                    }
                    Motion::Loop {
                        radius_m,
                        turns,
                        duration_s,
                        force_n,
                        ..
                    } => {
                        let way_m = std::f64::consts::TAU * f64::abs(radius_m) * turns;
                        let across_m = f64::abs(at_m[0] + 2.0 * radius_m).max(f64::abs(at_m[0]));
                        let along_m = f64::abs(at_m[1]) + f64::abs(radius_m);
                        ([across_m, along_m], PEAK * way_m / duration_s, force_n)
                    }
                    _ => continue,
                };
                strokes += 1;
                let inside = reach_m[0] < TOUCH_M[0] && reach_m[1] < TOUCH_M[1];
                assert!(inside, "seed {seed}: {motion:?} from {at_m:?}");
                assert!(peak_m_s < 0.2301, "{motion:?}");
                assert!((LEAST.1..MOST.1).contains(&force_n), "{motion:?}");
            }
            assert!(strokes >= FREE_STROKES);
        }
    }
}
