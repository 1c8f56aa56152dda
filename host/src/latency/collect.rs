//! From the records of a loop to a run.

use super::{
    conditions::Conditions,
    facts::Facts,
    run::{Counts, Interval, Run, add, empty},
    worst::insert,
};
use crate::servo::{Overrun, Record, Settings, Stage};
use hdrhistogram::Histogram;

/// Takes the records of a loop, on another thread than the loop's.
#[derive(Debug)]
pub struct Collector {
    facts: Facts,
    interval_ns: u64,
    /// Due time of the first tick, ns.
    first_due_ns: Option<u64>,
    /// When the current interval began, ns after the first tick.
    began_ns: u64,
    last_ns: u64,
    current: [Histogram<u64>; Stage::ALL.len()],
    intervals: Vec<Interval>,
}

impl Collector {
    /// Collects the records of a loop with these settings, which began at `began_s` s since 1970,
    /// in intervals of `interval_ns`.
    #[must_use]
    pub fn new(
        settings: &Settings,
        conditions: Conditions,
        began_s: f64,
        interval_ns: u64,
    ) -> Self {
        Self {
            facts: Facts {
                ticks: 0,
                missed: 0,
                lost: 0,
                period_ns: settings.period_ns(),
                longest_gap_ns: 0,
                omits: settings.overrun != Overrun::CatchUp,
                began_s,
                conditions: vec![conditions],
                worst: Vec::new(),
            },
            interval_ns: interval_ns.max(1),
            first_due_ns: None,
            began_ns: 0,
            last_ns: 0,
            current: std::array::from_fn(|_| empty()),
            intervals: Vec::new(),
        }
    }

    /// Takes a record.
    pub fn record(&mut self, record: &Record) {
        let times = &record.times;
        let first_ns = *self.first_due_ns.get_or_insert(times.due_ns);
        let at_ns = times.due_ns.saturating_sub(first_ns);
        if at_ns >= self.began_ns + self.interval_ns {
            self.close(at_ns - at_ns % self.interval_ns);
        }
        for (stage, histogram) in Stage::ALL.into_iter().zip(&mut self.current) {
            if let Some(ns) = times.of(stage) {
                add(histogram, ns, 1);
            }
        }
        self.last_ns = at_ns;
        let facts = &mut self.facts;
        facts.ticks += 1;
        facts.missed += record.missed;
        let gap_ns = times.of(Stage::Interval).unwrap_or(0);
        facts.longest_gap_ns = facts.longest_gap_ns.max(gap_ns);
        insert(&mut facts.worst, record, first_ns);
    }

    /// Ends the current interval; the next one begins at `next_ns`.
    fn close(&mut self, next_ns: u64) {
        if self.current.iter().any(|histogram| !histogram.is_empty()) {
            let end_ns = self.last_ns + self.facts.period_ns;
            self.intervals.push(Interval {
                start_s: 1e-9 * self.began_ns as f64,
                length_s: 1e-9 * end_ns.saturating_sub(self.began_ns) as f64,
                stages: std::array::from_fn(|stage| Counts::of(&self.current[stage])),
            });
            for histogram in &mut self.current {
                histogram.reset();
            }
        }
        self.began_ns = next_ns;
    }

    /// The run so far, of which `lost` records never came.
    #[must_use]
    pub fn finish(mut self, lost: u64) -> Run {
        self.close(0);
        self.facts.lost = lost;
        Run {
            facts: self.facts,
            intervals: self.intervals,
        }
    }
}
