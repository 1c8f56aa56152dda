//! The transient of one impact: where it begins, and what it is without the hand.

use super::{TAP_RATE_HZ, TAP_SAMPLES};
use crate::{
    least_squares::solve,
    signal::{
        quantile::{RMS_OF_MEDIAN, median},
        resample::{Clock, resample},
    },
};
use std::ops::Range;

/// Around the landing that the load shows, the transient is looked for, s. A load that was filtered
/// comes early or late.
const SEARCH_S: (f64, f64) = (0.015, 0.03);
/// The hand is known from this much around the landing, s.
const AROUND_S: (f64, f64) = (0.045, 0.055);
/// A transient lies between a part of its peak and its first rise to half of it.
const RISE: f64 = 0.5;
const ONSET: f64 = 0.05;
/// The onset lies above the noise by this factor as well.
const ONSET_OVER_NOISE: f64 = 4.0;
/// An impact is heard this many times above the noise around it.
const ABOVE_NOISE: f64 = 6.0;
/// Samples that are cut before the onset, at [`TAP_RATE_HZ`].
const LEAD: f64 = 1.0;
/// Time kept free of the fit of the hand around the transient, s.
const MARGIN_S: f64 = 0.001;

/// A transient and when it begins.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Trace {
    /// Onset, s, on the clock of the samples.
    pub(super) at_s: f64,
    /// Acceleration, m/s², at [`TAP_RATE_HZ`].
    pub(super) accel_m_s2: Vec<f64>,
}

/// The transient near a landing; `None` where none stands out of the noise.
pub(super) fn trace(samples: &[f32], own: Clock, landing_s: f64) -> Option<Trace> {
    let fine = Clock {
        start_s: landing_s - AROUND_S.0,
        rate_hz: TAP_RATE_HZ,
    };
    let count = ((AROUND_S.0 + AROUND_S.1) * TAP_RATE_HZ) as usize;
    let stretch = resample(samples, own, fine, count);
    let margin = (MARGIN_S * TAP_RATE_HZ) as usize;
    // The place of the transient is not known at first.
    let mut transient = 0..0;
    let mut found = None;
    for _ in 0..3 {
        let hand = Baseline::new(&stretch, &transient)?;
        let first = onset(&stretch, &hand)?;
        let from = first.floor() as usize;
        transient = from.saturating_sub(margin)..(from + TAP_SAMPLES + margin).min(count);
        found = Some((first, hand));
    }
    let (first, hand) = found?;
    let start = Clock {
        start_s: fine.time_s(first - LEAD),
        rate_hz: TAP_RATE_HZ,
    };
    let accel_m_s2 = resample(samples, own, start, TAP_SAMPLES)
        .into_iter()
        .enumerate()
        .map(|(n, a)| a - hand.at(first - LEAD + n as f64))
        .collect();
    Some(Trace {
        at_s: fine.time_s(first),
        accel_m_s2,
    })
}

/// The sample at which the transient begins, with its fraction.
fn onset(stretch: &[f64], hand: &Baseline) -> Option<f64> {
    let apart = |n: usize| (stretch[n] - hand.at(n as f64)).abs();
    let window = ((AROUND_S.0 - SEARCH_S.0) * TAP_RATE_HZ) as usize
        ..(((AROUND_S.0 + SEARCH_S.1) * TAP_RATE_HZ) as usize).min(stretch.len());
    let peak = window.clone().map(apart).fold(0.0, f64::max);
    if peak < ABOVE_NOISE * hand.noise {
        return None;
    }
    let risen = window.clone().find(|&n| apart(n) >= RISE * peak)?;
    let threshold = (ONSET * peak).max(ONSET_OVER_NOISE * hand.noise);
    let before = (window.start..risen)
        .rev()
        .find(|&n| apart(n) < threshold)?;
    let (low, high) = (apart(before), apart(before + 1));
    Some(before as f64 + ((threshold - low) / (high - low).max(1e-300)).clamp(0.0, 1.0))
}

// What the hand does during an impact: a polynomial through the acceleration around it.
//
// A hand that is stopped by a surface goes on accelerating the tool below some 10 Hz, as strongly as a
// light tap. A polynomial of the fourth degree follows that over less than a tenth of a second, and
// cannot follow a transient of some milliseconds.

/// Coefficients.
const TERMS: usize = 5;
/// Rounds of the robust fit.
const ROUNDS: usize = 8;
/// Residuals beyond so many times the noise count less (Huber).
const BOUND: f64 = 1.5;

/// A polynomial over a stretch of samples.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Baseline {
    coefficients: [f64; TERMS],
    length: f64,
    /// RMS of what remains outside the transient.
    noise: f64,
}

impl Baseline {
    /// The polynomial through a stretch, without the samples of `transient`. What is far from it,
    /// such as a transient whose place is not known yet, counts little. `None` of a stretch that is
    /// too short.
    fn new(stretch: &[f64], transient: &Range<usize>) -> Option<Self> {
        let kept: Vec<usize> = (0..stretch.len())
            .filter(|n| !transient.contains(n))
            .collect();
        if kept.len() < 4 * TERMS {
            return None;
        }
        let mut baseline = Self {
            coefficients: [0.0; TERMS],
            length: stretch.len() as f64,
            noise: f64::INFINITY,
        };
        for _ in 0..ROUNDS {
            let bound = BOUND * baseline.noise;
            let (mut normal, mut right) = (vec![vec![0.0; TERMS]; TERMS], vec![0.0; TERMS]);
            for &n in &kept {
                let apart = (stretch[n] - baseline.at(n as f64)).abs();
                let weight = if apart > bound { bound / apart } else { 1.0 };
                let terms = powers(baseline.place(n as f64));
                for ((row, right), x) in normal.iter_mut().zip(&mut right).zip(terms) {
                    for (sum, y) in row.iter_mut().zip(terms) {
                        *sum += weight * x * y;
                    }
                    *right += weight * x * stretch[n];
                }
            }
            baseline.coefficients = solve(normal, right)?.try_into().ok()?;
            let apart = kept
                .iter()
                .map(|&n| (stretch[n] - baseline.at(n as f64)).abs());
            baseline.noise = (RMS_OF_MEDIAN * median(apart)).max(1e-9);
        }
        Some(baseline)
    }

    /// Its value at a sample, which need not be whole.
    fn at(&self, sample: f64) -> f64 {
        powers(self.place(sample))
            .iter()
            .zip(self.coefficients)
            .map(|(x, c)| x * c)
            .sum()
    }

    /// −1..1 over the stretch.
    fn place(&self, sample: f64) -> f64 {
        2.0 * sample / self.length - 1.0
    }
}

/// Chebyshev's polynomials, so that the normal equations are well conditioned.
fn powers(x: f64) -> [f64; TERMS] {
    let mut terms = [1.0, x, 0.0, 0.0, 0.0];
    for n in 2..TERMS {
        terms[n] = 2.0 * x * terms[n - 1] - terms[n - 2];
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::noise::Uniform;

    const RATE_HZ: f64 = 5000.0;

    /// A contact of 1 ms that leaves a mode of 420 Hz, m/s² at a time after the onset.
    fn tap(t_s: f64) -> f64 {
        if t_s < 0.0 {
            return 0.0;
        }
        let pulse = libm::sin(std::f64::consts::PI * (t_s / 0.001).min(1.0));
        let ring = libm::exp(-t_s / 0.002) * libm::sin(std::f64::consts::TAU * 420.0 * t_s);
        8.0 * libm::pow(pulse, 1.5) + 3.0 * ring
    }

    /// The tap at 1 s upon a hand that is stopped as hard, with gravity and the noise of a sensor.
    fn samples(with_tap: bool) -> Vec<f32> {
        let mut noise = Uniform(3);
        (0..10_000)
            .map(|n| {
                let t_s = f64::from(n) / RATE_HZ - 1.0;
                let hand = 6.0 * libm::exp(-((t_s - 0.01) / 0.04).powi(2));
                let tap = if with_tap { tap(t_s) } else { 0.0 };
                (9.81 + hand + tap + 0.1 * noise.next()) as f32
            })
            .collect()
    }

    #[test]
    fn a_transient_is_found_where_it_begins_and_freed_of_the_hand() {
        let clock = Clock {
            start_s: 0.0,
            rate_hz: RATE_HZ,
        };
        let samples = samples(true);
        // The load may tell of the landing early or late.
        for off_s in [-0.02, -0.008, 0.0, 0.006] {
            let found = trace(&samples, clock, 1.0 + off_s).expect("found");
            assert!((found.at_s - 1.0).abs() < 2e-4, "{off_s}: {}", found.at_s);
            let exact = |n: usize| tap(found.at_s - 1.0 + (n as f64 - LEAD) / TAP_RATE_HZ);
            let apart: f64 = (0..TAP_SAMPLES)
                .map(|n| (found.accel_m_s2[n] - exact(n)).powi(2))
                .sum();
            let energy: f64 = (0..TAP_SAMPLES).map(|n| exact(n).powi(2)).sum();
            assert!((apart / energy).sqrt() < 0.1, "{off_s}: {}", apart / energy);
        }
    }

    #[test]
    fn a_hand_that_is_stopped_without_a_tap_is_none() {
        let clock = Clock {
            start_s: 0.0,
            rate_hz: RATE_HZ,
        };
        assert_eq!(trace(&samples(false), clock, 1.0), None);
    }
}

#[cfg(test)]
mod baseline_tests {
    use super::*;

    /// A hand stopped as slowly as hands are, below 10 Hz, and a transient of 4 ms on it that is no stronger.
    #[test]
    fn the_hand_is_told_from_a_transient_as_strong_as_itself() {
        let hand = |n: usize| 4.0 * libm::exp(-((n as f64 - 450.0) / 400.0).powi(2));
        let stretch: Vec<f64> = (0..850)
            .map(|n| {
                let transient = if (400..440).contains(&n) { 4.0 } else { 0.0 };
                hand(n) + transient
            })
            .collect();
        let blind = Baseline::new(&stretch, &(0..0)).expect("long enough");
        let told = Baseline::new(&stretch, &(390..450)).expect("long enough");
        for n in 395..445 {
            assert!((blind.at(n as f64) - hand(n)).abs() < 0.4, "{n}");
            assert!((told.at(n as f64) - hand(n)).abs() < 0.1, "{n}");
        }
    }

    #[test]
    fn a_stretch_that_is_all_transient_has_no_baseline() {
        assert_eq!(Baseline::new(&[1.0; 100], &(5..95)), None);
    }
}
