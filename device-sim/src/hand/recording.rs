//! What a person does who records a surface: taps, and strokes at all speeds and forces.

use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::hand::{HOVER_M, Motion, Script};
use crate::random::unit;

/// Impact speeds that a person tries, m/s.
const TAPS_M_S: [f64; 4] = [0.06, 0.11, 0.19, 0.32];
/// Strokes between two lifts.
const STROKES: usize = 10;
/// Slowest stroke, mm/s, and least load, N.
const LEAST: (f64, f64) = (20.0, 0.25);
/// Fastest stroke, mm/s, and largest load, N: what the device can bear with friction and vibration.
const MOST: (f64, f64) = (230.0, 2.2);
/// Half the width and depth that strokes use, m.
const REACH_M: [f64; 2] = [0.06, 0.04];

/// An irregular session of at least `seconds` over a grid that reaches to a speed and a force.
#[must_use]
pub fn script(seed: u64, seconds: f64, (max_speed_mm_s, max_force_n): (f64, f64)) -> Script {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * unit(&mut rng);
    let (fastest, hardest) = (MOST.0.min(max_speed_mm_s), MOST.1.min(max_force_n));
    let mut motions = Vec::new();
    let mut planned_s = 0.0;
    while planned_s < seconds {
        let hover_m = [between(-0.05, 0.0), between(-0.03, 0.03), HOVER_M];
        motions.push(Motion::Approach {
            to_m: hover_m,
            duration_s: between(1.2, 1.8),
        });
        planned_s += 1.5;
        for speed_m_s in TAPS_M_S.into_iter().chain(TAPS_M_S) {
            motions.push(Motion::Tap {
                speed_m_s: speed_m_s * between(0.92, 1.08),
            });
            planned_s += 0.5;
        }
        let mut at_m = [hover_m[0], hover_m[1]];
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
                planned_s += 2.0 / frequency_hz + 0.4;
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
            planned_s += libm::hypot(to_m[0] - at_m[0], to_m[1] - at_m[1]) / speed_m_s + 0.3;
            at_m = to_m;
        }
        motions.push(Motion::Lift {
            height_m: HOVER_M,
            duration_s: 0.5,
        });
        planned_s += 0.5;
    }
    Script::new(motions)
}

/// Two taps, then strokes of one sine under one load for the rest of `seconds`.
#[must_use]
pub fn sine(seed: u64, seconds: f64, (max_speed_mm_s, max_force_n): (f64, f64)) -> Script {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut between = |low: f64, high: f64| low + (high - low) * unit(&mut rng);
    let amplitude_m = between(0.01, 0.04);
    let fastest_m_s = 1e-3 * MOST.0.min(max_speed_mm_s);
    let frequency_hz = between(0.4, 2.5).min(fastest_m_s / (std::f64::consts::TAU * amplitude_m));
    let force_n = between(0.4, MOST.1.min(max_force_n));
    let tap = Motion::Tap { speed_m_s: 0.15 };
    Script::new(vec![
        Motion::Approach {
            to_m: [0.0, 0.0, HOVER_M],
            duration_s: 1.5,
        },
        tap,
        tap,
        Motion::Scrub {
            amplitude_m,
            frequency_hz,
            cycles: (seconds * frequency_hz).ceil(),
            force_n,
        },
    ])
}
