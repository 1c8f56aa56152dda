//! From heights to the acceleration spectrum of the stylus.

use super::{
    Physical,
    constants::Constants,
    surface::{contact_power, relief_power},
};
use crate::Bin;

/// Frequencies from 0 to half the rate at which spectra are sampled.
pub const POINTS: usize = 512;
/// Half the loss factor is a damping ratio.
const MATERIAL_DAMPING: f64 = 0.5;

/// Power spectrum of acceleration at [`POINTS`] midpoints from 0 to half the rate, with a mean of
/// one. The zero 1 + z⁻¹ of the model multiplies it.
#[must_use]
pub fn spectrum(constants: &Constants, physical: &Physical, stroke: Bin) -> [f64; POINTS] {
    spectrum_over(constants, physical, stroke, |k| {
        relief_power(constants, physical, k)
    })
}

/// The same over a power of heights before the contact, by spatial frequency, 1/mm.
#[must_use]
pub fn spectrum_over(
    constants: &Constants,
    physical: &Physical,
    stroke: Bin,
    relief_at: impl Fn(f64) -> f64,
) -> [f64; POINTS] {
    let width_hz = 0.5 * crate::SAMPLE_RATE_HZ / POINTS as f64;
    let mut power: [f64; POINTS] = std::array::from_fn(|point| {
        let freq_hz = (point as f64 + 0.5) * width_hz;
        let relief = relief_at(freq_hz / stroke.speed_mm_s);
        relief * gain(constants, physical, stroke, freq_hz)
    });
    let mean = power.iter().sum::<f64>() / POINTS as f64;
    for value in &mut power {
        *value = with_floor(constants, *value / mean);
    }
    power
}

/// A power of mean one, of which the floor takes its share.
#[must_use]
pub fn with_floor(constants: &Constants, power: f64) -> f64 {
    (1.0 - constants.floor) * power + constants.floor
}

/// Power of acceleration for that of the relief: the contact averages, two derivatives, and a mass
/// on a damped spring that the surface moves.
#[must_use]
pub fn gain(constants: &Constants, physical: &Physical, stroke: Bin, freq_hz: f64) -> f64 {
    // The hand's damping acts against the hand, the material's against the surface.
    let material = MATERIAL_DAMPING * physical.loss_factor;
    let damping = constants.hand_damping + material;
    let ratio = freq_hz / resonance_hz(constants, physical, stroke.force_n);
    let detuning = 1.0 - ratio * ratio;
    let drag = 2.0 * damping * ratio;
    let through = 2.0 * material * ratio;
    let transmitted = (1.0 + through * through) / (detuning * detuning + drag * drag);
    let squared = freq_hz * freq_hz;
    contact_power(constants, freq_hz / stroke.speed_mm_s) * squared * squared * transmitted
}

/// Resonance of the stylus on its contact, Hz.
#[must_use]
pub fn resonance_hz(constants: &Constants, physical: &Physical, force_n: f64) -> f64 {
    let modulus = constants.resonance_modulus_exponent * physical.hardness_decades();
    let force = constants.resonance_force_exponent * libm::log10(force_n);
    constants.resonance_hz * libm::exp10(modulus + force)
}
