//! Power and autocorrelation of short stretches.

use std::f64::consts::{PI, TAU};

/// A Hann window of a length.
#[must_use]
pub fn hann(length: usize) -> Vec<f64> {
    (0..length)
        .map(|n| 0.5 - 0.5 * libm::cos(TAU * (n as f64 + 0.5) / length as f64))
        .collect()
}

/// Autocorrelation at lags 0..=`lags` of a windowed stretch, divided by that of its window, which
/// leaves it without bias.
#[must_use]
pub fn autocorrelation(stretch: &[f64], window: &[f64], lags: usize) -> Vec<f64> {
    let product = |x: &[f64], lag: usize| -> f64 {
        x.iter()
            .zip(x.get(lag..).unwrap_or_default())
            .map(|(a, b)| a * b)
            .sum()
    };
    let tapered: Vec<f64> = stretch.iter().zip(window).map(|(x, w)| x * w).collect();
    (0..=lags)
        .map(|lag| product(&tapered, lag) / product(window, lag).max(1e-12))
        .collect()
}

/// Power of a windowed stretch at frequencies in rad a sample; its mean over all frequencies is the
/// mean square.
#[must_use]
pub fn periodogram(stretch: &[f64], window: &[f64], omegas: &[f64]) -> Vec<f64> {
    let energy: f64 = window.iter().map(|w| w * w).sum();
    let tapered: Vec<f64> = stretch.iter().zip(window).map(|(x, w)| x * w).collect();
    omegas
        .iter()
        .map(|&omega| {
            // Goertzel's recursion.
            let twice = 2.0 * libm::cos(omega);
            let (mut before, mut last) = (0.0, 0.0);
            for x in &tapered {
                (before, last) = (last, x + twice * last - before);
            }
            (last * last + before * before - twice * last * before).max(0.0) / energy
        })
        .collect()
}

/// Frequencies from `from_hz` to `to_hz` in equal steps, rad a sample.
#[must_use]
pub fn omegas(rate_hz: f64, from_hz: f64, to_hz: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|n| from_hz + (to_hz - from_hz) * n as f64 / (count - 1).max(1) as f64)
        .map(|freq_hz| (TAU * freq_hz / rate_hz).min(PI))
        .collect()
}

#[cfg(test)]
#[path = "spectrum_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_has_its_power_at_its_frequency() {
        let tone: Vec<f64> = (0..400).map(|n| libm::sin(0.3 * f64::from(n))).collect();
        let window = hann(400);
        let power = periodogram(&tone, &window, &[0.3, 0.6]);
        // A quarter of N·(mean of the window)²/(mean of its square).
        let expected = 0.25 * 400.0 * 0.25 / 0.375;
        assert!((power[0] / expected - 1.0).abs() < 0.02, "{power:?}");
        assert!(power[1] < 1e-6 * power[0]);
    }

    #[test]
    fn the_autocorrelation_of_a_tone_is_a_cosine() {
        let tone: Vec<f64> = (0..4000).map(|n| libm::sin(0.3 * f64::from(n))).collect();
        for (lag, r) in autocorrelation(&tone, &hann(4000), 40)
            .into_iter()
            .enumerate()
        {
            assert!(
                (r - 0.5 * libm::cos(0.3 * lag as f64)).abs() < 1e-3,
                "{lag}: {r}"
            );
        }
    }
}
