//! The power spectrum of a model, and how far two of them are apart.
//!
//! ```
//! use asperity_texture::signal::spectrum::{ArmaModel, log_spectral_distance_db};
//!
//! let model = |level_m_s2| ArmaModel {
//!     sample_rate_hz: 1000.0,
//!     a: vec![1.0, -1.2, 0.9],
//!     b: vec![1.0],
//!     level_m_s2,
//! };
//! // The same shape, ten times as strong.
//! assert!((log_spectral_distance_db(&model(1.0), &model(10.0)) - 20.0).abs() < 1e-6);
//! let centroid_hz = |model: ArmaModel| model.vibration().map(|vibration| vibration.centroid_hz);
//! assert!(centroid_hz(model(1.0)).is_some() && centroid_hz(model(0.0)).is_none());
//! ```

mod angles;
mod decibels;

pub use angles::{Angles, squared_magnitude};
pub use decibels::{decibels, rms_db};

use std::f64::consts::TAU;

/// Band of every spectral error, Hz.
pub const ERROR_BAND_HZ: (f64, f64) = (10.0, 450.0);
/// Points of the uniform frequency grid over [`ERROR_BAND_HZ`], both ends included:
/// half a hertz apart.
pub const ERROR_POINTS: usize = 881;
/// Lowest frequency that counts for attributes, Hz. What lies below is motion of the hand.
pub const VIBRATION_FLOOR_HZ: f64 = 40.0;
/// Spacing of the frequencies that band powers are summed over, Hz.
const BAND_STEP_HZ: f64 = 0.25;

/// An ARMA model at its sample rate: `S(ω) = level²·|B|²/|A|²`.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmaModel {
    /// Sample rate, Hz.
    pub sample_rate_hz: f64,
    /// `[1, a_1, …, a_p]`.
    pub a: Vec<f64>,
    /// `[1, b_1, …, b_q]`.
    pub b: Vec<f64>,
    /// Gain times standard deviation of the excitation, m/s².
    pub level_m_s2: f64,
}

impl ArmaModel {
    /// Power spectrum `(gain·σ)²·|B|²/|A|²` at a frequency, (m/s²)². Its mean over all
    /// frequencies is the variance of the vibration.
    #[must_use]
    pub fn power(&self, freq_hz: f64) -> f64 {
        let omega = TAU * freq_hz / self.sample_rate_hz;
        let level = self.level_m_s2;
        level * level * squared_magnitude(&self.b, omega) / squared_magnitude(&self.a, omega)
    }

    /// [`ArmaModel::power`] at every frequency.
    fn powers_at(&self, angles: &Angles) -> Vec<f64> {
        let mut powers = angles.squared_magnitudes(&self.b);
        let level = self.level_m_s2;
        for (power, below) in powers.iter_mut().zip(angles.squared_magnitudes(&self.a)) {
            *power = level * level * *power / below;
        }
        powers
    }

    /// Power at and above [`VIBRATION_FLOOR_HZ`], (m/s²)², and its centroid, Hz;
    /// `None` for a silent model or one whose rate leaves no such band.
    #[must_use]
    pub fn vibration(&self) -> Option<Vibration> {
        VibrationBand::new(self.sample_rate_hz)?.vibration(self)
    }
}

/// The vibration of a model above [`VIBRATION_FLOOR_HZ`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vibration {
    /// Mean square, (m/s²)².
    pub power: f64,
    /// Power-weighted mean frequency, Hz.
    pub centroid_hz: f64,
}

/// The frequencies from [`VIBRATION_FLOOR_HZ`] to half a sample rate, for many models at that rate.
#[derive(Debug, Clone)]
pub struct VibrationBand {
    angles: Angles,
    sample_rate_hz: f64,
    first_hz: f64,
    /// Distance between neighbours, Hz.
    width_hz: f64,
}

impl VibrationBand {
    /// The band of models at a sample rate, Hz. `None` for a rate that leaves no such band.
    #[must_use]
    pub fn new(sample_rate_hz: f64) -> Option<Self> {
        let nyquist = 0.5 * sample_rate_hz;
        let steps = ((nyquist - VIBRATION_FLOOR_HZ) / BAND_STEP_HZ).ceil();
        if steps.is_nan() || steps < 1.0 {
            return None;
        }
        let width_hz = (nyquist - VIBRATION_FLOOR_HZ) / steps;
        let first_hz = VIBRATION_FLOOR_HZ + 0.5 * width_hz;
        let omega = |n: usize| TAU * (first_hz + n as f64 * width_hz) / sample_rate_hz;
        Some(Self {
            angles: Angles::new((0..steps as usize).map(omega)),
            sample_rate_hz,
            first_hz,
            width_hz,
        })
    }

    /// [`ArmaModel::vibration`] of a model at the rate of the band.
    #[must_use]
    pub fn vibration(&self, model: &ArmaModel) -> Option<Vibration> {
        if model.level_m_s2.is_nan() || model.level_m_s2 <= 0.0 {
            return None;
        }
        let (mut sum, mut moment) = (0.0, 0.0);
        for (step, power) in model.powers_at(&self.angles).into_iter().enumerate() {
            let freq_hz = self.first_hz + step as f64 * self.width_hz;
            sum += power;
            moment += freq_hz * power;
        }
        Some(Vibration {
            // One-sided density 2·S/fs, integrated.
            power: sum * self.width_hz * 2.0 / self.sample_rate_hz,
            centroid_hz: moment / sum,
        })
    }
}

/// The uniform frequencies over [`ERROR_BAND_HZ`] at which models are compared; the band ends
/// at 0.45 of the sample rate where that is less.
#[derive(Debug, Clone)]
pub struct ErrorBand(Angles);

impl ErrorBand {
    /// The band of models at a sample rate, Hz, with this many frequencies, both ends included.
    #[must_use]
    pub fn new(sample_rate_hz: f64, points: usize) -> Self {
        Self::up_to(0.45 * sample_rate_hz, sample_rate_hz, points)
    }

    fn up_to(limit_hz: f64, sample_rate_hz: f64, points: usize) -> Self {
        let (low, high) = ERROR_BAND_HZ;
        let step = (high.min(limit_hz) - low) / (points - 1) as f64;
        let omega = |n: usize| TAU * (low + n as f64 * step) / sample_rate_hz;
        Self(Angles::new((0..points).map(omega)))
    }

    /// The frequencies.
    #[must_use]
    pub fn angles(&self) -> &Angles {
        &self.0
    }

    /// [`log_spectral_distance_db`] of models at the rate of the band.
    #[must_use]
    pub fn distance_db(&self, x: &ArmaModel, y: &ArmaModel) -> f64 {
        distance_over((self, x), (self, y))
    }
}

/// RMS over 10–450 Hz of the difference of two log spectra, level included, dB.
///
/// The band ends at 0.45 of the lower sample rate where that is less. Infinite
/// where one of them is silent and the other is not, zero where both are.
#[must_use]
pub fn log_spectral_distance_db(x: &ArmaModel, y: &ArmaModel) -> f64 {
    let limit_hz = 0.45 * x.sample_rate_hz.min(y.sample_rate_hz);
    let [of_x, of_y] =
        [x, y].map(|model| ErrorBand::up_to(limit_hz, model.sample_rate_hz, ERROR_POINTS));
    distance_over((&of_x, x), (&of_y, y))
}

fn distance_over(
    (ErrorBand(of_x), x): (&ErrorBand, &ArmaModel),
    (ErrorBand(of_y), y): (&ErrorBand, &ArmaModel),
) -> f64 {
    match (x.level_m_s2 > 0.0, y.level_m_s2 > 0.0) {
        (true, true) => {}
        (false, false) => return 0.0,
        _ => return f64::INFINITY,
    }
    let mut ratios = x.powers_at(of_x);
    for (x, y) in ratios.iter_mut().zip(y.powers_at(of_y)) {
        *x /= y;
    }
    rms_db(&ratios)
}

/// 512 frequencies from 0 to half a sample rate, for many transients at that rate.
#[derive(Debug, Clone)]
pub struct TraceBand {
    angles: Angles,
    sample_rate_hz: f64,
}

impl TraceBand {
    const BINS: usize = 512;

    /// The band of transients at a sample rate, Hz.
    #[must_use]
    pub fn new(sample_rate_hz: f64) -> Self {
        let omega = |bin| TAU * Self::freq_hz(bin, sample_rate_hz) / sample_rate_hz;
        Self {
            angles: Angles::new((0..Self::BINS).map(omega)),
            sample_rate_hz,
        }
    }

    fn freq_hz(bin: usize, sample_rate_hz: f64) -> f64 {
        0.5 * sample_rate_hz * (bin as f64 + 0.5) / Self::BINS as f64
    }

    /// Power-weighted mean frequency of a transient, Hz; `None` for a silent one.
    #[must_use]
    pub fn centroid_hz(&self, accel_m_s2: &[f64]) -> Option<f64> {
        let (mut sum, mut moment) = (0.0, 0.0);
        let powers = self.angles.squared_magnitudes(accel_m_s2);
        for (bin, power) in powers.into_iter().enumerate() {
            sum += power;
            moment += Self::freq_hz(bin, self.sample_rate_hz) * power;
        }
        (sum > 0.0).then(|| moment / sum)
    }
}

/// Power-weighted mean frequency of a transient, Hz; `None` for a silent one.
///
/// The spectrum is taken at 512 frequencies from 0 to half the rate.
#[must_use]
pub fn trace_centroid_hz(accel_m_s2: &[f64], sample_rate_hz: f64) -> Option<f64> {
    TraceBand::new(sample_rate_hz).centroid_hz(accel_m_s2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn model(a: &[f64], b: &[f64], level_m_s2: f64) -> ArmaModel {
        ArmaModel {
            sample_rate_hz: 1000.0,
            a: a.to_vec(),
            b: b.to_vec(),
            level_m_s2,
        }
    }

    #[test]
    fn a_first_order_model_has_its_textbook_spectrum() {
        let m = model(&[1.0, -0.9], &[1.0], 2.0);
        for freq_hz in [10.0, 100.0, 400.0] {
            let expected = 4.0 / (1.0 + 0.81 - 1.8 * (TAU * freq_hz / 1000.0).cos());
            assert!((m.power(freq_hz) / expected - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_nyquist_zero_is_not_normalised() {
        let m = model(&[1.0], &[1.0, 1.0], 1.0);
        assert!((m.power(0.0) - 4.0).abs() < 1e-12);
        assert!(m.power(500.0) < 1e-12);
    }

    #[test]
    fn distance_is_the_level_difference_of_equal_shapes() {
        let (x, y) = (
            model(&[1.0, -0.5], &[1.0], 1.0),
            model(&[1.0, -0.5], &[1.0], 2.0),
        );
        assert!((log_spectral_distance_db(&x, &y) - 20.0 * 2.0_f64.log10()).abs() < 1e-9);
        assert_eq!(log_spectral_distance_db(&x, &x), 0.0);
        let silent = model(&[1.0], &[1.0], 0.0);
        assert_eq!(log_spectral_distance_db(&silent, &silent), 0.0);
        assert_eq!(log_spectral_distance_db(&x, &silent), f64::INFINITY);
    }

    #[test]
    fn white_noise_has_its_share_above_the_floor() {
        let v = model(&[1.0], &[1.0], 3.0).vibration().unwrap();
        assert!((v.power - 9.0 * 460.0 / 500.0).abs() < 1e-9);
        assert!((v.centroid_hz - 270.0).abs() < 1e-9);
        assert_eq!(model(&[1.0], &[1.0], 0.0).vibration(), None);
    }

    #[test]
    fn the_centroid_of_a_long_tone_is_its_frequency() {
        let tone: Vec<f64> = (0..2000)
            .map(|n| (PI * f64::from(n) * 0.06).sin())
            .collect();
        let centroid = trace_centroid_hz(&tone, 10_000.0).unwrap();
        assert!((centroid - 300.0).abs() < 10.0, "{centroid}");
        assert_eq!(trace_centroid_hz(&[0.0; 8], 10_000.0), None);
    }
}
