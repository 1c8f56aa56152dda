//! Comma, semicolon or tab separated values with one header line.

use super::{EachRow, Header, unreadable};
use crate::{
    error::{Problem, RecordingError},
    file::{self, Lines},
};
use csv::{ByteRecord, Reader, ReaderBuilder, Trim};
use std::{
    fs::File,
    io::{BufRead, BufReader, Read as _},
    path::Path,
};

/// Longest header line, bytes; a binary file has no line end for long.
const MAX_HEADER: u64 = 64 * 1024;

fn open(path: &Path) -> Result<Reader<Lines<File>>, RecordingError> {
    let mut first = Vec::new();
    BufReader::new(file::open(path)?.take(MAX_HEADER))
        .read_until(b'\n', &mut first)
        .map_err(unreadable(path))?;
    let count = |separator: u8| first.iter().filter(|byte| **byte == separator).count();
    let delimiter = [b',', b';', b'\t']
        .into_iter()
        .max_by_key(|&separator| count(separator))
        .unwrap_or(b',');
    Ok(ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(Lines::new(file::open(path)?)))
}

fn damaged(path: &Path) -> impl Fn(csv::Error) -> RecordingError + '_ {
    move |error| {
        let line = error.position().map(csv::Position::line);
        let problem = match error.into_kind() {
            csv::ErrorKind::Io(error) => Problem::Unreadable(error),
            csv::ErrorKind::UnequalLengths {
                expected_len, len, ..
            } => Problem::Format(format!(
                "has {len} values where the header has {expected_len}"
            )),
            _ => Problem::Format("is no text in UTF-8".into()),
        };
        RecordingError {
            file: path.to_owned(),
            line,
            problem,
        }
    }
}

pub(super) fn header(path: &Path) -> Result<Header, RecordingError> {
    let mut reader = open(path)?;
    let names = reader.headers().map_err(damaged(path))?;
    let columns: Vec<String> = names
        .iter()
        .map(|name| name.trim_start_matches('\u{feff}').to_owned())
        .collect();
    if columns.iter().all(|name| name.parse::<f64>().is_ok()) {
        let problem =
            Problem::Format("begins with numbers: the first line must name the columns".into());
        return Err(RecordingError::at(path, 1, problem));
    }
    Ok(Header {
        columns,
        named: true,
        rate_hz: None,
        full_scale: false,
    })
}

pub(super) fn rows(path: &Path, each: &mut EachRow<'_>) -> Result<(), RecordingError> {
    let Header { columns, .. } = header(path)?;
    let mut reader = open(path)?;
    let mut record = ByteRecord::new();
    let mut values = Vec::with_capacity(columns.len());
    while reader
        .read_byte_record(&mut record)
        .map_err(damaged(path))?
    {
        let line = record.position().map_or(0, csv::Position::line);
        values.clear();
        for (field, column) in record.iter().zip(&columns) {
            let text = std::str::from_utf8(field).unwrap_or("\u{fffd}");
            values.push(number(text).ok_or_else(|| {
                let problem = Problem::NotANumber {
                    column: column.clone(),
                    value: text.chars().take(40).collect(),
                };
                RecordingError::at(path, line, problem)
            })?);
        }
        if !each(line, &values)? {
            break;
        }
    }
    Ok(())
}

/// A number; NaN for a value that is missing.
fn number(text: &str) -> Option<f64> {
    if text.is_empty() || text.eq_ignore_ascii_case("nan") || text.eq_ignore_ascii_case("na") {
        return Some(f64::NAN);
    }
    text.parse().ok()
}
