//! Heights of a surface along a stroke.

use super::{Physical, constants::Constants};
use asperity_surface::stroke::LEAST_SPREAD_OCTAVES;

/// Power of the second harmonic of a regular relief, whose crests are not sinusoids.
const SECOND_HARMONIC: f64 = 0.06;
/// Exponent of the spread in the power of the broad relief beside the line. A grating has hardly any
/// of it. Too few measured materials are gratings to fit it.
const BACKGROUND_SPREAD_EXPONENT: f64 = 2.0;
/// Wavelength above which the broad relief no longer grows, mm: the hand follows.
const LONGEST_MM: f64 = 50.0;

/// Power of heights at a spatial frequency k, 1/mm, relative to the peak of the line: a log-normal
/// line around `1/wavelength` and a self-affine background k^−b.
#[must_use]
pub fn relief_power(constants: &Constants, physical: &Physical, k_per_mm: f64) -> f64 {
    let spread = physical.spread_octaves.max(LEAST_SPREAD_OCTAVES);
    let cycles = k_per_mm * physical.wavelength_mm;
    let line = |centre: f64| {
        let x = (libm::log2(cycles) - centre) / spread;
        libm::exp(-0.5 * x * x)
    };
    let regular = SECOND_HARMONIC * (1.0 - spread).max(0.0);
    let power = |cycles: f64| libm::pow(cycles, constants.background_slope);
    let broad = constants.background * libm::pow(spread, BACKGROUND_SPREAD_EXPONENT)
        / (power(physical.wavelength_mm / LONGEST_MM) + power(cycles));
    line(0.0) + regular * line(1.0) + broad
}
