//! A run: histograms of every interval of time, by stage.

use super::{facts::Facts, percentiles::Percentiles, worst::WORST};
use crate::servo::Stage;
use hdrhistogram::Histogram;

/// Significant digits of every histogram.
pub(super) const DIGITS: u8 = 3;

/// Values with their counts, ascending.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Counts(pub Vec<(u64, u64)>);

/// An empty histogram that grows with its values.
pub(super) fn empty() -> Histogram<u64> {
    // Refused only for more than five digits.
    Histogram::new(DIGITS).unwrap_or_else(|_| unreachable!("{DIGITS} digits are allowed"))
}

/// Adds a value so many times. The histogram grows to hold it; what none can hold counts as its
/// largest.
pub(super) fn add(histogram: &mut Histogram<u64>, value: u64, count: u64) {
    if histogram.record_n(value, count).is_err() {
        histogram.saturating_record_n(value, count);
    }
}

impl Counts {
    /// The values of a histogram.
    #[must_use]
    pub fn of(histogram: &Histogram<u64>) -> Self {
        let recorded = histogram.iter_recorded();
        Self(
            recorded
                .map(|step| (step.value_iterated_to(), step.count_since_last_iteration()))
                .collect(),
        )
    }

    /// Adds them to a histogram.
    pub(super) fn add_to(&self, histogram: &mut Histogram<u64>) {
        for &(value, count) in &self.0 {
            add(histogram, value, count);
        }
    }

    /// As a histogram.
    #[must_use]
    pub fn histogram(&self) -> Histogram<u64> {
        let mut histogram = empty();
        self.add_to(&mut histogram);
        histogram
    }
}

/// An interval of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Interval {
    /// When it began, s after the run.
    pub start_s: f64,
    /// Its length, s.
    pub length_s: f64,
    /// Recorded values per stage, in the order of [`Stage::ALL`].
    pub stages: [Counts; Stage::ALL.len()],
}

impl Interval {
    /// Returns the recorded values of a stage.
    #[must_use]
    pub fn stage(&self, stage: Stage) -> &Counts {
        &self.stages[stage as usize]
    }
}

/// A run, or several that were merged.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Metadata.
    pub facts: Facts,
    /// Its intervals, in the order of time.
    pub intervals: Vec<Interval>,
}

impl Run {
    /// A run of one stage and one interval, of which nothing else is known.
    #[must_use]
    pub fn of_stage(stage: Stage, counts: Counts) -> Self {
        let ticks = counts.0.iter().map(|&(_, count)| count).sum();
        let mut stages: [Counts; Stage::ALL.len()] = Default::default();
        stages[stage as usize] = counts;
        Self {
            facts: Facts {
                ticks,
                missed: 0,
                lost: 0,
                period_ns: 0,
                longest_gap_ns: 0,
                omits: false,
                began_s: 0.0,
                conditions: Vec::new(),
                worst: Vec::new(),
            },
            intervals: vec![Interval {
                start_s: 0.0,
                length_s: 0.0,
                stages,
            }],
        }
    }

    /// The histogram of a stage as it was recorded, ns.
    #[must_use]
    pub fn raw(&self, stage: Stage) -> Histogram<u64> {
        let mut sum = empty();
        for interval in &self.intervals {
            interval.stage(stage).add_to(&mut sum);
        }
        sum
    }

    /// The histogram of a stage, corrected for coordinated omission: a value of more than a period
    /// stands for the ticks that it kept from being recorded as well, each a period less late. A
    /// run that made up for its missed ticks has recorded them, and needs no correction.
    #[must_use]
    pub fn corrected(&self, stage: Stage) -> Histogram<u64> {
        let raw = self.raw(stage);
        if self.facts.omits {
            raw.clone_correct(self.facts.period_ns)
        } else {
            raw
        }
    }

    /// The percentiles of a stage as it was recorded.
    #[must_use]
    pub fn percentiles(&self, stage: Stage) -> Percentiles {
        Percentiles::of(&self.raw(stage))
    }

    /// Appends another run. Its intervals keep their distance in time.
    pub fn merge(&mut self, other: Self) {
        let began_s = self.facts.began_s.min(other.facts.began_s);
        let shift = |run: &mut Self| {
            let by_s = run.facts.began_s - began_s;
            for interval in &mut run.intervals {
                interval.start_s += by_s;
            }
            for tick in &mut run.facts.worst {
                tick.t_s += by_s;
            }
        };
        let mut other = other;
        shift(self);
        shift(&mut other);
        self.intervals.append(&mut other.intervals);
        self.intervals
            .sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
        let facts = &mut self.facts;
        facts.began_s = began_s;
        facts.ticks = facts.ticks.saturating_add(other.facts.ticks);
        facts.missed = facts.missed.saturating_add(other.facts.missed);
        facts.lost = facts.lost.saturating_add(other.facts.lost);
        facts.omits |= other.facts.omits;
        facts.longest_gap_ns = facts.longest_gap_ns.max(other.facts.longest_gap_ns);
        for conditions in other.facts.conditions {
            if !facts.conditions.contains(&conditions) {
                facts.conditions.push(conditions);
            }
        }
        facts.worst.append(&mut other.facts.worst);
        facts.worst.sort_by_key(|tick| u64::MAX - tick.total_ns);
        facts.worst.truncate(WORST);
    }
}
