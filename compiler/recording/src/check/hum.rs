//! Mains hum: a steady line at 50 or 60 Hz while the tool is in the air.

use super::verdict::{Finding, FindingKind, Severity};
use crate::{
    description::Quantity,
    reader::Recording,
    signal::{
        quantile::{mean, median},
        spectrum::{hann, omegas, periodogram},
    },
    timeline::{Aligned, RATE_HZ, Timeline},
};

/// Samples of a stretch, 1 s: under the Hann window a line is 4 Hz wide.
const STRETCH: usize = 1000;
/// A line as many times stronger than its neighbourhood is hum.
const LINE: f64 = 30.0;
/// Stretches that are looked at.
const MOST: usize = 20;
/// Fewest stretches.
const FEWEST: usize = 2;

/// Lines of the mains that are taken away, Hz.
const LINES_HZ: [f64; 6] = [50.0, 60.0, 100.0, 120.0, 150.0, 180.0];

/// A signal without the lines of the mains, one stretch after the other. Two sensors share their hum and not
/// their delay, so it must not tell one.
pub(super) fn without_hum(signal: &[f64]) -> Vec<f64> {
    let mut rest = signal.to_vec();
    for stretch in rest
        .chunks_mut(STRETCH)
        .filter(|stretch| stretch.len() == STRETCH)
    {
        for line_hz in LINES_HZ {
            let turn = std::f64::consts::TAU * line_hz / RATE_HZ;
            let phases = || (0..STRETCH).map(|n| libm::sincos(turn * n as f64));
            let (mut sine, mut cosine) = (0.0, 0.0);
            for (x, (s, c)) in stretch.iter().zip(phases()) {
                sine += 2.0 * x * s / STRETCH as f64;
                cosine += 2.0 * x * c / STRETCH as f64;
            }
            for (x, (s, c)) in stretch.iter_mut().zip(phases()) {
                *x -= sine * s + cosine * c;
            }
        }
    }
    rest
}

pub(super) fn check(recording: &Recording, aligned: &Aligned, timeline: &Timeline) -> Vec<Finding> {
    let mut starts = Vec::new();
    let mut n = 0;
    while n + STRETCH <= timeline.len() && starts.len() < MOST {
        match timeline.contact[n..n + STRETCH]
            .iter()
            .rposition(|touches| *touches)
        {
            Some(last) => n += last + 1,
            None => {
                starts.push(n);
                n += STRETCH / 2;
            }
        }
    }
    if starts.len() < FEWEST {
        return Vec::new();
    }
    let window = hann(STRETCH);
    let fine = |from, to, count| omegas(RATE_HZ, from, to, count);
    let mut findings = Vec::new();
    for (channel, samples) in recording.channels.iter().zip(&aligned.channels) {
        if !matches!(channel.quantity, Quantity::Acceleration | Quantity::Force) {
            continue;
        }
        for mains_hz in [50.0, 60.0] {
            let power = |omegas: &[f64]| -> Vec<f64> {
                let mut sum = vec![0.0; omegas.len()];
                for &start in &starts {
                    let stretch = &samples[start..start + STRETCH];
                    let level = mean(stretch);
                    let free: Vec<f64> = stretch.iter().map(|x| x - level).collect();
                    for (sum, p) in sum.iter_mut().zip(periodogram(&free, &window, omegas)) {
                        *sum += p / starts.len() as f64;
                    }
                }
                sum
            };
            let line = power(&fine(mains_hz - 0.5, mains_hz + 0.5, 3))
                .into_iter()
                .fold(0.0, f64::max);
            let mut around = power(&fine(mains_hz - 8.0, mains_hz - 4.0, 5));
            around.extend(power(&fine(mains_hz + 4.0, mains_hz + 8.0, 5)));
            if line > LINE * median(around) {
                let rms = (2.0 * line * 1.5 / STRETCH as f64).sqrt();
                let what = format!("hum at {mains_hz} Hz, some {rms:.2e} SI RMS in the air");
                findings.push(Finding::of_channel(
                    &channel.file,
                    &channel.label,
                    FindingKind::Hum,
                    Severity::Warning,
                    what,
                    "shield the cable and ground the tool",
                ));
            }
        }
    }
    findings
}

#[cfg(test)]
#[path = "hum_tests.rs"]
mod laws;
