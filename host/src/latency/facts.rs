//! Metadata of a run.

use super::{conditions::Conditions, worst::WorstTick};
use serde::{Deserialize, Serialize};

/// Metadata of a run, apart from its histograms. An interval log stores it as a comment.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// Recorded ticks.
    pub ticks: u64,
    /// Missed periods.
    pub missed: u64,
    /// Ticks whose records were lost on the way to the histograms.
    pub lost: u64,
    /// Nominal length of a period, ns.
    pub period_ns: u64,
    /// Longest time from one wake-up to the next, ns.
    pub longest_gap_ns: u64,
    /// True if missed ticks left no record of their own, so that histograms need the correction for
    /// coordinated omission.
    pub omits: bool,
    /// When it began, s since 1970.
    pub began_s: f64,
    /// The conditions of every run that was merged.
    pub conditions: Vec<Conditions>,
    /// The worst ticks, the worst first.
    pub worst: Vec<WorstTick>,
}
