//! The transients of impacts: Hertz's contact, the hand behind it, the modes of the surface.
//!
//! The mechanics are [`asperity::signal::impact`]; here are the material and the level. A harder material
//! has a shorter contact and higher modes, so its centroid is higher and its force rises faster: that
//! also puts rate-hardness in the right order, the initial rate of force over impact speed (Lawrence
//! et al., 2000). We know of no openly licensed recordings of taps, so none was used. The modes follow
//! measured ones of struck objects (`training/corpora/measured`).

use super::Physical;
use crate::{TAP_SAMPLES, TAPS};
use asperity::signal::impact::{self, Impact};

/// ∫a dt per impact speed: one twenty-fifth of the momentum. The wall returns the rest.
const IMPULSE_PER_SPEED: f64 = 0.04;
/// Strongest acceleration of the fastest tap, m/s²: 90 % of 3.3 N on 0.05 kg.
const PEAK_M_S2: f64 = 59.0;

/// Returns the impact parameters of a surface, which determine its transients.
#[must_use]
pub fn impact(physical: &Physical) -> Impact {
    Impact::of_material(physical.modulus_mpa, physical.loss_factor)
}

/// The bank of traces, m/s² at 10 kHz, by impact speed.
#[must_use]
pub fn bank(physical: &Physical) -> [[f32; TAP_SAMPLES]; TAPS] {
    impact::bank(&impact(physical), IMPULSE_PER_SPEED, PEAK_M_S2)
        .map(|trace| trace.map(|a| a as f32))
}

#[cfg(test)]
mod tests;
