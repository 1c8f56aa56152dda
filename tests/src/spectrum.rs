//! Levels of a model and of a signal in third octaves.

use realfft::RealFftPlanner;
use std::f64::consts::{PI, TAU};

/// Length of a block of the averaged spectrum, samples.
const BLOCK: usize = 2048;

/// Bands of a third of an octave, as (centre, lower edge, upper edge) in Hz: from the first
/// band with at least 4 bins to the last one that ends below half the rate.
#[must_use]
pub fn third_octaves(low_hz: f64, rate_hz: f64) -> Vec<(f64, f64, f64)> {
    (-20..30)
        .map(|n| {
            let centre = 1000.0 * 2.0_f64.powf(f64::from(n) / 3.0);
            (
                centre,
                centre * 2.0_f64.powf(-1.0 / 6.0),
                centre * 2.0_f64.powf(1.0 / 6.0),
            )
        })
        .filter(|&(_, low, high)| low >= low_hz && high <= rate_hz / 2.0)
        .collect()
}

/// Welch's averaged periodogram with a Hann window and half overlap. Gives two-sided power per
/// bin for the bins `0..=BLOCK/2`, scaled so that white noise of variance 1 gives 1.
#[must_use]
pub fn periodogram(signal: &[f64]) -> Vec<f64> {
    let fft = RealFftPlanner::<f64>::new().plan_fft_forward(BLOCK);
    let window: Vec<f64> = (0..BLOCK)
        .map(|n| (PI * n as f64 / BLOCK as f64).sin().powi(2))
        .collect();
    let power: f64 = window.iter().map(|w| w * w).sum();
    let mut mean = vec![0.0; BLOCK / 2 + 1];
    let mut blocks = 0.0;
    let (mut input, mut output) = (fft.make_input_vec(), fft.make_output_vec());
    for start in (0..=signal.len().saturating_sub(BLOCK)).step_by(BLOCK / 2) {
        for ((x, s), w) in input.iter_mut().zip(&signal[start..]).zip(&window) {
            *x = s * w;
        }
        if fft.process(&mut input, &mut output).is_ok() {
            blocks += 1.0;
            for (mean, bin) in mean.iter_mut().zip(&output) {
                *mean += bin.norm_sqr() / power;
            }
        }
    }
    mean.iter().map(|m| m / blocks).collect()
}

/// Two-sided power of a model at the bins of [`periodogram`]: level²·|B|²/|A|².
#[must_use]
pub fn model_power(a: &[f64], b: &[f64], level: f64) -> Vec<f64> {
    (0..=BLOCK / 2)
        .map(|bin| {
            let w = TAU * bin as f64 / BLOCK as f64;
            let size = |c: &[f64]| {
                let (mut re, mut im) = (1.0, 0.0);
                for (k, c) in (1..).zip(c) {
                    re += c * (w * f64::from(k)).cos();
                    im -= c * (w * f64::from(k)).sin();
                }
                re * re + im * im
            };
            level * level * size(b) / size(a)
        })
        .collect()
}

/// Level of each band, dB.
#[must_use]
pub fn band_levels_db(power: &[f64], rate_hz: f64, bands: &[(f64, f64, f64)]) -> Vec<f64> {
    let hz = rate_hz / BLOCK as f64;
    bands
        .iter()
        .map(|&(_, low, high)| {
            let sum: f64 = power
                .iter()
                .enumerate()
                .filter(|(bin, _)| (low..high).contains(&(*bin as f64 * hz)))
                .map(|(_, p)| p)
                .sum();
            10.0 * sum.log10()
        })
        .collect()
}
