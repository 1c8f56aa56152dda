//! The level of the vibration that a surface causes.

use super::Physical;

/// *Calibrated.* RMS at 100 mm/s and 1 N of a surface of 5 µm, dB re 1 m/s².
const LEVEL_DB: f64 = -1.6;
/// *Calibrated.* dB for a decade of height. The tip rides on the crests, so the level grows more
/// slowly than in proportion to the height, which would be 20 dB.
const PER_DECADE_OF_HEIGHT_DB: f64 = 12.0;
/// dB for a decade of modulus about 10 MPa: soft asperities yield under the tip.
const PER_DECADE_OF_MODULUS_DB: f64 = 0.4;
/// *Calibrated.* Exponent of speed at a wavelength of 0.5 mm, and its growth for an octave: a
/// coarse relief leaves the band at low speed.
const SPEED_EXPONENT: f64 = 0.86;
const SPEED_EXPONENT_PER_OCTAVE: f64 = 0.10;
const SPEED_EXPONENT_RANGE: (f64, f64) = (0.4, 1.6);
/// *Calibrated.* Exponent of force at 10 MPa, and its fall for a decade: a soft contact engages
/// more asperities as it is pressed.
const FORCE_EXPONENT: f64 = 0.24;
const FORCE_EXPONENT_PER_DECADE: f64 = -0.07;
const FORCE_EXPONENT_RANGE: (f64, f64) = (0.0, 0.7);

/// RMS acceleration over all frequencies, dB re 1 m/s²:
/// `L₀ + p_v·20 log₁₀(v/100 mm/s) + p_f·20 log₁₀(F/1 N)`.
#[must_use]
pub fn rms_db(physical: &Physical, speed_mm_s: f64, force_n: f64) -> f64 {
    let softness = libm::log10(physical.modulus_mpa / 10.0);
    let at_reference = LEVEL_DB
        + PER_DECADE_OF_HEIGHT_DB * libm::log10(physical.height_um / 5.0)
        + PER_DECADE_OF_MODULUS_DB * softness;
    at_reference
        + speed_exponent(physical) * 20.0 * libm::log10(speed_mm_s / 100.0)
        + force_exponent(physical) * 20.0 * libm::log10(force_n)
}

/// p_v in RMS ∝ v^p_v.
#[must_use]
pub fn speed_exponent(physical: &Physical) -> f64 {
    let octaves = libm::log2(physical.wavelength_mm / 0.5);
    let (low, high) = SPEED_EXPONENT_RANGE;
    (SPEED_EXPONENT + SPEED_EXPONENT_PER_OCTAVE * octaves).clamp(low, high)
}

/// p_f in RMS ∝ F^p_f.
#[must_use]
pub fn force_exponent(physical: &Physical) -> f64 {
    let decades = libm::log10(physical.modulus_mpa / 10.0);
    let (low, high) = FORCE_EXPONENT_RANGE;
    (FORCE_EXPONENT + FORCE_EXPONENT_PER_DECADE * decades).clamp(low, high)
}
