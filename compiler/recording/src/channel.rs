//! A channel in SI units, and the faults in its samples.

use crate::{
    description::{Axis, Quantity},
    signal::{quantile::Magnitudes, resample::Clock},
};
use std::ops::Range;

/// Runs of one value that are remembered.
const MAX_RUNS: usize = 4096;
/// Values in a row that count as a run.
const LEAST_RUN: u64 = 6;

/// A channel as it was read.
#[derive(Debug, Clone)]
pub struct Channel {
    /// `quantity axis`.
    pub label: String,
    /// File it comes from.
    pub file: String,
    /// The measured quantity.
    pub quantity: Quantity,
    /// Along which axis.
    pub axis: Axis,
    /// Least and largest value that the sensor can give, SI.
    pub range: Option<[f64; 2]>,
    /// When the samples were taken.
    pub clock: Clock,
    /// The first samples, SI; no more than memory may hold.
    pub samples: Vec<f32>,
    /// Statistics of all samples.
    pub numbers: Numbers,
}

/// Statistics of the samples of a channel, gathered while reading.
#[derive(Debug, Clone, Default)]
pub struct Numbers {
    /// All samples.
    pub count: u64,
    /// Samples that were missing: NaN, infinite or empty.
    pub missing: u64,
    /// Line of the first of them.
    pub first_missing: Option<u64>,
    /// Longest stretch of missing samples.
    pub longest_missing: u64,
    /// Least value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Runs of one and the same value.
    pub runs: Vec<Run>,
    /// Samples that stand in runs.
    pub in_runs: u64,
    /// The run at the end of the channel, if there is one.
    pub last_run: Option<Run>,
    /// The longest run before it.
    pub longest_before: u64,
    /// Missing stretches, in samples.
    pub missing_spans: Vec<Range<u64>>,
    /// Distances between neighbours.
    pub steps: Magnitudes,
    last: Option<f64>,
    run_start: u64,
    run_length: u64,
    jump_before: f64,
    missing_now: u64,
}

/// A run of one value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// Sample at which it begins.
    pub start: u64,
    /// Samples.
    pub length: u64,
    /// The value, SI.
    pub value: f64,
    /// Distance to the value before it.
    pub jump_before: f64,
    /// Distance to the value after it.
    pub jump_after: f64,
}

impl Numbers {
    /// Takes the next value, and gives what stands for it: the last good one where it is missing.
    pub(crate) fn take(&mut self, value: f64, line: u64) -> f64 {
        let index = self.count;
        self.count += 1;
        if !value.is_finite() {
            self.missing += 1;
            self.first_missing.get_or_insert(line);
            self.missing_now += 1;
            self.longest_missing = self.longest_missing.max(self.missing_now);
            if let Some(span) = self.missing_spans.last_mut()
                && span.end == index
            {
                span.end += 1;
            } else if self.missing_spans.len() < MAX_RUNS {
                self.missing_spans.push(index..index + 1);
            }
            return self.last.unwrap_or(0.0);
        }
        self.missing_now = 0;
        let Some(last) = self.last else {
            (self.min, self.max) = (value, value);
            self.last = Some(value);
            (self.run_start, self.run_length) = (index, 1);
            return value;
        };
        self.min = self.min.min(value);
        self.max = self.max.max(value);
        let step = (value - last).abs();
        if step == 0.0 {
            self.run_length += 1;
        } else {
            let ended = self.end_run(step).map_or(0, |run| run.length);
            self.longest_before = self.longest_before.max(ended);
            self.steps.add(step);
            self.jump_before = step;
            (self.run_start, self.run_length) = (index, 1);
        }
        self.last = Some(value);
        value
    }

    /// Ends the last run.
    pub(crate) fn finish(&mut self) {
        self.last_run = self.end_run(0.0);
    }

    fn end_run(&mut self, jump_after: f64) -> Option<Run> {
        if self.run_length < LEAST_RUN {
            return None;
        }
        let run = Run {
            start: self.run_start,
            length: self.run_length,
            value: self.last.unwrap_or(0.0),
            jump_before: self.jump_before,
            jump_after,
        };
        self.in_runs += run.length;
        if self.runs.len() < MAX_RUNS {
            self.runs.push(run);
        }
        Some(run)
    }

    /// Marks a stretch that no row stands for.
    pub(crate) fn bridged(&mut self, span: Range<u64>) {
        if self.missing_spans.len() < MAX_RUNS {
            self.missing_spans.push(span);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_and_missing_values_are_counted_as_they_go_by() {
        let mut numbers = Numbers::default();
        let values = [1.0, f64::NAN, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 7.0, f64::NAN];
        let kept: Vec<f64> = (1..)
            .zip(values)
            .map(|(line, x)| numbers.take(x, line))
            .collect();
        numbers.finish();
        assert_eq!(kept[1], 1.0);
        assert_eq!((numbers.missing, numbers.first_missing), (2, Some(2)));
        assert_eq!(numbers.missing_spans, [1..2, 9..10]);
        assert_eq!(numbers.runs.len(), 1);
        assert_eq!((numbers.runs[0].start, numbers.runs[0].length), (2, 6));
        assert_eq!((numbers.min, numbers.max), (1.0, 7.0));
        assert_eq!(numbers.runs[0].jump_after, 5.0);
    }
}
