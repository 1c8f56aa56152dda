//! From heights to the acceleration spectrum of the stylus.

use super::{Physical, constants::Constants, surface::relief_power};
use crate::Bin;
use asperity_surface::{
    stylus::Support,
    vibration::{self, Spectrum},
};

/// Power spectrum of acceleration with a mean of one. The zero 1 + z⁻¹ of the model multiplies it.
#[must_use]
pub fn spectrum(constants: &Constants, physical: &Physical, stroke: Bin) -> Spectrum {
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
) -> Spectrum {
    let power = std::array::from_fn(|point| {
        let freq_hz = vibration::freq_hz(point);
        let relief = relief_at(freq_hz / stroke.speed_mm_s);
        relief * gain(constants, physical, stroke, freq_hz)
    });
    vibration::normalised(&power, constants.floor)
}

/// Power of acceleration for that of the relief: the contact averages, two derivatives, and a mass
/// on a damped spring that the surface moves.
#[must_use]
pub fn gain(constants: &Constants, physical: &Physical, stroke: Bin, freq_hz: f64) -> f64 {
    let support = Support {
        modulus_mpa: physical.modulus_mpa,
        loss_factor: physical.loss_factor,
        force_n: stroke.force_n,
    };
    let squared = freq_hz * freq_hz;
    fitted_power(freq_hz / stroke.speed_mm_s, constants.contact_mm)
        * squared
        * squared
        * constants.stylus().transmission(&support, freq_hz)
}

/// Returns the power transmission of an average over the contact, on heights: `(1 + (2πkw)²)^(−3/2)` with the contact's
/// length w. The transform of Hertz's pressure, √(1 − x²), falls as k^(−3/2).
fn fitted_power(k_per_mm: f64, contact_mm: f64) -> f64 {
    let x = std::f64::consts::TAU * k_per_mm * contact_mm;
    let squared = 1.0 + x * x;
    1.0 / (squared * squared.sqrt())
}
