//! From a sampled power spectrum to the AR model of its vibration.

use asperity_texture::signal::{levinson, lsf};
use std::{f64::consts::PI, sync::LazyLock};

/// Rate of the models, Hz.
pub const SAMPLE_RATE_HZ: f64 = 1000.0;
/// Order of the models.
pub const ORDER: usize = 21;
/// Frequencies from 0 to half the rate at which spectra are sampled.
pub const POINTS: usize = 512;

/// Centres of third octaves, as decades of a hertz in tenths: 40 to 400 Hz.
const BANDS: std::ops::RangeInclusive<i32> = 16..=26;

/// A power spectrum at [`POINTS`] midpoints from 0 to half the rate.
pub type Spectrum = [f64; POINTS];

/// cos(lag·ω) at the midpoints, one row for each lag.
static COSINES: LazyLock<Vec<Spectrum>> = LazyLock::new(|| {
    (0..=ORDER)
        .map(|lag| {
            std::array::from_fn(|point| {
                libm::cos(lag as f64 * (point as f64 + 0.5) * PI / POINTS as f64)
            })
        })
        .collect()
});

/// The midpoints, Hz.
#[must_use]
pub fn freq_hz(point: usize) -> f64 {
    let width_hz = 0.5 * SAMPLE_RATE_HZ / POINTS as f64;
    (point as f64 + 0.5) * width_hz
}

/// A power of mean one, of which white noise takes the share `floor`.
#[must_use]
pub fn with_floor(power: f64, floor: f64) -> f64 {
    (1.0 - floor) * power + floor
}

/// A spectrum brought to a mean of one, of which white noise takes the share `floor`.
#[must_use]
pub fn normalised(power: &Spectrum, floor: f64) -> Spectrum {
    let mean = power.iter().sum::<f64>() / POINTS as f64;
    power.map(|value| with_floor(value / mean, floor))
}

/// Share of white noise in calibrated strokes; a test of the corpus compares it.
pub const FLOOR: f64 = 0.05;

/// Lower bound of |1 + e^{−jω}|² when it is divided out; its peak is 4.
///
/// Without the bound, poles would crowd at Nyquist where a source has no zero there. A tenth of
/// this bound would halve the smallest gap between LSFs and gain a hundredth of a decibel below
/// 450 Hz.
const NYQUIST_FLOOR: f64 = 1e-4;

/// A spectrum without the zero 1 + z⁻¹ that a model multiplies it by.
#[must_use]
pub fn without_nyquist(power: &Spectrum) -> Spectrum {
    std::array::from_fn(|point| {
        let omega = (point as f64 + 0.5) * PI / POINTS as f64;
        let zero = 2.0 + 2.0 * libm::cos(omega);
        power[point] / zero.max(NYQUIST_FLOOR)
    })
}

/// Levels of the third octaves from 40 to 400 Hz, dB.
#[must_use]
pub fn bands_db(power: &Spectrum) -> Vec<f64> {
    let width_hz = 0.5 * SAMPLE_RATE_HZ / POINTS as f64;
    let band = |tenths: i32| {
        let edge = |by: f64| libm::exp10(f64::from(tenths) / 10.0 + by) / width_hz;
        let (low, high) = (edge(-0.05), edge(0.05));
        let inside = |n: &usize| (low..high).contains(&(*n as f64 + 0.5));
        let sum: f64 = (0..POINTS).filter(inside).map(|n| power[n]).sum();
        10.0 * libm::log10(sum.max(1e-30))
    };
    BANDS.map(band).collect()
}

/// Line spectral frequencies, rad, of the AR model of order [`ORDER`] whose
/// autocorrelation is that of a positive power spectrum.
#[must_use]
pub fn lsf(power: &Spectrum) -> [f32; ORDER] {
    let autocorrelation: Vec<f64> = COSINES
        .iter()
        .map(|row| row.iter().zip(power).map(|(c, p)| c * p).sum::<f64>() / POINTS as f64)
        .collect();
    let (monic, _) = levinson::from_autocorrelation(&autocorrelation);
    // The recursion gives |r| < 1 for a positive spectrum, hence a stable polynomial.
    let found = lsf::from_polynomial(&monic).unwrap_or_default();
    let mut lsf_rad = [0.0; ORDER];
    for (slot, omega) in lsf_rad.iter_mut().zip(found) {
        *slot = omega as f32;
    }
    lsf_rad
}
