//! The coefficient of friction that a tool measures.

use super::{Physical, constants::Constants};

/// Coefficient of kinetic friction: μ₀·μ^p·(E/10 MPa)^q·(h/5 µm)^r, with μ as the corpus states it.
#[must_use]
pub fn mu(constants: &Constants, physical: &Physical) -> f64 {
    let decades = constants.friction_modulus_exponent * physical.hardness_decades()
        + constants.friction_height_exponent * physical.height_decades();
    constants.friction * libm::pow(physical.mu, constants.friction_exponent) * libm::exp10(decades)
}
