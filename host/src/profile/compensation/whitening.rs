//! The short filter that makes a gain flat.
//!
//! With A(z) the linear predictor of the power spectrum G², G² ≈ g²/|A|², so |A|·G is flat.
//! Levinson's recursion gives an A whose zeros lie within the unit circle, whatever the spectrum.

use core::f64::consts::PI;

/// Frequencies of a design.
const GRID: usize = 512;

/// The filter of `most` coefficients, 1 first, that makes `gain` flat. `gain` is a function of the
/// fraction of the rate, 0 to 0.5.
pub(super) fn predictor(most: usize, gain: impl Fn(f64) -> f64) -> Vec<f64> {
    let power: Vec<f64> = (0..GRID)
        .map(|n| gain(0.5 * (n as f64 + 0.5) / GRID as f64))
        .map(|gain| gain * gain)
        .collect();
    let autocorrelation: Vec<f64> = (0..most)
        .map(|lag| {
            let at = |n: usize| libm::cos(PI * lag as f64 * (n as f64 + 0.5) / GRID as f64);
            let terms = power.iter().enumerate();
            terms.map(|(n, power)| power * at(n)).sum::<f64>() / GRID as f64
        })
        .collect();
    levinson(&autocorrelation)
}

/// The linear predictor, 1 first.
fn levinson(r: &[f64]) -> Vec<f64> {
    let mut a = vec![1.0];
    // A floor 70 dB down keeps the recursion well-conditioned.
    let mut error = r.first().copied().unwrap_or(0.0) * (1.0 + 1e-7);
    for order in 1..r.len() {
        if error.is_nan() || error <= 0.0 {
            break;
        }
        let sum: f64 = (0..order).map(|k| a[k] * r[order - k]).sum();
        let reflection = (-sum / error).clamp(-0.999, 0.999);
        let last = a.clone();
        a.push(0.0);
        for k in 1..=order {
            a[k] = last.get(k).copied().unwrap_or(0.0) + reflection * last[order - k];
        }
        error *= 1.0 - reflection * reflection;
    }
    a
}

/// Gain of a filter at a fraction of the rate.
pub(super) fn gain(taps: &[f64], turns: f64) -> f64 {
    let (mut re, mut im) = (0.0, 0.0);
    for (k, tap) in taps.iter().enumerate() {
        let angle = 2.0 * PI * turns * k as f64;
        re += tap * libm::cos(angle);
        im -= tap * libm::sin(angle);
    }
    libm::sqrt(re * re + im * im)
}

/// Returns true if every zero of a filter lies within the unit circle: the reflection coefficients
/// of its monic form are all below 1 in magnitude.
pub(super) fn is_minimum_phase(taps: &[f64]) -> bool {
    let mut a = taps.to_vec();
    while a.len() > 1 {
        let last = a.len() - 1;
        let reflection = a[last] / a[0];
        if reflection.is_nan() || reflection.abs() >= 1.0 {
            return false;
        }
        let rest = 1.0 - reflection * reflection;
        a = (0..last)
            .map(|k| (a[k] - reflection * a[last - k]) / rest)
            .collect();
    }
    true
}
