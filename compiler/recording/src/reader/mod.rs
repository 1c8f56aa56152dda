//! Sensor files row by row: CSV, WAV, NumPy. A file is never held in memory as a whole.

mod csv;
mod load;
mod npy;
mod wav;

pub use load::{MAX_KEPT, Recording, load, load_at_most};

use crate::error::{Problem, RecordingError};
use std::path::Path;

/// What a file says of itself before its first row.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// Names of the columns; numbers from 0 where the file has no names.
    pub columns: Vec<String>,
    /// Whether the file itself names them.
    pub named: bool,
    /// Rows a second, if the file says so.
    pub rate_hz: Option<f64>,
    /// Whether no value can lie outside ±1, as in a WAV of integers.
    pub full_scale: bool,
}

/// A row: its line from 1 and its values, NaN where one is missing. What comes back says whether to
/// go on.
pub(crate) type EachRow<'a> = dyn FnMut(u64, &[f64]) -> Result<bool, RecordingError> + 'a;

/// The kinds of files, by their extension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Csv,
    Wav,
    Npy,
}

fn format(path: &Path) -> Result<Format, RecordingError> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("csv" | "txt" | "tsv") => Ok(Format::Csv),
        Some("wav") => Ok(Format::Wav),
        Some("npy") => Ok(Format::Npy),
        _ => {
            let problem = Problem::Format("is none of .csv, .tsv, .txt, .wav, .npy".into());
            Err(RecordingError::of(path, problem))
        }
    }
}

/// The header of a file.
///
/// # Errors
/// [`RecordingError`] for a file that cannot be read or is of no known kind.
pub fn header(path: &Path) -> Result<Header, RecordingError> {
    match format(path)? {
        Format::Csv => csv::header(path),
        Format::Wav => wav::header(path),
        Format::Npy => npy::header(path),
    }
}

/// Calls `each` for every row of a file until it says to stop.
pub(crate) fn rows(path: &Path, each: &mut EachRow<'_>) -> Result<(), RecordingError> {
    match format(path)? {
        Format::Csv => csv::rows(path, each),
        Format::Wav => wav::rows(path, each),
        Format::Npy => npy::rows(path, each),
    }
}

fn unreadable(path: &Path) -> impl Fn(std::io::Error) -> RecordingError + '_ {
    move |error| RecordingError::of(path, Problem::Unreadable(error))
}
