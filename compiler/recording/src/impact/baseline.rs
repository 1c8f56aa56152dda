//! What the hand does during an impact: a polynomial through the acceleration around it.
//!
//! A hand that is stopped by a surface goes on accelerating the tool below some 10 Hz, as strongly as a
//! light tap. A polynomial of the fourth degree follows that over less than a tenth of a second, and
//! cannot follow a transient of some milliseconds.

use crate::{
    autoregression::solve,
    signal::quantile::{RMS_OF_MEDIAN, median},
};
use std::ops::Range;

/// Coefficients.
const TERMS: usize = 5;
/// Rounds of the robust fit.
const ROUNDS: usize = 8;
/// Residuals beyond so many times the noise count less (Huber).
const BOUND: f64 = 1.5;

/// A polynomial over a stretch of samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Baseline {
    coefficients: [f64; TERMS],
    length: f64,
    /// RMS of what remains outside the transient.
    pub(super) noise: f64,
}

impl Baseline {
    /// The polynomial through a stretch, without the samples of `transient`. What is far from it,
    /// such as a transient whose place is not known yet, counts little. `None` of a stretch that is
    /// too short.
    pub(super) fn new(stretch: &[f64], transient: &Range<usize>) -> Option<Self> {
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
    pub(super) fn at(&self, sample: f64) -> f64 {
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
