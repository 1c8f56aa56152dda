//! Filters without phase: a windowed sinc, centred on its sample.

use super::kaiser::{sinc, window};

/// A low-pass of a cut-off given as a fraction of the sample rate. Its transition is some
/// 5/(2·`half`) of the rate wide. At the ends the signal goes on at its last value.
#[must_use]
pub fn low_pass(signal: &[f64], cut_off: f64, half: usize) -> Vec<f64> {
    if signal.is_empty() {
        return Vec::new();
    }
    let mut taps: Vec<f64> = (0..=half)
        .map(|n| sinc(2.0 * cut_off * n as f64) * window(n as f64 / (half + 1) as f64))
        .collect();
    let sum = taps[0] + 2.0 * taps[1..].iter().sum::<f64>();
    taps.iter_mut().for_each(|tap| *tap /= sum);
    let last = signal.len() - 1;
    (0..signal.len())
        .map(|n| {
            let mut y = taps[0] * signal[n];
            if n >= half && n + half <= last {
                for (k, tap) in taps.iter().enumerate().skip(1) {
                    y += tap * (signal[n - k] + signal[n + k]);
                }
            } else {
                for (k, tap) in taps.iter().enumerate().skip(1) {
                    y += tap * (signal[n.saturating_sub(k)] + signal[(n + k).min(last)]);
                }
            }
            y
        })
        .collect()
}

/// Subtracts the low-passed signal.
#[must_use]
pub fn high_pass(signal: &[f64], cut_off: f64, half: usize) -> Vec<f64> {
    let low = low_pass(signal, cut_off, half);
    signal.iter().zip(low).map(|(x, low)| x - low).collect()
}

/// The band between two cut-offs.
#[must_use]
pub fn band_pass(signal: &[f64], (from, to): (f64, f64), half: usize) -> Vec<f64> {
    low_pass(&high_pass(signal, from, half), to, half)
}

/// The derivative by central differences, per sample.
#[must_use]
pub fn derivative(signal: &[f64]) -> Vec<f64> {
    let last = signal.len().saturating_sub(1);
    (0..signal.len())
        .map(|n| {
            let (before, after) = (n.saturating_sub(1), (n + 1).min(last));
            if after == before {
                0.0
            } else {
                (signal[after] - signal[before]) / (after - before) as f64
            }
        })
        .collect()
}

#[cfg(test)]
#[path = "filter_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn gain(frequency: f64, filter: impl Fn(&[f64]) -> Vec<f64>) -> f64 {
        let tone: Vec<f64> = (0..4000)
            .map(|n| libm::sin(TAU * frequency * f64::from(n)))
            .collect();
        let power = |x: &[f64]| x[1000..3000].iter().map(|x| x * x).sum::<f64>();
        (power(&filter(&tone)) / power(&tone)).sqrt()
    }

    #[test]
    fn a_low_pass_keeps_what_lies_below_and_removes_what_lies_above() {
        let filter = |x: &[f64]| low_pass(x, 0.05, 100);
        assert!((gain(0.03, filter) - 1.0).abs() < 1e-3);
        assert!(gain(0.07, filter) < 1e-3);
    }

    #[test]
    fn the_derivative_of_a_ramp_is_its_slope() {
        let ramp: Vec<f64> = (0..9).map(|n| 3.0 * f64::from(n)).collect();
        assert!(derivative(&ramp).iter().all(|d| (d - 3.0).abs() < 1e-12));
        assert_eq!(derivative(&[1.0]), [0.0]);
    }
}
