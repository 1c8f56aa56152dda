//! Verdict on the timing of a run.

use super::run::Run;
use crate::servo::Stage;
use serde::Serialize;

/// Largest wake-up latency by the rule of thumb, in periods: a tenth.
const LATE_PERIODS: f64 = 0.1;

/// Limits on a run.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Limits {
    /// Time from due to written, µs.
    pub max_us: Option<f64>,
    /// Missed periods.
    pub max_missed: Option<u64>,
}

/// Punctuality by the rule of thumb: no period missed, and no wake-up later than a tenth of a period.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Punctuality {
    /// Within the rule.
    Punctual,
    /// No period missed, but a late wake-up.
    Late,
    /// Periods missed.
    Missed,
}

/// Verdict on a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// By the rule of thumb.
    pub punctuality: Punctuality,
    /// Missed periods.
    pub missed: u64,
    /// Elapsed periods.
    pub periods: u64,
    /// The latest wake-up, ns.
    pub latest_wakeup_ns: u64,
    /// The latest wake-up by the rule of thumb, ns.
    pub rule_ns: u64,
    /// From due to written at the longest, ns.
    pub longest_total_ns: u64,
    /// The limits that were exceeded, in words.
    pub exceeded: Vec<String>,
}

impl Verdict {
    /// The verdict on a run.
    #[must_use]
    pub fn on(run: &Run, limits: &Limits) -> Self {
        let facts = &run.facts;
        // No less than three digits tell: a bound is not exceeded by itself.
        let latest = |stage| {
            let histogram = run.raw(stage);
            histogram.lowest_equivalent(histogram.max())
        };
        let latest_wakeup_ns = latest(Stage::WakeUp);
        let longest_total_ns = latest(Stage::Total);
        let rule_ns = (LATE_PERIODS * facts.period_ns as f64) as u64;
        let mut exceeded = Vec::new();
        if let Some(most) = limits
            .max_us
            .filter(|most| longest_total_ns as f64 > 1e3 * most)
        {
            let us = 1e-3 * longest_total_ns as f64;
            exceeded.push(format!(
                "a force was written {us:.1} µs after its tick was due, more than --max-us {most}"
            ));
        }
        if let Some(most) = limits.max_missed.filter(|most| facts.missed > *most) {
            let missed = facts.missed;
            let periods = if missed == 1 { "period" } else { "periods" };
            exceeded.push(format!(
                "{missed} {periods} missed, more than --max-missed {most}"
            ));
        }
        Self {
            punctuality: match facts.missed {
                0 if latest_wakeup_ns <= rule_ns => Punctuality::Punctual,
                0 => Punctuality::Late,
                _ => Punctuality::Missed,
            },
            missed: facts.missed,
            periods: facts.ticks + facts.missed,
            latest_wakeup_ns,
            rule_ns,
            longest_total_ns,
            exceeded,
        }
    }
}
