//! Latencies that other tools counted: percentile distributions (`.hgrm`), what `cyclictest --json`
//! writes, and columns of CSV.

use super::{
    cyclictest::{CyclictestError, Wakeups},
    facts::Facts,
    run::{Counts, Interval, Run},
};
use crate::servo::Stage;
use std::{collections::BTreeMap, str::FromStr};
use thiserror::Error;

/// A unit of time in a file that does not state its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Nanoseconds.
    Ns,
    /// Microseconds.
    Us,
    /// Milliseconds.
    Ms,
}

impl Unit {
    const fn ns(self) -> f64 {
        match self {
            Self::Ns => 1.0,
            Self::Us => 1e3,
            Self::Ms => 1e6,
        }
    }

    /// The unit that the name of a column ends with, as in `wakeup_ns` and `latency (µs)`.
    fn of_column(name: &str) -> Option<Self> {
        let word = name
            .trim_end_matches([')', ']'])
            .rsplit(['_', ' ', '(', '['])
            .next()?;
        word.parse().ok()
    }
}

impl FromStr for Unit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "ns" => Ok(Self::Ns),
            "us" | "µs" => Ok(Self::Us),
            "ms" => Ok(Self::Ms),
            _ => Err("ns, us or ms".into()),
        }
    }
}

/// Why a file holds no latencies.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DistributionError {
    /// Not what `cyclictest --json` writes.
    #[error(transparent)]
    Cyclictest(#[from] CyclictestError),
    /// A line of a `.hgrm` file.
    #[error("line {0} is no line of a percentile distribution")]
    Line(usize),
    /// No column of that name, or several that could be meant.
    #[error("the column of latencies is not clear among: {0}")]
    Column(String),
    /// A cell that is no latency.
    #[error("line {line}: {cell:?} is no latency")]
    Cell {
        /// Its line.
        line: usize,
        /// Its text.
        cell: String,
    },
    /// No latencies.
    #[error("it holds no latencies")]
    Empty,
}

/// Reads latencies of one stage. `column` names a column of CSV; without it, it is the stage's, or
/// the only one. `unit` is that of files which do not state theirs.
///
/// # Errors
/// [`DistributionError`].
pub fn read_distribution(
    text: &str,
    stage: Stage,
    column: Option<&str>,
    unit: Unit,
) -> Result<Run, DistributionError> {
    let first = text.trim_start();
    let counts = if first.starts_with('{') {
        of_cyclictest(text)?
    } else if first.split_whitespace().take(2).eq(["Value", "Percentile"]) {
        of_percentiles(text, unit)?
    } else {
        of_column(text, stage, column, unit)?
    };
    if counts.0.is_empty() {
        return Err(DistributionError::Empty);
    }
    Ok(run_of(stage, counts))
}

/// A run of one stage and one interval.
fn run_of(stage: Stage, counts: Counts) -> Run {
    let ticks = counts.0.iter().map(|&(_, count)| count).sum();
    let mut stages: [Counts; Stage::ALL.len()] = Default::default();
    stages[stage as usize] = counts;
    Run {
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

fn sorted(counts: BTreeMap<u64, u64>) -> Counts {
    Counts(counts.into_iter().filter(|&(_, count)| count > 0).collect())
}

/// Latencies beyond cyclictest's histogram count as the largest.
fn of_cyclictest(text: &str) -> Result<Counts, DistributionError> {
    let wakeups = Wakeups::parse(text.as_bytes())?;
    let mut counts: BTreeMap<u64, u64> = wakeups.counts.0.into_iter().collect();
    *counts.entry(wakeups.max_ns).or_default() += wakeups.beyond;
    Ok(sorted(counts))
}

/// The counts between the lines of a percentile distribution, each at its upper end.
fn of_percentiles(text: &str, unit: Unit) -> Result<Counts, DistributionError> {
    let mut counts: BTreeMap<u64, u64> = BTreeMap::new();
    let mut before = 0_u64;
    let lines = text
        .lines()
        .enumerate()
        .skip_while(|(_, line)| line.trim().is_empty());
    for (index, line) in lines.skip(1) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> = line.split_whitespace().collect();
        let value = cells.first().and_then(|cell| latency_ns(cell, unit));
        let total = cells.get(2).and_then(|cell| cell.parse::<u64>().ok());
        let (Some(value), Some(total)) = (value, total.filter(|total| *total >= before)) else {
            return Err(DistributionError::Line(index + 1));
        };
        *counts.entry(value).or_default() += total - before;
        before = total;
    }
    Ok(sorted(counts))
}

fn latency_ns(cell: &str, unit: Unit) -> Option<u64> {
    let value: f64 = cell.trim().parse().ok()?;
    let ns = value * unit.ns();
    (0.0..1e18).contains(&ns).then(|| ns.round() as u64)
}

/// A column of CSV: one latency a line. Empty cells are no latencies.
fn of_column(
    text: &str,
    stage: Stage,
    column: Option<&str>,
    unit: Unit,
) -> Result<Counts, DistributionError> {
    let mut lines = text.lines().enumerate();
    let (_, heading) = lines.next().ok_or(DistributionError::Empty)?;
    let names: Vec<&str> = heading.split(',').map(str::trim).collect();
    let headless = names.iter().all(|name| name.parse::<f64>().is_ok());
    let named = |name: &str| {
        let mut found = (0..names.len()).filter(|&at| {
            let own = names[at];
            own == name || own.split('_').next() == Some(name)
        });
        found.next().filter(|_| found.next().is_none())
    };
    let at = match column {
        Some(column) => named(column),
        None if names.len() == 1 => Some(0),
        None => named(stage.name()),
    };
    let at = at.ok_or_else(|| DistributionError::Column(names.join(", ")))?;
    let unit = Unit::of_column(names[at]).unwrap_or(unit);
    let mut counts: BTreeMap<u64, u64> = BTreeMap::new();
    let first = headless.then_some((0, heading));
    for (index, line) in first.into_iter().chain(lines) {
        let cell = line.split(',').nth(at).unwrap_or_default().trim();
        if cell.is_empty() {
            continue;
        }
        let ns = latency_ns(cell, unit).ok_or_else(|| DistributionError::Cell {
            line: index + 1,
            cell: cell.into(),
        })?;
        *counts.entry(ns).or_default() += 1;
    }
    Ok(sorted(counts))
}
