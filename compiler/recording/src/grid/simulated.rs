//! Segments for the tests: Gaussian vibration whose mean power is known.

use crate::segments::{LAGS, POINTS, Segment, frequencies_hz};

/// Segments of half a second at places that lie evenly over the logarithms of a range of speeds, mm/s, and
/// one of forces, N. `power` is the mean power at a speed, a force and a frequency, Hz.
pub(super) fn segments(
    seed: u64,
    count: usize,
    (speeds, forces): ((f64, f64), (f64, f64)),
    power: impl Fn(f64, f64, f64) -> f64,
) -> Vec<Segment> {
    let mut state = seed;
    let mut unit = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as f64 + 0.5) / f64::from(1_u32 << 31)
    };
    let segment = |n| {
        let speed_mm_s = speeds.0 * libm::pow(speeds.1 / speeds.0, unit());
        let force_n = forces.0 * libm::pow(forces.1 / forces.0, unit());
        let power: Vec<f64> = frequencies_hz()
            .into_iter()
            .map(|freq_hz| -libm::log(unit()) * power(speed_mm_s, force_n, freq_hz))
            .collect();
        Segment {
            start: 500 * n,
            length: 500,
            speed_mm_s,
            force_n,
            lags: vec![power.iter().sum::<f64>() / POINTS as f64; LAGS + 1],
            power,
            is_steady: true,
            statistic: 0.0,
        }
    };
    (0..count).map(segment).collect()
}
