//! Division by a resonance, bounded.
//!
//! The exact inverse of a low-pass of the second order rises with the square of the frequency and would
//! raise the noise without end. The regularised one (Tikhonov),
//!
//! ```text
//! G = (1 + ε) H* / (|H|² + ε),   |G| ≤ (1 + ε) / (2 √ε),
//! ```
//!
//! is the inverse where |H| is well above √ε, and a low-pass where it is below. G(0) = 1.

use realfft::{RealFftPlanner, num_complex::Complex};

/// √ε: G is at most 1/2√ε = 32 dB, and within 1 dB of the inverse down to |H| = 3 √ε, which is reached at
/// 5.3 times the frequency of the resonance.
const ROOT_EPSILON: f64 = 0.0125;
/// Samples that are transformed at once, and those on each side that are not used: the inverse has rung
/// out within them.
const BLOCK: usize = 16_384;
const MARGIN: usize = 2048;

/// H at a frequency.
fn response(freq_hz: f64, resonance_hz: f64, q: f64) -> Complex<f64> {
    let x = freq_hz / resonance_hz;
    Complex::new(1.0, 0.0) / Complex::new(1.0 - x * x, x / q)
}

/// A signal divided by a resonance.
pub(super) fn divided(samples: &[f32], rate_hz: f64, resonance_hz: f64, q: f64) -> Vec<f32> {
    let epsilon = ROOT_EPSILON * ROOT_EPSILON;
    let gain: Vec<Complex<f64>> = (0..=BLOCK / 2)
        .map(|bin| {
            let h = response(bin as f64 * rate_hz / BLOCK as f64, resonance_hz, q);
            h.conj() * ((1.0 + epsilon) / (h.norm_sqr() + epsilon) / BLOCK as f64)
        })
        .collect();
    let mut planner = RealFftPlanner::<f64>::new();
    let (forward, inverse) = (
        planner.plan_fft_forward(BLOCK),
        planner.plan_fft_inverse(BLOCK),
    );
    let last = samples.len().saturating_sub(1);
    let mut divided = Vec::with_capacity(samples.len());
    while divided.len() < samples.len() {
        // Beyond its ends the signal goes on at its last value.
        let at =
            |n: usize| f64::from(samples[(divided.len() + n).saturating_sub(MARGIN).min(last)]);
        let level = at(MARGIN);
        let mut block: Vec<f64> = (0..BLOCK).map(|n| at(n) - level).collect();
        let mut spectrum = forward.make_output_vec();
        let mut done = false;
        // The lengths are those of the plan, so neither can fail.
        if forward.process(&mut block, &mut spectrum).is_ok() {
            spectrum.iter_mut().zip(&gain).for_each(|(x, g)| *x *= g);
            for end in [0, BLOCK / 2] {
                spectrum[end].im = 0.0;
            }
            done = inverse.process(&mut spectrum, &mut block).is_ok();
        }
        debug_assert!(done, "a block of {BLOCK} samples is transformed");
        let count = (BLOCK - 2 * MARGIN).min(samples.len() - divided.len());
        divided.extend(
            block[MARGIN..MARGIN + count]
                .iter()
                .map(|x| (x + level) as f32),
        );
    }
    divided
}

#[cfg(test)]
#[path = "inverse_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const HZ: f64 = 5000.0;

    /// Amplitude and level of a tone with gravity after the division.
    fn passed(freq_hz: f64) -> (f64, f64) {
        let tone: Vec<f32> = (0..40_000)
            .map(|n| (9.81 + libm::sin(TAU * freq_hz * f64::from(n) / HZ)) as f32)
            .collect();
        let out = divided(&tone, HZ, 300.0, 8.0);
        assert_eq!(out.len(), tone.len());
        let middle = &out[5000..35_000];
        let level = middle.iter().map(|x| f64::from(*x)).sum::<f64>() / middle.len() as f64;
        let power = middle
            .iter()
            .map(|x| (f64::from(*x) - level).powi(2))
            .sum::<f64>()
            / middle.len() as f64;
        ((2.0 * power).sqrt(), level)
    }

    #[test]
    fn a_tone_is_divided_by_the_resonance_and_gravity_is_kept() {
        for freq_hz in [20.0, 150.0, 290.0, 300.0, 450.0, 900.0, 1200.0] {
            let (amplitude, level) = passed(freq_hz);
            let exact = 1.0 / response(freq_hz, 300.0, 8.0).norm();
            assert!(
                (20.0 * libm::log10(amplitude / exact)).abs() < 1.0,
                "{freq_hz}: {amplitude} {exact}"
            );
            assert!((level - 9.81).abs() < 1e-3, "{level}");
        }
    }

    #[test]
    fn noise_is_never_raised_beyond_the_bound() {
        for freq_hz in (100..2500).step_by(50) {
            let bound = 1.001 * (1.0 + ROOT_EPSILON.powi(2)) / (2.0 * ROOT_EPSILON);
            assert!(passed(f64::from(freq_hz)).0 < bound);
        }
    }
}
