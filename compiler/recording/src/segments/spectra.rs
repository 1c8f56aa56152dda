//! Spectra and autocorrelations of stretches.

use super::{CEILING_HZ, FLOOR_HZ, LAGS, bins};
use crate::{
    signal::{quantile::mean, spectrum::hann},
    timeline::RATE_HZ,
};
use realfft::{RealFftPlanner, RealToComplex};
use std::{f64::consts::PI, sync::Arc};

/// Band that fills what lies below, Hz.
const FILL_HZ: (f64, f64) = (14.0, 26.0);
/// Band that fills what lies above, Hz.
const FILL_ABOVE_HZ: (f64, f64) = (424.0, 448.0);
/// Length of the transform.
pub(super) const TRANSFORM: usize = 2048;

/// The mean under the square of the window that a spectrum is taken with.
pub(super) fn mean_under_window(values: &[f64]) -> f64 {
    let weights: Vec<f64> = hann(values.len()).into_iter().map(|w| w * w).collect();
    let sum: f64 = values.iter().zip(&weights).map(|(x, w)| x * w).sum();
    sum / weights.iter().sum::<f64>()
}

/// Transforms stretches of any length up to half of [`TRANSFORM`].
pub(super) struct Analyser {
    forward: Arc<dyn RealToComplex<f64>>,
}

impl Analyser {
    pub(super) fn new() -> Self {
        Self {
            forward: RealFftPlanner::new().plan_fft_forward(TRANSFORM),
        }
    }

    /// |X|² of a stretch.
    fn transform(&self, stretch: &[f64]) -> Vec<f64> {
        let mut padded = vec![0.0; TRANSFORM];
        padded[..stretch.len()].copy_from_slice(stretch);
        let mut spectrum = self.forward.make_output_vec();
        // The lengths are those of the plan, so it cannot fail.
        if self.forward.process(&mut padded, &mut spectrum).is_err() {
            return vec![0.0; TRANSFORM / 2 + 1];
        }
        spectrum.iter().map(|x| x.norm_sqr()).collect()
    }

    /// Autocorrelation and power of a stretch, summed over its axes: the power of DFT321 (Landin, Romano,
    /// McMahan, Kuchenbecker, "Dimensional reduction of high-frequency accelerations for haptic rendering", 2010).
    pub(super) fn spectrum(
        &self,
        axes: &[Vec<f64>],
        start: usize,
        length: usize,
    ) -> (Vec<f64>, Vec<f64>) {
        let window = hann(length);
        let energy: f64 = window.iter().map(|w| w * w).sum();
        let mut power = vec![0.0; TRANSFORM / 2 + 1];
        for axis in axes {
            let stretch = &axis[start..start + length];
            let level = mean(stretch);
            let tapered: Vec<f64> = stretch
                .iter()
                .zip(&window)
                .map(|(x, w)| (x - level) * w)
                .collect();
            for (sum, p) in power.iter_mut().zip(self.transform(&tapered)) {
                *sum += p / energy;
            }
        }
        let bin = |freq_hz: f64| (freq_hz * TRANSFORM as f64 / RATE_HZ) as usize;
        let fill = mean(&power[bin(FILL_HZ.0)..bin(FILL_HZ.1)]);
        power[..bin(FLOOR_HZ)].fill(fill);
        let fill = mean(&power[bin(FILL_ABOVE_HZ.0)..bin(FILL_ABOVE_HZ.1)]);
        power[bin(CEILING_HZ)..].fill(fill);
        // The autocorrelation of the window, by which that of the stretch is too small.
        let of_window = lags(&self.transform(&window));
        let lags = lags(&power)
            .into_iter()
            .zip(of_window)
            .map(|(r, w)| r * energy / w)
            .collect();
        (lags, bins().map(|bin| power[bin]).collect())
    }
}

/// The inverse transform of a power spectrum at the first lags.
pub(super) fn lags(power: &[f64]) -> Vec<f64> {
    let last = power.len() - 1;
    (0..=LAGS)
        .map(|lag| {
            let step = lag as f64 * PI / last as f64;
            let twice = 2.0 * libm::cos(step);
            // cos(n·step) by Chebyshev's recurrence.
            let (mut before, mut now) = (libm::cos(step), 1.0);
            let mut sum = 0.0;
            for (n, p) in power.iter().enumerate() {
                let weight = if n == 0 || n == last { 1.0 } else { 2.0 };
                sum += weight * p * now;
                (before, now) = (now, twice * now - before);
            }
            sum / (2 * last) as f64
        })
        .collect()
}
