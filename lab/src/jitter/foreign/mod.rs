//! Latencies that other tools counted, each file as one stage of a run.

mod column;
#[cfg(test)]
mod tests;
mod text;
mod unit;

use asperity_host::latency::{Counts, CyclictestError, Run, Wakeups};
use asperity_host::servo::Stage;
use asperity_io::diagnostic::Diagnostic;
use asperity_io::table::{TableError, TableProblem};
use std::collections::BTreeMap;

pub use unit::Unit;

/// Longest latency, ns: a day, as long as a run may be.
const MOST_NS: f64 = 86_400e9;
/// Most latencies of a file.
const MOST_COUNT: u64 = 1 << 50;
/// Share of the latencies beyond the largest bin of a histogram that leaves its percentiles true, as
/// one in so many.
const MOST_BEYOND: u64 = 100;

/// A measurement by another tool.
#[derive(Debug)]
pub struct Foreign {
    /// Its latencies, as one stage.
    pub run: Run,
    /// Caveats about the latencies.
    pub notes: Vec<String>,
}

/// Why a file holds no latencies.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ForeignError {
    /// Not what `cyclictest --json` writes.
    #[error(transparent)]
    Cyclictest(#[from] CyclictestError),
    /// A file that is known, and not read.
    #[error("it is {what}")]
    NotRead {
        /// Its name, with an article.
        what: &'static str,
        /// The input to give instead.
        remedy: &'static str,
    },
    /// A line of a distribution or a histogram.
    #[error("line {0} is no line of a percentile distribution or a histogram of latencies")]
    Line(usize),
    /// Too many latencies lie beyond a histogram.
    #[error(
        "{beyond} of {total} latencies lie beyond its histogram, so its percentiles are unknown"
    )]
    Beyond {
        /// Latencies beyond the histogram.
        beyond: u64,
        /// All latencies.
        total: u64,
    },
    /// No column of that name, or several that could be meant.
    #[error("the column of latencies is not clear among: {0}")]
    Column(String),
    /// A column in a unit of something else.
    #[error("column {head:?} is in `{unit}`, which is no unit of a latency")]
    OtherUnit {
        /// Its head.
        head: String,
        /// The unit.
        unit: String,
    },
    /// No table, or a damaged one.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A cell that is no latency.
    #[error("line {line}: {cell:?} is no latency")]
    Cell {
        /// Its line, from 1.
        line: usize,
        /// Its text.
        cell: String,
    },
    /// A latency of more than a day.
    #[error("line {line}: {seconds:.0} s is too long for a latency: a day at most")]
    TooLong {
        /// Its line, from 1.
        line: usize,
        /// The latency, s.
        seconds: f64,
    },
    /// More latencies than can be counted.
    #[error("it counts more than {MOST_COUNT} latencies")]
    TooMany,
    /// Latencies below a nanosecond.
    #[error("most of its latencies are below 1 ns in its unit, {0}")]
    TooShort(&'static str),
    /// No latencies.
    #[error("it holds no latencies")]
    Empty,
}

impl Diagnostic for ForeignError {
    fn remedy(&self) -> String {
        match self {
            Self::Cyclictest(CyclictestError::NoHistogram | CyclictestError::Range) | Self::Beyond { .. } => {
                "measure again with a histogram that holds all latencies, such as `cyclictest -h 1000 --json=FILE` (without -N)".into()
            }
            Self::NotRead { remedy, .. }
            | Self::Table(TableError { problem: TableProblem::Damaged { remedy, .. }, .. }) => {
                (*remedy).into()
            }
            Self::Column(_) => "name it: --column NAME".into(),
            Self::OtherUnit { .. } => "convert it to ns, us, ms or s, and name the unit in the head, as in `latency_us`".into(),
            Self::TooLong { .. } | Self::TooShort(_) => {
                "name the unit in the head of the column, as in `latency_us`, or give --unit".into()
            }
            _ => "give a run.hlog, a .hgrm file, what `cyclictest --json` or `-h` writes, or CSV with a latency in each line".into(),
        }
    }
}

/// Reads latencies of one stage. `column` names a column of CSV; without it, it is the stage's, or
/// the only one. `unit` is that of files which do not state theirs, µs by default.
///
/// # Errors
/// [`ForeignError`].
pub fn read_foreign(
    text: &str,
    stage: Stage,
    column: Option<&str>,
    unit: Option<Unit>,
) -> Result<Foreign, ForeignError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let has_line = |start: &str| {
        text.lines()
            .any(|line| line.trim_start().starts_with(start))
    };
    let refused = |what, remedy| Err(ForeignError::NotRead { what, remedy });
    let counted = if text.trim().is_empty() {
        Counted::default()
    } else if text.trim_start().starts_with('{') {
        of_json(text)?
    } else if let Some(at) = text::spectrum_at(text) {
        text::of_spectrum(text, at, unit)?
    } else if text.starts_with("#[Histogram log format") || has_line("\"StartTimestamp\"") {
        return refused(
            "an interval log of another HdrHistogram, which states neither stage nor unit",
            "convert it: `HistogramLogProcessor -i FILE -o OUT`, and give OUT.hgrm with its --unit",
        );
    } else if has_line("# RTLA timerlat hist") {
        text::of_rtla(text)?
    } else if has_line("# RTLA") || has_line("Timer Latency") || has_line("Operating System Noise")
    {
        return refused(
            "a table of rtla other than that of `rtla timerlat hist`",
            "measure again with `rtla timerlat hist`",
        );
    } else if has_line("# Histogram") {
        text::of_cyclictest(text, unit)?
    } else if has_line("# /dev/cpu_dma_latency") || has_line("T: 0 (") {
        return refused(
            "the text of cyclictest without a histogram",
            "measure again with a histogram: `cyclictest -h 1000 --json=FILE`",
        );
    } else if has_line("Thread Stats   Avg") {
        return refused(
            "the report of wrk without a detailed distribution",
            "measure again with `wrk2 --latency`",
        );
    } else {
        column::of_column(text, stage, column, unit)?
    };
    if counted.counts.is_empty() {
        return Err(ForeignError::Empty);
    }
    let counts = Counts(counted.counts.into_iter().collect());
    Ok(Foreign {
        run: Run::of_stage(stage, counts),
        notes: counted.notes,
    })
}

fn of_json(text: &str) -> Result<Counted, ForeignError> {
    if text.contains("\"longest_gap_ns\"") {
        return Err(ForeignError::NotRead {
            what: "the report of `asperity-lab jitter` (run.json), which holds percentiles alone",
            remedy: "give the folder that `asperity-lab jitter -o` wrote, or the run.hlog in it",
        });
    }
    let wakeups = Wakeups::parse(text.as_bytes())?;
    let mut counted = Counted::default();
    for (ns, count) in wakeups.counts.0 {
        counted.add(Latency(ns as f64).ns(1)?, count)?;
    }
    counted.beyond(
        &[wakeups.beyond],
        Some(Latency(wakeups.max_ns as f64).ns(1)?),
    )?;
    Ok(counted)
}

/// Latencies of a file in ns, with their counts.
#[derive(Debug, Default)]
struct Counted {
    counts: BTreeMap<u64, u64>,
    total: u64,
    notes: Vec<String>,
}

impl Counted {
    fn add(&mut self, ns: u64, count: u64) -> Result<(), ForeignError> {
        let total = self
            .total
            .checked_add(count)
            .filter(|total| *total <= MOST_COUNT);
        self.total = total.ok_or(ForeignError::TooMany)?;
        if count > 0 {
            *self.counts.entry(ns).or_default() += count;
        }
        Ok(())
    }

    /// Notes that a file does not state its unit, where no option does.
    fn note_unit(&mut self, stated: Option<Unit>) {
        if stated.is_none() {
            let note = "no unit is stated, so its latencies are read as µs; --unit states another";
            self.notes.push(note.into());
        }
    }

    /// Counts latencies beyond a histogram as the largest, where they are few.
    fn beyond(&mut self, beyond: &[u64], largest_ns: Option<u64>) -> Result<(), ForeignError> {
        let sum = beyond
            .iter()
            .try_fold(0_u64, |sum, &count| sum.checked_add(count));
        let beyond = sum
            .filter(|sum| *sum <= MOST_COUNT)
            .ok_or(ForeignError::TooMany)?;
        let total = self.total + beyond;
        if beyond == 0 {
            return Ok(());
        }
        let largest_ns = largest_ns.filter(|_| beyond * MOST_BEYOND <= total);
        let largest_ns = largest_ns.ok_or(ForeignError::Beyond { beyond, total })?;
        self.notes.push(format!(
            "{beyond} of {total} latencies lie beyond its histogram and count as the largest, {} µs",
            largest_ns as f64 / 1e3
        ));
        self.add(largest_ns, beyond)
    }
}

/// A latency that was read, ns.
#[derive(Debug, Clone, Copy)]
struct Latency(f64);

impl Latency {
    /// A latency in a unit; none for what is not finite, or below 0.
    fn of(value: f64, unit: Unit) -> Option<Self> {
        (value.is_finite() && value >= 0.0).then_some(Self(value * unit.ns()))
    }

    /// In whole ns, if a latency can be so long; `line` names where it stands.
    fn ns(self, line: usize) -> Result<u64, ForeignError> {
        if self.0 <= MOST_NS {
            Ok(self.0.round() as u64)
        } else {
            let seconds = 1e-9 * self.0;
            Err(ForeignError::TooLong { line, seconds })
        }
    }
}
