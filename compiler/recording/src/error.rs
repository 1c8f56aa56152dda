//! Errors of a recording: the fault, its place and the remedy.

use crate::description::Proposal;
use asperity_io::diagnostic::Diagnostic;
use std::path::PathBuf;
use thiserror::Error;

/// A recording that cannot be read or used.
#[derive(Debug, Error)]
#[error("{}{}: {problem}", file.display(), line.map(|line| format!(":{line}")).unwrap_or_default())]
pub struct RecordingError {
    /// The file at fault, or the folder.
    pub file: PathBuf,
    /// The line or row at fault, from 1.
    pub line: Option<u64>,
    /// The fault. `Display` prints it after the place, so it is not a `source` as well.
    pub problem: Problem,
}

impl RecordingError {
    /// A problem of a whole file.
    pub fn of(file: impl Into<PathBuf>, problem: Problem) -> Self {
        Self {
            file: file.into(),
            line: None,
            problem,
        }
    }

    /// A problem at a line or row.
    pub fn at(file: impl Into<PathBuf>, line: u64, problem: Problem) -> Self {
        Self {
            file: file.into(),
            line: Some(line),
            problem,
        }
    }
}

impl Diagnostic for RecordingError {
    fn remedy(&self) -> String {
        self.problem.remedy()
    }
}

/// A fault of a recording.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Problem {
    /// A file could not be read.
    #[error("cannot be read ({0})")]
    Unreadable(#[source] std::io::Error),
    /// The folder has no description; one is proposed from the files' headers.
    #[error("the folder has no recording.toml{}", of_no_file(proposal.as_ref()))]
    NoDescription {
        /// A description to start from.
        proposal: Option<Proposal>,
    },
    /// The description is not valid TOML, or lacks a key.
    #[error("{0}")]
    Toml(String),
    /// A key has a value that means nothing.
    #[error("{field} = {value:?} {rule}")]
    Field {
        /// The key.
        field: &'static str,
        /// Its value.
        value: String,
        /// The rule that it breaks.
        rule: String,
    },
    /// A data file has no such column.
    #[error("has no column {column:?}; it has {found}")]
    NoColumn {
        /// The column.
        column: String,
        /// The columns that there are.
        found: String,
    },
    /// A value is no number.
    #[error("column {column:?} holds {value:?}, which is no number")]
    NotANumber {
        /// The column.
        column: String,
        /// The text of the field.
        value: String,
    },
    /// A data file is of an unknown kind.
    #[error("{0}")]
    Format(String),
    /// A data file is damaged, or of a known kind in a way that is not read.
    #[error("{what}")]
    File {
        /// Description of the fault.
        what: String,
        /// The input to give instead.
        remedy: &'static str,
    },
    /// A Git LFS pointer stands in place of the file.
    #[error("is a Git LFS pointer, not the data: the file was never downloaded")]
    Pointer,
    /// A column that is asked for by its name is there more than once.
    #[error("has the column {column:?} {count} times")]
    DuplicateColumn {
        /// Its name.
        column: String,
        /// Number of columns with this name.
        count: usize,
    },
    /// A clock whose unit cannot be right.
    #[error(
        "the clock {column:?} gives {rate_hz:.4} rows a second if its unit is {unit}: it is {} by a factor of {}",
        if *factor > 1.0 { "too slow" } else { "too fast" },
        if *factor > 1.0 { *factor } else { 1.0 / factor }
    )]
    ClockUnit {
        /// Its column.
        column: String,
        /// The unit that the description gives.
        unit: &'static str,
        /// Rows a second in that unit.
        rate_hz: f64,
        /// By which the rate must be multiplied.
        factor: f64,
    },
    /// A clock that was given no attention runs at another rate than the description states.
    #[error(
        "rate_hz says {stated_hz} Hz, but its column {column:?} is a clock of {clock_hz:.3} Hz: a factor of {:.4}",
        factor(*stated_hz, *clock_hz)
    )]
    UnusedClock {
        /// The column.
        column: String,
        /// As the description says.
        stated_hz: f64,
        /// As the column says.
        clock_hz: f64,
    },
    /// The clock runs backwards or stands still.
    #[error("the clock goes from {before_s} s to {now_s} s")]
    ClockBackwards {
        /// Time of the row before, s.
        before_s: f64,
        /// Time of this row, s.
        now_s: f64,
    },
    /// A gap that is too long to be bridged.
    #[error("the clock jumps by {gap_s:.3} s")]
    Gap {
        /// Its length, s.
        gap_s: f64,
    },
    /// The stated rate is not the clock's.
    #[error(
        "rate_hz says {stated_hz} Hz, the clock says {clock_hz:.3} Hz: a factor of {:.4}",
        factor(*stated_hz, *clock_hz)
    )]
    RateContradiction {
        /// As the description says.
        stated_hz: f64,
        /// As the clock says.
        clock_hz: f64,
    },
    /// A quantity without which there is no texture is missing.
    #[error("{0}")]
    Missing(String),
    /// There is too little to make a texture of.
    #[error("{0}")]
    TooLittle(String),
}

/// Why there is nothing to propose, where the folder holds files of a recording all the same.
fn of_no_file(proposal: Option<&Proposal>) -> String {
    match proposal {
        Some(Proposal { files: 0, text }) => {
            format!(", and no file that can be used as it is\n{}", text.trim())
        }
        _ => String::new(),
    }
}

/// Ratio of two rates, at least 1.
fn factor(one: f64, other: f64) -> f64 {
    (one / other).max(other / one)
}

impl Problem {
    fn remedy(&self) -> String {
        match self {
            Self::Unreadable(_) => "check the name under `file` in recording.toml".into(),
            Self::NoDescription {
                proposal: Some(Proposal { files: 0, .. }),
            } => "do what is said of each file, then run `asperity record-check --init`".into(),
            Self::NoDescription { proposal: Some(_) } => {
                "`asperity record-check --init` writes a draft of it into the folder; correct its guesses"
                    .into()
            }
            Self::NoDescription { proposal: None } => {
                "give a folder with recording.toml and CSV, WAV or NumPy files".into()
            }
            Self::Toml(_) | Self::Field { .. } => {
                "docs/recording.md lists every key with its values".into()
            }
            Self::NoColumn { .. } => "name one of these under `column` in recording.toml".into(),
            Self::NotANumber { .. } => {
                "write numbers with a point; leave a missing value empty or write NaN".into()
            }
            Self::Format(_) => "give CSV with a header line, WAV, or NumPy .npy files".into(),
            Self::File { remedy, .. } => (*remedy).into(),
            Self::Pointer => "run `git lfs pull` where the file comes from".into(),
            Self::DuplicateColumn { .. } => {
                "give its number from 0 under `column`, or rename one of them in the file".into()
            }
            Self::ClockUnit { .. } => "correct `clock_unit` in recording.toml".into(),
            Self::UnusedClock { column, .. } => {
                format!("write clock = {column:?} in place of `rate_hz`, or correct `rate_hz`")
            }
            Self::ClockBackwards { .. } => {
                "sort the rows by time, or leave `clock` out and give `rate_hz`".into()
            }
            Self::Gap { .. } => "split the recording at the gap into two folders".into(),
            Self::RateContradiction { .. } => "leave `rate_hz` out, or correct `clock_unit`".into(),
            Self::Missing(_) => {
                "record what is missing, or name its channel in recording.toml".into()
            }
            Self::TooLittle(_) => {
                "stroke for a minute at many speeds and forces; docs/recording.md says how".into()
            }
        }
    }
}
