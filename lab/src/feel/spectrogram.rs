//! Power over time and frequency.

use realfft::RealFftPlanner;

use super::error::FeelError;

/// A one-sided power spectral density per window.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrogram {
    /// Power spectral densities, m²/s⁴/Hz: for each window, one value a bin from 0 Hz to half
    /// the rate.
    pub psd: Vec<Vec<f64>>,
    /// Centre of the first window, s.
    pub first_s: f64,
    /// Step between windows, s.
    pub step_s: f64,
    /// Width of a bin, Hz.
    pub bin_hz: f64,
}

/// Hann windows of `length` samples, one every `hop` samples.
///
/// There are none for a signal that is shorter than a window.
///
/// # Errors
/// [`FeelError::Transform`]; none for a `length` and `hop` of at least 1.
pub fn spectrogram(
    signal: &[f64],
    rate_hz: f64,
    length: usize,
    hop: usize,
) -> Result<Spectrogram, FeelError> {
    let forward = RealFftPlanner::<f64>::new().plan_fft_forward(length);
    let window: Vec<f64> = (0..length)
        .map(|n| {
            (std::f64::consts::PI * (n as f64 + 0.5) / length as f64)
                .sin()
                .powi(2)
        })
        .collect();
    let power: f64 = window.iter().map(|w| w * w).sum();
    let mut spectrum = forward.make_output_vec();
    let mut psd = Vec::new();
    for part in signal.windows(length).step_by(hop.max(1)) {
        let mut input: Vec<f64> = part.iter().zip(&window).map(|(x, w)| x * w).collect();
        forward.process(&mut input, &mut spectrum)?;
        let last = spectrum.len() - 1;
        let density = spectrum.iter().enumerate().map(|(bin, value)| {
            // A frequency counts with both signs; 0 Hz and Nyquist have only one.
            let sides = if bin == 0 || (bin == last && length.is_multiple_of(2)) {
                1.0
            } else {
                2.0
            };
            sides * value.norm_sqr() / (rate_hz * power)
        });
        psd.push(density.collect());
    }
    Ok(Spectrogram {
        psd,
        first_s: 0.5 * length as f64 / rate_hz,
        step_s: hop.max(1) as f64 / rate_hz,
        bin_hz: rate_hz / length as f64,
    })
}

impl Spectrogram {
    /// Mean over all windows, one value a bin; empty if there are no windows.
    #[must_use]
    pub fn mean(&self) -> Vec<f64> {
        let bins = self.psd.first().map_or(0, Vec::len);
        let weight = 1.0 / self.psd.len().max(1) as f64;
        (0..bins)
            .map(|bin| weight * self.psd.iter().map(|window| window[bin]).sum::<f64>())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn power_is_conserved_and_stands_at_its_frequency() {
        for frequency_hz in [62.5, 125.0, 250.0, 437.5] {
            let tone: Vec<f64> = (0..4000)
                .map(|n| 3.0 * (std::f64::consts::TAU * frequency_hz * f64::from(n) / 1000.0).sin())
                .collect();
            let mean = spectrogram(&tone, 1000.0, 128, 16)
                .expect("a transform")
                .mean();
            let total: f64 = mean.iter().sum::<f64>() * 1000.0 / 128.0;
            assert!((total - 4.5).abs() < 1e-9, "{frequency_hz}: {total}");
            let top = (0..mean.len())
                .max_by(|&a, &b| mean[a].total_cmp(&mean[b]))
                .expect("a bin");
            assert_eq!(top as f64 * 1000.0 / 128.0, frequency_hz);
        }
    }

    #[test]
    fn a_short_signal_has_no_window() {
        assert!(
            spectrogram(&[1.0; 100], 1000.0, 128, 16)
                .expect("no transform")
                .psd
                .is_empty()
        );
    }
}
