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

/// Difference of two power spectra.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// RMS of the difference of their logarithms, level included, dB.
    pub distortion_db: f64,
    /// RMS of that difference without its mean, which leaves the shape alone, dB.
    pub shape_db: f64,
    /// Total power of the second relative to the first, dB.
    pub level_db: f64,
}

impl Difference {
    /// The difference between two lists of powers at the same frequencies.
    #[must_use]
    pub fn of(truth: &[f64], found: &[f64]) -> Self {
        let count = truth.len() as f64;
        let (mut sum, mut squares) = (0.0, 0.0);
        for (truth, found) in truth.iter().zip(found) {
            let db = 10.0 * libm::log10(found / truth);
            sum += db;
            squares += db * db;
        }
        let mean = sum / count;
        let total = |powers: &[f64]| powers.iter().sum::<f64>();
        Self {
            distortion_db: (squares / count).sqrt(),
            shape_db: (squares / count - mean * mean).max(0.0).sqrt(),
            level_db: 10.0 * libm::log10(total(found) / total(truth)),
        }
    }
}
