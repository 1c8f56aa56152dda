//! A short filter that evens out a device's response.
//!
//! With A(z) the linear predictor of the response's power spectrum, |H|² ≈ g²/|A|². So C = A/g makes
//! C·H flat, and is of minimum phase (`whitening.rs`). A gain then brings the middle of the band to
//! the reference.

#[cfg(test)]
mod tests;
mod whitening;

use super::response::{BAND_HZ, Response, gain_at};
use super::{Compensation, MOST_TAPS, ProfileError};
use whitening::{gain, is_minimum_phase, predictor};

/// Gain to which devices are brought, m/s² a newton: a free mass of 45 g.
pub const REFERENCE_M_S2_N: f64 = 1.0 / 0.045;

/// A filter, and what it leaves.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// The filter.
    pub filter: Compensation,
    /// Largest deviation from the reference within the band, dB, without it.
    pub before_db: f64,
    /// The same with it.
    pub after_db: f64,
}

/// Designs the filter that evens out a response.
#[must_use]
pub fn design(response: &Response) -> Design {
    let rate_hz = response.rate_hz;
    let relative = |freq_hz: f64| gain_at(&response.points, freq_hz) / REFERENCE_M_S2_N;
    let band: Vec<f64> = response
        .points
        .iter()
        .map(|point| point.freq_hz)
        .filter(|freq_hz| (BAND_HZ.0..=BAND_HZ.1).contains(freq_hz))
        .collect();
    let taps = flattened(MOST_TAPS, rate_hz, &band, relative);
    let deviation = |taps: &[f64]| {
        let (low, high) = extremes(taps, rate_hz, &band, relative);
        low.abs().max(high.abs())
    };
    Design {
        before_db: deviation(&[1.0]),
        after_db: deviation(&taps),
        filter: Compensation {
            rate_hz: rate_hz as f32,
            taps: taps.iter().map(|&tap| tap as f32).collect(),
        },
    }
}

/// Level of a response through a filter against the reference, dB, at each of its frequencies, Hz.
#[must_use]
pub fn levels_db(response: &Response, taps: &[f32]) -> Vec<(f64, f64)> {
    let taps: Vec<f64> = taps.iter().map(|&tap| f64::from(tap)).collect();
    let level = |point: &super::response::Point| {
        let filtered = gain(&taps, point.freq_hz / response.rate_hz) * point.gain_m_s2_n;
        let level = 20.0 * libm::log10(filtered / REFERENCE_M_S2_N);
        (point.freq_hz, level)
    };
    response.points.iter().map(level).collect()
}

/// A filter's coefficients for signals of another rate, or with fewer of them: fitted again to its
/// own gain within the band, or what of it the rate shows.
#[must_use]
pub fn taps_at(filter: &Compensation, rate_hz: f64, most: usize) -> Vec<f64> {
    let own: Vec<f64> = filter.taps.iter().map(|&tap| f64::from(tap)).collect();
    let own_hz = f64::from(filter.rate_hz);
    if (rate_hz / own_hz - 1.0).abs() < 1e-6 && own.len() <= most {
        return own;
    }
    let wanted = |freq_hz: f64| 1.0 / gain(&own, freq_hz.min(0.5 * own_hz) / own_hz).max(1e-6);
    let high_hz = BAND_HZ.1.min(0.45 * rate_hz);
    let step_hz = (high_hz - BAND_HZ.0) / 180.0;
    let band: Vec<f64> = (0..=180)
        .map(|n| BAND_HZ.0 + f64::from(n) * step_hz)
        .collect();
    flattened(most.max(1), rate_hz, &band, wanted)
}

/// The filter that makes `response` 1 within the band. Outside of it the response counts as at its
/// border: no coefficient is spent there.
fn flattened(most: usize, rate_hz: f64, band: &[f64], response: impl Fn(f64) -> f64) -> Vec<f64> {
    let (Some(&low_hz), Some(&high_hz)) = (band.first(), band.last()) else {
        return vec![1.0];
    };
    let within = |turns: f64| response((turns * rate_hz).clamp(low_hz, high_hz.max(low_hz)));
    let shape = predictor(most, within);
    // The geometric middle of the largest and the smallest level.
    let (low, high) = extremes(&shape, rate_hz, band, &response);
    let scale = libm::exp10(-0.5 * (low + high) / 20.0);
    shape.iter().map(|tap| tap * scale).collect()
}

/// Smallest and largest level of a response through a filter within the band, dB.
fn extremes(taps: &[f64], rate_hz: f64, band: &[f64], response: impl Fn(f64) -> f64) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    band.iter().fold(start, |(low, high), &freq_hz| {
        let level = 20.0 * libm::log10(gain(taps, freq_hz / rate_hz) * response(freq_hz));
        (low.min(level), high.max(level))
    })
}

/// Checks a filter of a file.
pub(super) fn check(filter: &Compensation, file: &str) -> Result<(), ProfileError> {
    let taps: Vec<f64> = filter.taps.iter().map(|&tap| f64::from(tap)).collect();
    let rule = if taps.is_empty() || taps.len() > MOST_TAPS {
        "it has one to eight coefficients"
    } else if !taps.iter().all(|tap| tap.abs() <= 100.0) || taps[0] == 0.0 {
        "each coefficient is a number of at most 100, and the first is not 0"
    } else if !(filter.rate_hz >= 100.0 && filter.rate_hz <= 20_000.0) {
        "`rate_hz` is 100 to 20000 Hz"
    } else if !is_minimum_phase(&taps) {
        "the filter must be of minimum phase"
    } else {
        return Ok(());
    };
    Err(ProfileError::Filter {
        file: file.into(),
        rule,
    })
}
