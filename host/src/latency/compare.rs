//! The shift of each percentile from one run to another, with a bootstrap confidence.
//!
//! Late ticks come in bursts, so ticks are no independent draws. Whole intervals of time are drawn
//! instead, with replacement, as many as the run has. The confidence is the range of the middle
//! 95 % of the shifts between drawn runs.

use super::{
    percentiles::{QUANTILES, carries},
    run::{Counts, Run},
};
use crate::servo::Stage;
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use serde::Serialize;

/// Runs that are drawn.
const DRAWS: usize = 1000;
/// Fewer intervals give no confidence.
const FEWEST_INTERVALS: usize = 10;
/// Fewer values beyond a percentile give no confidence.
const FEWEST_BEYOND: f64 = 10.0;

/// The shift of a percentile.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shift {
    /// Name of the stage.
    pub stage: &'static str,
    /// Name of the percentile.
    pub percentile: &'static str,
    /// In the first run, ns.
    pub a_ns: u64,
    /// In the second run, ns.
    pub b_ns: u64,
    /// From the first to the second, ns.
    pub shift_ns: i64,
    /// The range that holds the shift with 95 % confidence, ns; none where there are too few
    /// intervals, or too few values beyond the percentile.
    pub confidence_ns: Option<[i64; 2]>,
}

impl Shift {
    /// Returns true if the confidence interval excludes zero.
    #[must_use]
    pub fn is_clear(&self) -> bool {
        self.confidence_ns
            .is_some_and(|[low, high]| low > 0 || high < 0)
    }
}

/// Compares two runs, in the percentiles that both carry. The same seed gives the same confidence.
#[must_use]
pub fn compare(a: &Run, b: &Run, seed: u64) -> Vec<Shift> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut shifts = Vec::new();
    for stage in Stage::ALL {
        let (a, b) = (Sampled::of(a, stage), Sampled::of(b, stage));
        if a.total == 0 || b.total == 0 {
            continue;
        }
        let all = |sampled: &Sampled| sampled.quantiles(0..sampled.intervals.len());
        let (in_a, in_b) = (all(&a), all(&b));
        let mut drawn: [Vec<i64>; QUANTILES.len()] = Default::default();
        let enough = |sampled: &Sampled| sampled.intervals.len() >= FEWEST_INTERVALS;
        if enough(&a) && enough(&b) {
            for _ in 0..DRAWS {
                let (from_a, from_b) = (a.draw(&mut rng), b.draw(&mut rng));
                for (n, shifts) in drawn.iter_mut().enumerate() {
                    shifts.push(difference(from_a[n], from_b[n]));
                }
            }
        }
        for (n, (quantile, percentile)) in QUANTILES.into_iter().enumerate() {
            let fewer = a.total.min(b.total);
            if !carries(fewer, quantile) {
                continue;
            }
            let beyond = (1.0 - quantile) * fewer as f64;
            shifts.push(Shift {
                stage: stage.name(),
                percentile,
                a_ns: in_a[n],
                b_ns: in_b[n],
                shift_ns: difference(in_a[n], in_b[n]),
                // A hair less, since 1 − 0.999 is no round number.
                confidence_ns: (beyond > FEWEST_BEYOND * (1.0 - 1e-9))
                    .then(|| middle(&mut drawn[n]))
                    .flatten(),
            });
        }
    }
    shifts
}

fn difference(a: u64, b: u64) -> i64 {
    b.cast_signed().wrapping_sub(a.cast_signed())
}

/// The range of the middle 95 %.
fn middle(values: &mut [i64]) -> Option<[i64; 2]> {
    values.sort_unstable();
    let at = |share: f64| values.get((share * values.len() as f64) as usize).copied();
    Some([at(0.025)?, at(0.975)?])
}

/// The counts of a stage by interval, over the values of the whole run.
struct Sampled {
    values: Vec<u64>,
    /// Index of a value, and how often it occurred.
    intervals: Vec<Vec<(usize, u64)>>,
    total: u64,
}

impl Sampled {
    fn of(run: &Run, stage: Stage) -> Self {
        let counts = |counts: &Counts| counts.0.clone();
        let intervals: Vec<_> = run
            .intervals
            .iter()
            .map(|i| counts(i.stage(stage)))
            .collect();
        let mut values: Vec<u64> = intervals
            .iter()
            .flatten()
            .map(|&(value, _)| value)
            .collect();
        values.sort_unstable();
        values.dedup();
        let total = intervals.iter().flatten().map(|&(_, count)| count).sum();
        let index = |value| values.partition_point(|&other| other < value);
        let intervals = intervals.iter().map(|counts| {
            let counts = counts.iter();
            counts
                .map(|&(value, count)| (index(value), count))
                .collect()
        });
        Self {
            intervals: intervals.collect(),
            total,
            values,
        }
    }

    /// The quantiles of a run that consists of these intervals.
    fn quantiles(&self, intervals: impl Iterator<Item = usize>) -> [u64; QUANTILES.len()] {
        let mut counts = vec![0_u64; self.values.len()];
        let mut total = 0;
        for &(value, count) in intervals.flat_map(|index| &self.intervals[index]) {
            counts[value] += count;
            total += count;
        }
        let mut quantiles = [0; QUANTILES.len()];
        let (mut at, mut sum) = (0, 0);
        for (quantile, (share, _)) in quantiles.iter_mut().zip(QUANTILES) {
            let wanted = ((share * total as f64).ceil() as u64).clamp(1, total.max(1));
            while sum < wanted && at < counts.len() {
                sum += counts[at];
                at += 1;
            }
            *quantile = at.checked_sub(1).map_or(0, |last| self.values[last]);
        }
        quantiles
    }

    fn draw(&self, rng: &mut Xoshiro256PlusPlus) -> [u64; QUANTILES.len()] {
        let count = self.intervals.len() as u64;
        let draws = (0..count).map(|_| (rng.next_u64() % count) as usize);
        self.quantiles(draws)
    }
}
