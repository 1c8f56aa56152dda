//! The autocorrelation of a spectrum that is known over the band of the segments.

use asperity_recording::{
    segments::{BAND_HZ, LAGS, POINTS, frequencies_hz},
    timeline::RATE_HZ,
};
use std::f64::consts::TAU;

/// The inverse cosine transform of a spectrum that goes on at its ends.
#[derive(Debug, Clone)]
pub(super) struct Transform {
    /// Frequencies below and above those of a segment.
    beyond: (usize, usize),
    /// Cosines of every lag at every frequency.
    cosines: Vec<Vec<f64>>,
}

/// Frequencies at each end whose mean goes on.
const ENDS: usize = 12;

impl Transform {
    pub(super) fn new() -> Self {
        let inner = frequencies_hz();
        let step_hz = (BAND_HZ.1 - BAND_HZ.0) / (POINTS - 1) as f64;
        let below = (BAND_HZ.0 / step_hz) as usize;
        let above = ((0.5 * RATE_HZ - BAND_HZ.1) / step_hz) as usize;
        let all = (0..below)
            .map(|n| (n as f64 + 0.5) * BAND_HZ.0 / below as f64)
            .chain(inner)
            .chain((1..=above).map(|n| BAND_HZ.1 + n as f64 * step_hz));
        let cosines = all
            .map(|freq_hz| {
                (0..=LAGS)
                    .map(|lag| libm::cos(TAU * freq_hz / RATE_HZ * lag as f64))
                    .collect()
            })
            .collect();
        Self {
            beyond: (below, above),
            cosines,
        }
    }

    /// Autocorrelation at lags 0..=[`LAGS`] of the power at the frequencies of a segment.
    pub(super) fn lags(&self, power: &[f64]) -> Vec<f64> {
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (low, high) = (mean(&power[..ENDS]), mean(&power[POINTS - ENDS..]));
        let all = std::iter::repeat_n(low, self.beyond.0)
            .chain(power.iter().copied())
            .chain(std::iter::repeat_n(high, self.beyond.1));
        let mut lags = vec![0.0; LAGS + 1];
        for (power, cosines) in all.zip(&self.cosines) {
            for (sum, cosine) in lags.iter_mut().zip(cosines) {
                *sum += power * cosine;
            }
        }
        let count = self.cosines.len() as f64;
        lags.into_iter().map(|lag| lag / count).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_texture::signal::spectrum::squared_magnitude;

    #[test]
    fn the_lags_of_a_spectrum_are_those_of_its_model() {
        let power: Vec<f64> = frequencies_hz()
            .into_iter()
            .map(|freq_hz| 1.0 / squared_magnitude(&[1.0, -0.5], TAU * freq_hz / RATE_HZ))
            .collect();
        // r_k = 0.5^k/(1 − 0.25).
        let lags = Transform::new().lags(&power);
        for (k, r) in lags.iter().take(5).enumerate() {
            let expected = libm::pow(0.5, k as f64) / 0.75;
            assert!((r - expected).abs() < 0.02, "{k}: {r} {expected}");
        }
    }
}
