//! The AR model of a power spectrum: autocorrelation and Levinson's recursion.
//!
//! ```
//! use asperity_texture::signal::{levinson, spectrum::squared_magnitude};
//!
//! let truth = [1.0, -1.2, 0.9, -0.3];
//! let (found, sigma) = levinson::all_pole(3, |omega| 4.0 / squared_magnitude(&truth, omega));
//! assert!((sigma - 2.0).abs() < 1e-9);
//! assert!(found.iter().zip(truth).all(|(found, a)| (found - a).abs() < 1e-9));
//! ```

use crate::signal::reflection::step_up;
use std::f64::consts::PI;

/// Frequencies at which the spectrum is sampled from 0 to π.
const POINTS: usize = 2048;

/// An all-pole model `S(ω) ≈ σ²/|A|²` of order `order` for a power spectrum given as a
/// function of ω in (0, π).
///
/// Returns `[1, a_1, …, a_p]` and σ. The spectrum must be positive; a floor some tens of
/// dB below its peak keeps the recursion well conditioned.
#[must_use]
pub fn all_pole(order: usize, spectrum: impl Fn(f64) -> f64) -> (Vec<f64>, f64) {
    let samples: Vec<(f64, f64)> = (0..POINTS)
        .map(|point| (point as f64 + 0.5) * PI / POINTS as f64)
        .map(|omega| (omega, spectrum(omega)))
        .collect();
    let autocorrelation: Vec<f64> = (0..=order)
        .map(|lag| {
            let sum: f64 = samples
                .iter()
                .map(|(omega, power)| power * libm::cos(lag as f64 * omega))
                .sum();
            sum / POINTS as f64
        })
        .collect();
    from_autocorrelation(&autocorrelation)
}

/// The all-pole model whose autocorrelation begins with the given lags 0..=p.
///
/// Returns `[1, a_1, …, a_p]` and σ. The lags must be those of a positive spectrum.
///
/// # Panics
/// When there is no lag at all.
#[must_use]
pub fn from_autocorrelation(autocorrelation: &[f64]) -> (Vec<f64>, f64) {
    let (monic, variance) = recursion(autocorrelation);
    (monic, variance.sqrt())
}

/// Levinson's recursion: `[1, a_1, …, a_p]` and the variance of the excitation for lags 0..=p.
///
/// It stops at the order at which the lags cease to be those of a signal, and leaves the higher
/// coefficients at 0, so the polynomial is always stable.
///
/// # Panics
/// When there is no lag at all.
#[must_use]
pub fn recursion(lags: &[f64]) -> (Vec<f64>, f64) {
    let mut reflection = Vec::with_capacity(lags.len());
    let mut error = lags[0];
    let mut monic = vec![1.0];
    for k in 1..lags.len() {
        let forward: f64 = monic.iter().enumerate().map(|(i, a)| a * lags[k - i]).sum();
        let r = -forward / error;
        if r.is_nan() || r.abs() >= 1.0 {
            monic.resize(lags.len(), 0.0);
            break;
        }
        error *= (1.0 - r) * (1.0 + r);
        reflection.push(r);
        monic = step_up(&reflection);
    }
    (monic, error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::spectrum::squared_magnitude;

    #[test]
    fn an_all_pole_spectrum_is_recovered() {
        let truth = [1.0, -1.2, 0.9, -0.3];
        let (found, sigma) = all_pole(3, |omega| 4.0 / squared_magnitude(&truth, omega));
        assert!((sigma - 2.0).abs() < 1e-9);
        for (found, expected) in found.iter().zip(&truth) {
            assert!((found - expected).abs() < 1e-9);
        }
    }
}
