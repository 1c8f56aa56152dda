//! Heights of a surface along a stroke, as a stylus tip follows them.

use super::Physical;

/// Radius of the tip, mm. The balls of texture probes are about 3 mm in diameter.
const TIP_RADIUS_MM: f64 = 1.6;
/// Narrowest line in the spectrum of a real surface, octaves. No surface is perfectly regular.
const LEAST_SPREAD_OCTAVES: f64 = 0.22;
/// Power of the second harmonic of a regular relief, whose crests are not sinusoids.
const SECOND_HARMONIC: f64 = 0.06;
/// *Calibrated.* Height power of the fractal background, relative to the line, at the
/// dominant wavelength.
const BACKGROUND: f64 = 0.02;
/// Slope of the background: S ∝ k^−(1+2H) with a Hurst exponent H of 0.8.
const BACKGROUND_SLOPE: f64 = 2.6;

/// Power of heights at a spatial frequency k, 1/mm, after the tip; peak about one.
#[must_use]
pub fn height_power(physical: &Physical, k_per_mm: f64, force_n: f64) -> f64 {
    let tip = tip_gain(physical, k_per_mm, force_n);
    relief_power(physical, k_per_mm) * tip * tip
}

/// Power of heights before the tip: a log-normal line around `1/wavelength` and a fractal
/// background.
#[must_use]
pub fn relief_power(physical: &Physical, k_per_mm: f64) -> f64 {
    let spread = physical.spread_octaves.max(LEAST_SPREAD_OCTAVES);
    let octaves = libm::log2(k_per_mm * physical.wavelength_mm);
    let line = |offset: f64| {
        let x = (octaves - offset) / spread;
        libm::exp(-0.5 * x * x)
    };
    // The background rolls off below the dominant frequency: at large scale a surface is flat.
    let background = BACKGROUND / (1.0 + libm::exp2(BACKGROUND_SLOPE * octaves));
    let regular = SECOND_HARMONIC * (1.0 - spread).max(0.0);
    line(0.0) + regular * line(1.0) + background
}

/// What the tip leaves of the amplitude of heights, as they are averaged over the contact:
/// `1/(1 + (2πka)²)` with the Hertzian contact radius a.
#[must_use]
pub fn tip_gain(physical: &Physical, k_per_mm: f64, force_n: f64) -> f64 {
    let x = std::f64::consts::TAU * k_per_mm * contact_radius_mm(physical, force_n);
    1.0 / (1.0 + x * x)
}

/// Hertz: a³ = 3FR/(4E*), at most half the radius of the tip.
#[must_use]
pub fn contact_radius_mm(physical: &Physical, force_n: f64) -> f64 {
    // F in N, R in mm and E in MPa = N/mm² give mm.
    let cubed = 0.75 * force_n * TIP_RADIUS_MM / physical.modulus_mpa;
    libm::cbrt(cubed).min(0.5 * TIP_RADIUS_MM)
}
