//! The worst ticks of a run.

use crate::servo::{Record, Stage};
use serde::{Deserialize, Serialize};

/// Number of worst ticks kept.
pub const WORST: usize = 10;

/// A worst tick: among those with the longest time from due to written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WorstTick {
    /// Period since the loop began.
    pub period: u64,
    /// When it was due, s after the first tick.
    pub t_s: f64,
    /// The stage that took longest.
    pub stage: String,
    /// From due to written, ns.
    pub total_ns: u64,
    /// From due to running, ns.
    pub wakeup_ns: u64,
    /// Reading, ns.
    pub read_ns: u64,
    /// The runtime's tick, ns.
    pub compute_ns: u64,
    /// Writing, ns.
    pub write_ns: u64,
}

impl WorstTick {
    fn of(record: &Record, first_due_ns: u64) -> Self {
        let ns = |stage| record.times.of(stage).unwrap_or(0);
        Self {
            period: record.period,
            t_s: 1e-9 * (record.times.due_ns.saturating_sub(first_due_ns)) as f64,
            stage: record.times.longest().name().into(),
            total_ns: ns(Stage::Total),
            wakeup_ns: ns(Stage::WakeUp),
            read_ns: ns(Stage::Read),
            compute_ns: ns(Stage::Compute),
            write_ns: ns(Stage::Write),
        }
    }
}

/// Puts a tick among the worst, the worst first, if it is one.
pub(super) fn insert(worst: &mut Vec<WorstTick>, record: &Record, first_due_ns: u64) {
    let total_ns = record.times.of(Stage::Total).unwrap_or(0);
    if worst.len() == WORST && worst.last().is_some_and(|last| total_ns <= last.total_ns) {
        return;
    }
    let at = worst.partition_point(|other| other.total_ns >= total_ns);
    worst.insert(at, WorstTick::of(record, first_due_ns));
    worst.truncate(WORST);
}
