//! From heights to the acceleration spectrum of the stylus.

use super::{Physical, surface::height_power};

/// Frequencies from 0 to half the rate at which spectra are sampled.
pub const POINTS: usize = 512;
/// *Calibrated.* Resonance of stylus and hand on a contact of 10 MPa, Hz.
const RESONANCE_HZ: f64 = 122.0;
/// *Calibrated.* Exponent of the resonance in the modulus. It is small because the grip is in
/// series.
const RESONANCE_EXPONENT: f64 = 0.09;
/// Exponent of the resonance in force. A Hertzian contact stiffens as F^(1/3), the square root
/// halves the exponent, and the grip halves it again.
const RESONANCE_FORCE_EXPONENT: f64 = 0.08;
/// *Calibrated.* Damping ratio of the hand, to which the material adds.
const HAND_DAMPING: f64 = 0.42;
/// Half the loss factor is a damping ratio.
const MATERIAL_DAMPING: f64 = 0.5;
/// *Calibrated.* Broadband noise that no surface model explains (handle, hand, sensor), as a
/// fraction of the peak.
const FLOOR: f64 = 1.2e-2;

/// Power spectrum of acceleration at [`POINTS`] midpoints from 0 to half the rate, with a peak of
/// one. The zero 1 + z⁻¹ of the model multiplies it.
#[must_use]
pub fn spectrum(physical: &Physical, speed_mm_s: f64, force_n: f64) -> [f64; POINTS] {
    spectrum_over(physical, speed_mm_s, force_n, |k_per_mm| {
        height_power(physical, k_per_mm, force_n)
    })
}

/// The same over a power of heights at the tip, by spatial frequency, 1/mm.
#[must_use]
pub fn spectrum_over(
    physical: &Physical,
    speed_mm_s: f64,
    force_n: f64,
    heights_at: impl Fn(f64) -> f64,
) -> [f64; POINTS] {
    let resonance_hz = resonance_hz(physical, force_n);
    // The hand's damping acts against the hand, the material's against the surface.
    let material = MATERIAL_DAMPING * physical.loss_factor;
    let damping = HAND_DAMPING + material;
    let mut power: [f64; POINTS] = std::array::from_fn(|point| {
        let freq_hz = (point as f64 + 0.5) * 0.5 * crate::SAMPLE_RATE_HZ / POINTS as f64;
        let heights = heights_at(freq_hz / speed_mm_s);
        let squared = freq_hz * freq_hz;
        // Base excitation of a mass on a damped spring.
        let ratio = freq_hz / resonance_hz;
        let detuning = 1.0 - ratio * ratio;
        let drag = 2.0 * damping * ratio;
        let through = 2.0 * material * ratio;
        let transmitted = (1.0 + through * through) / (detuning * detuning + drag * drag);
        heights * squared * squared * transmitted
    });
    let peak = power.iter().copied().fold(0.0, f64::max);
    for value in &mut power {
        *value = *value / peak + FLOOR;
    }
    power
}

/// Resonance of the stylus on its contact, Hz.
#[must_use]
pub fn resonance_hz(physical: &Physical, force_n: f64) -> f64 {
    RESONANCE_HZ
        * libm::pow(physical.modulus_mpa / 10.0, RESONANCE_EXPONENT)
        * libm::pow(force_n, RESONANCE_FORCE_EXPONENT)
}
