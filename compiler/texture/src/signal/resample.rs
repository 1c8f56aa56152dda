//! Band-limited resampling between any two whole rates, with a windowed sinc in polyphase form.
//!
//! ```text
//! y[m] = Σ x[n]·h(t_m − n),   t_m = m·f_in/f_out,   h(t) = sinc(2·f_c·t)·kaiser(t/R)
//! ```
//!
//! The cut-off f_c is 0.46 of the lower of both rates, the Kaiser window has β = 8 and reaches over
//! R = 48 samples of that rate on either side. The response is flat within 0.01 dB up to 0.43 of
//! the rate, and images and aliases of what lies below that are at −75 dB or less. A phase's
//! weights sum to 1, so a constant is unchanged; beyond its ends the signal counts as 0.
//!
//! ```
//! use asperity_texture::signal::resample::resample;
//!
//! let raised = resample(&[1.5; 400], 1000, 48_000);
//! assert_eq!(raised.len(), 400 * 48);
//! assert!((raised[200 * 48] - 1.5).abs() < 1e-9);
//! ```

use super::kaiser::{BETA, bessel_i0};
use std::f64::consts::TAU;

/// Samples of the lower rate on each side of an output sample.
const REACH: usize = 48;
/// Cut-off relative to the lower rate.
const CUTOFF: f64 = 0.46;

/// Relative tolerance of the window's series. Frozen bits depend on it.
const TOLERANCE: f64 = 1e-12;

/// The signal at another rate, Hz. Output 0 belongs to the time of input 0.
#[must_use]
pub fn resample(signal: &[f64], from_hz: u32, to_hz: u32) -> Vec<f64> {
    let (from, to) = (u64::from(from_hz.max(1)), u64::from(to_hz.max(1)));
    let common = gcd(from, to);
    let (step, phases) = (from / common, to / common);
    // Where the rate falls, the kernel is wider by their ratio.
    let stretch = (from as f64 / to as f64).max(1.0);
    let reach = (REACH as f64 * stretch).ceil() as usize;
    let count = signal.len() as u64 * phases / step;
    let mut kernels: Vec<Option<Vec<f64>>> = vec![None; phases as usize];
    (0..count)
        .map(|m| {
            let (whole, phase) = ((m * step / phases) as usize, (m * step % phases) as usize);
            let fraction = phase as f64 / phases as f64;
            let weights = kernels[phase].get_or_insert_with(|| kernel(fraction, reach, stretch));
            // Inputs whole + 1 − reach ..= whole + reach, as far as they exist.
            let first = (whole + 1).saturating_sub(reach);
            let last = (whole + reach + 1).min(signal.len());
            let skipped = first + reach - 1 - whole;
            let near = signal[first..last].iter().zip(&weights[skipped..]);
            near.map(|(x, w)| x * w).sum()
        })
        .collect()
}

/// Weights of the 2·`reach` inputs around a point `fraction` of a sample after an input.
fn kernel(fraction: f64, reach: usize, stretch: f64) -> Vec<f64> {
    let mut weights: Vec<f64> = (0..2 * reach)
        .map(|i| {
            let x = i as f64 - (reach as f64 - 1.0) - fraction;
            let angle = TAU * CUTOFF * x / stretch;
            let sinc = if angle == 0.0 {
                1.0
            } else {
                libm::sin(angle) / angle
            };
            let edge = (x / reach as f64).clamp(-1.0, 1.0);
            sinc * bessel_i0(BETA * (1.0 - edge * edge).sqrt(), TOLERANCE)
        })
        .collect();
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= sum);
    weights
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tone(freq_hz: f64, rate_hz: u32, count: usize) -> Vec<f64> {
        (0..count)
            .map(|n| (TAU * freq_hz * n as f64 / f64::from(rate_hz)).sin())
            .collect()
    }

    /// Largest difference away from the ends.
    fn error(a: &[f64], b: &[f64], margin: usize) -> f64 {
        let inner = margin..a.len().min(b.len()) - margin;
        inner.map(|n| (a[n] - b[n]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_tone_within_the_band_is_the_same_tone() {
        for (from, to) in [
            (1000, 44_100),
            (5000, 44_100),
            (50_000, 44_100),
            (1333, 44_100),
        ] {
            let freq_hz = 0.4 * f64::from(from.min(to));
            let raised = resample(&tone(freq_hz, from, from as usize), from, to);
            assert_eq!(raised.len(), to as usize);
            let expected = tone(freq_hz, to, raised.len());
            let error = error(&raised, &expected, 3000);
            assert!(error < 2e-3, "{from} to {to}: {error}");
        }
    }

    #[test]
    fn a_constant_stays_constant_and_time_does_not_shift() {
        let raised = resample(&[1.5; 400], 1000, 48_000);
        assert!(raised[4800..14_400].iter().all(|x| (x - 1.5).abs() < 1e-12));
        let mut impulse = vec![0.0; 401];
        impulse[200] = 1.0;
        let raised = resample(&impulse, 1000, 48_000);
        let top = (0..raised.len()).max_by(|&a, &b| raised[a].total_cmp(&raised[b]));
        assert_eq!(top, Some(200 * 48));
        assert!(resample(&[], 1000, 48_000).is_empty());
        assert_eq!(resample(&[1.0], 1, 4).len(), 4);
    }

    #[test]
    fn what_the_lower_rate_cannot_hold_is_gone() {
        let falling = resample(&tone(24_000.0, 60_000, 60_000), 60_000, 44_100);
        let inner = &falling[3000..falling.len() - 3000];
        assert!(inner.iter().all(|x| x.abs() < 1e-3));
    }
}
