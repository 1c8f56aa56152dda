//! From the excitation of a model to the level of its vibration, in closed form.
//!
//! A resonance amplifies its excitation, so models of equal level differ in σ; these sums say by how much.
//!
//! ```
//! use asperity_texture::signal::{level, lsf};
//!
//! // White noise through 1 + z⁻¹ has twice its variance.
//! let white = lsf::towards_white_noise(&[0.4, 0.9], 1.0);
//! assert!((level::nyquist_rms(&white) - std::f64::consts::SQRT_2).abs() < 1e-9);
//! // Frequencies that lie close together are a resonance.
//! assert!(level::nyquist_rms(&[0.4, 0.5]) > level::nyquist_rms(&[0.4, 0.9]));
//! ```

use crate::signal::{lsf, reflection};

/// RMS of `(1 + z⁻¹)/A(z)` driven by unit white noise.
#[must_use]
pub fn nyquist_rms(lsf_rad: &[f64]) -> f64 {
    // Ordered LSFs are stable. A filter that rounding makes unstable counts as infinitely loud.
    reflection::step_down(&lsf::to_polynomial(lsf_rad))
        .map_or(f64::INFINITY, |reflection| nyquist_rms_of(&reflection))
}

/// [`nyquist_rms`] of the filter with these reflection coefficients.
///
/// The autocorrelation of 1/A begins with r₀ and r₁ = −k₁r₀. The numerator adds every sample to
/// its predecessor, so the variance is 2(r₀ + r₁).
#[must_use]
pub fn nyquist_rms_of(reflection: &[f64]) -> f64 {
    let first = reflection.first().copied().unwrap_or(0.0);
    (2.0 * all_pole_variance(reflection) * (1.0 - first)).sqrt()
}

/// Variance of `1/A(z)` driven by unit white noise, which is Π 1/(1 − k²).
#[must_use]
pub fn all_pole_variance(reflection: &[f64]) -> f64 {
    let factors = reflection.iter().map(|k| 1.0 / ((1.0 - k) * (1.0 + k)));
    factors.product()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::spectrum::ArmaModel;

    #[test]
    fn the_closed_form_is_the_mean_of_the_spectrum() {
        let lsf_rad = vec![0.3, 0.7, 1.1, 1.9, 2.6];
        let model = ArmaModel {
            sample_rate_hz: 1000.0,
            a: lsf::to_polynomial(&lsf_rad),
            b: vec![1.0, 1.0],
            level_m_s2: 1.0,
        };
        let points = 20_000;
        let mean: f64 = (0..points)
            .map(|n| model.power(500.0 * (f64::from(n) + 0.5) / f64::from(points)))
            .sum::<f64>()
            / f64::from(points);
        assert!((nyquist_rms(&lsf_rad) / mean.sqrt() - 1.0).abs() < 1e-9);
    }
}
