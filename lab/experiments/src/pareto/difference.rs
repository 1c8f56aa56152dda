//! Difference of two power spectra.

use asperity::signal::spectrum::{ArmaModel, ErrorBand};

/// Number of frequencies at which spectra are compared, 4 Hz apart.
const POINTS: usize = 111;

/// The frequencies at which spectra are compared.
pub struct Band(ErrorBand);

impl Band {
    /// The frequencies for all spectral errors at a sample rate.
    #[must_use]
    pub fn new(sample_rate_hz: f64) -> Self {
        Self(ErrorBand::new(sample_rate_hz, POINTS))
    }

    /// Powers of a model at these frequencies, (m/s²)².
    #[must_use]
    pub fn powers(&self, model: &ArmaModel) -> Vec<f64> {
        let square = model.level_m_s2 * model.level_m_s2;
        let angles = self.0.angles();
        angles
            .squared_magnitudes(&model.b)
            .into_iter()
            .zip(angles.squared_magnitudes(&model.a))
            .map(|(b, a)| square * b / a)
            .collect()
    }
}

/// RMS of the difference of the logarithms of two lists of powers at the same frequencies, dB.
#[must_use]
pub fn distortion_db(truth: &[f64], found: &[f64]) -> f64 {
    let squares = truth.iter().zip(found).map(|(truth, found)| {
        let db = 10.0 * libm::log10(found / truth);
        db * db
    });
    (squares.sum::<f64>() / truth.len() as f64).sqrt()
}
