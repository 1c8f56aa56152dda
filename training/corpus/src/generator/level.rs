//! The level of the vibration that a surface causes.

use super::{Physical, constants::Constants};
use crate::Bin;

/// RMS acceleration over all frequencies, dB re 1 m/s²:
/// `L₀ + p_v·20 log₁₀(v/100 mm/s) + p_F·20 log₁₀(F/1 N)`, with L₀ growing with height and modulus
/// and the exponents with the modulus.
#[must_use]
pub fn rms_db(constants: &Constants, physical: &Physical, stroke: Bin) -> f64 {
    let harder = physical.hardness_decades();
    let at_reference = constants.level_db
        + constants.level_per_height_db * physical.height_decades()
        + constants.level_per_modulus_db * harder;
    let over_speed = constants.speed_exponent + constants.speed_exponent_per_modulus * harder;
    let over_force = constants.force_exponent + constants.force_exponent_per_modulus * harder;
    at_reference
        + over_speed * 20.0 * libm::log10(stroke.speed_mm_s / 100.0)
        + over_force * 20.0 * libm::log10(stroke.force_n)
}
