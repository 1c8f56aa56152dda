//! Friction laws against speed: ramps through zero, wandering speeds, steady strokes.

use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::law::{Law, TICK_S};
use asperity_sim::random::unit;

/// Force at each tick of a motion whose speed is `speed(n)`, m/s.
pub fn forces(
    law: &mut Law,
    ticks: usize,
    normal_n: f64,
    speed: impl Fn(usize) -> f64,
) -> Vec<f64> {
    let mut x = 0.0;
    (0..ticks)
        .map(|n| {
            x += speed(n) * TICK_S;
            law(x, normal_n)
        })
        .collect()
}

/// Ticks of steady speed before a ramp.
pub const SETTLE: usize = 15_000;

/// Speeds at each tick, m/s: steady at −`top`, then a ramp at `accel`, m/s², up to `top`.
#[must_use]
pub fn ramp(accel: f64, top: f64) -> Vec<f64> {
    let ticks = (2.0 * top / (accel * TICK_S)).ceil() as usize;
    (0..SETTLE + ticks)
        .map(|n| (-top + accel * TICK_S * n.saturating_sub(SETTLE) as f64).min(top))
        .collect()
}

/// Largest change of F_t/F_n per 0.1 mm/s in a [`ramp`].
#[must_use]
pub fn steepest(law: &mut Law, normal_n: f64, accel: f64, top: f64) -> f64 {
    let speeds = ramp(accel, top);
    let force = forces(law, speeds.len(), normal_n, |n| speeds[n]);
    let force = &force[SETTLE..];
    let per_tick = accel * TICK_S;
    let window =
        ((0.1e-3 / per_tick).round() as usize).clamp(1, force.len().saturating_sub(1).max(1));
    let scale = 0.1e-3 / (per_tick * window as f64);
    force
        .windows(window + 1)
        .map(|w| (w[window] - w[0]).abs() / normal_n * scale)
        .fold(0.0, f64::max)
}

/// The largest [`steepest`] over forces and accelerations.
pub(super) fn steepest_of_all(law: impl Fn() -> Law) -> f64 {
    let mut worst = 0.0_f64;
    for normal_n in [0.05, 0.2, 1.0, 3.0] {
        for (accel, top) in [
            (1e-4, 8e-3),
            (3e-4, 8e-3),
            (1e-3, 8e-3),
            (1e-2, 8e-3),
            (0.1, 0.1),
            (1.0, 0.3),
            (10.0, 0.3),
        ] {
            worst = worst.max(steepest(&mut law(), normal_n, accel, top));
        }
    }
    worst
}

/// Largest deviation of F_t/F_n from its steady value while the speed varies at random, per
/// 0.1 mm/s of the largest deviation of the speed.
#[must_use]
pub fn departure(law: &mut Law, normal_n: f64, steady: f64, within: f64, seed: u64) -> f64 {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let settle = 8000;
    // The speed jumps at random times, so slow and fast variation both occur.
    let mut speeds = Vec::with_capacity(settle + 8000);
    speeds.resize(settle, steady);
    while speeds.len() < settle + 8000 {
        let unit = unit(&mut rng);
        let stretch = 1 + rng.next_u64() as usize % 400;
        speeds.extend(std::iter::repeat_n(
            steady + within * (2.0 * unit - 1.0),
            stretch,
        ));
    }
    let largest = speeds
        .iter()
        .map(|v| (v - steady).abs())
        .fold(0.0, f64::max);
    let force = forces(law, speeds.len(), normal_n, |n| speeds[n]);
    let before = force[settle - 1];
    let far = force[settle..]
        .iter()
        .map(|f| (f - before).abs() / normal_n)
        .fold(0.0, f64::max);
    far * 0.1e-3 / largest
}

/// The largest [`departure`] over forces, speeds and ranges of variation.
pub(super) fn departure_of_all(law: impl Fn() -> Law, seed: u64) -> f64 {
    let mut worst = 0.0_f64;
    for normal_n in [0.05, 0.3, 2.0] {
        for steady in [0.0, 1e-3, 3e-3, 0.01, 0.1] {
            for within in [0.1e-3, 1e-3, 5e-3] {
                worst = worst.max(departure(&mut law(), normal_n, steady, within, seed));
            }
        }
    }
    worst
}

/// Returns the largest deficit of the friction below μF_n in a steady stroke at 10 mm/s, %.
pub(super) fn lacking(mu: f64, law: impl Fn() -> Law) -> f64 {
    [0.1, 0.3, 1.0, 3.0]
        .into_iter()
        .map(|normal_n| {
            let force = forces(&mut law(), 15_000, normal_n, |_| 0.01);
            100.0 * (1.0 - force[14_999].abs() / (mu * normal_n))
        })
        .fold(0.0, f64::max)
}
