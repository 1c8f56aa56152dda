//! Sensor files row by row: tables in text, WAV, NumPy. A file is never held in memory as a whole.

mod clock;
mod csv;
mod load;
mod npy;
pub mod wav;

pub(crate) use clock::period as clock_period;

#[cfg(test)]
pub(crate) use load::FileClock;
pub use load::{MAX_KEPT, Recording, load, load_at_most};

use crate::{
    description::{Meaning, in_group, meaning},
    remedy,
};
use asperity_io::diagnostic::Fault;
use std::path::Path;

/// The header of a file: all that precedes its first row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Header {
    /// Names of the columns; numbers from 0 where the file has no names.
    pub columns: Vec<String>,
    /// Line of the header, from 1; 0 where the file has none.
    pub line: u64,
    /// Entries of the row of units, per column; empty where there is no such row.
    pub units: Vec<String>,
    /// Entries of the rows above the header, per column; empty where there are none.
    pub groups: Vec<String>,
    /// Entries of the first row in columns of text; empty for the others.
    pub texts: Vec<String>,
    /// True if the file itself names the columns.
    pub named: bool,
    /// Rows a second, if the file says so.
    pub rate_hz: Option<f64>,
    /// True if no value can lie outside ±1, as in a WAV of integers.
    pub full_scale: bool,
    /// Faults of the file that do not prevent reading it.
    pub remarks: Vec<Remark>,
}

impl Header {
    /// Infers the meaning of a column from its name, the unit below it, and the group above it.
    pub(crate) fn meaning(&self, column: usize) -> Meaning {
        let name = &self.columns[column];
        let of = |texts: &[String]| texts.get(column).cloned().unwrap_or_default();
        let unit = of(&self.units);
        let found = match (meaning(name), unit.trim_matches(['(', ')', '[', ']'])) {
            (found, "") => found,
            (_, unit) => meaning(&format!("{name} ({unit})")),
        };
        match (found, of(&self.groups)) {
            (Meaning::Bare(axis), group) => match in_group(&group) {
                Some(quantity) => Meaning::Channel {
                    quantity,
                    axis,
                    unit: None,
                },
                None => found,
            },
            (found, _) => found,
        }
    }

    /// The text in the first row of a column that holds text.
    pub(crate) fn text(&self, column: usize) -> Option<&str> {
        let text = self.texts.get(column)?;
        (!text.is_empty()).then_some(text)
    }
}

/// A fault of a file that does not prevent reading it.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// The problem.
    pub what: String,
    /// Step for the user.
    pub remedy: &'static str,
}

/// A row: its line from 1 and its values, NaN where one is missing. What comes back says whether to
/// go on.
pub(crate) type EachRow<'a> = dyn FnMut(u64, &[f64]) -> Result<bool, Fault> + 'a;

/// The kinds of files, by their extension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Csv,
    Wav,
    Npy,
}

fn format(path: &Path) -> Result<Format, Fault> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("csv" | "txt" | "tsv") => Ok(Format::Csv),
        Some("wav") => Ok(Format::Wav),
        Some("npy") => Ok(Format::Npy),
        _ => {
            let what = "is none of .csv, .tsv, .txt, .wav, .npy";
            Err(Fault::new(what, remedy::FORMAT).at(path))
        }
    }
}

/// Returns true if a file's extension is that of a known kind.
pub(crate) fn is_known(path: &Path) -> bool {
    format(path).is_ok()
}

/// The header of a file.
///
/// # Errors
/// [`Fault`] for a file that cannot be read or is of no known kind.
pub fn header(path: &Path) -> Result<Header, Fault> {
    match format(path)? {
        Format::Csv => csv::header(path),
        Format::Wav => wav::header(path),
        Format::Npy => npy::header(path),
    }
}

/// Calls `each` for every row of a file until it says to stop, and gives what is wrong with the end of the
/// file. Columns that are not `wanted` hold NaN where they hold no number.
pub(crate) fn rows(
    path: &Path,
    wanted: &[usize],
    each: &mut EachRow<'_>,
) -> Result<Option<Remark>, Fault> {
    match format(path)? {
        Format::Csv => csv::rows(path, wanted, each),
        Format::Wav => wav::rows(path, each).map(|()| None),
        Format::Npy => npy::rows(path, each).map(|()| None),
    }
}
