//! Comma, semicolon or tab separated values under a header, which may stand after `#`.
//!
//! Blank lines, comments and Excel's `sep=` may come first. The header is the first line that is none of
//! them. If that one holds numbers, it is the last comment with as many names as the line has numbers: boards
//! on a serial port and Klipper write `#time,accel_x,accel_y,accel_z`.

use super::{EachRow, Header, Remark, unreadable};
use crate::{
    error::{Problem, RecordingError},
    file::{self, Lines},
};
use csv::{ByteRecord, ReaderBuilder, Trim};
use std::{
    fs::File,
    io::{Read as _, Seek as _, SeekFrom},
    path::Path,
};

/// Longest header, bytes, with all that comes before it; a binary file has no line end for long.
const MAX_HEADER: u64 = 64 * 1024;
const DELIMITERS: [u8; 3] = [b',', b';', b'\t'];

/// Where the rows are, and how their columns are called.
struct Table {
    columns: Vec<String>,
    delimiter: u8,
    /// Bytes and lines before the first row.
    start: u64,
    lines: u64,
}

fn damaged(path: &Path, line: Option<u64>, what: String, remedy: &'static str) -> RecordingError {
    RecordingError {
        file: path.to_owned(),
        line,
        problem: Problem::File { what, remedy },
    }
}

fn open(path: &Path) -> Result<(File, Table), RecordingError> {
    let mut file = file::open(path)?;
    let mut start = Vec::new();
    (&mut file)
        .take(MAX_HEADER)
        .read_to_end(&mut start)
        .map_err(unreadable(path))?;
    if start.starts_with(&[0xff, 0xfe]) || start.starts_with(&[0xfe, 0xff]) {
        let what = "is text in UTF-16".to_owned();
        let remedy = "save it in UTF-8; Excel calls that \"CSV UTF-8\"";
        return Err(damaged(path, None, what, remedy));
    }
    if start.contains(&0) {
        let what = "is no text: it holds bytes of 0".to_owned();
        return Err(damaged(path, None, what, "save it as CSV in UTF-8"));
    }
    let table = table(&start).map_err(|(line, what)| {
        let remedy = "write one line with the names of the columns before the first row";
        damaged(path, Some(line), what.to_owned(), remedy)
    })?;
    file.seek(SeekFrom::Start(table.start))
        .map_err(unreadable(path))?;
    Ok((file, table))
}

/// The lines of a text with the bytes up to the end of each.
fn lines(text: &[u8]) -> impl Iterator<Item = (&[u8], usize)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let rest = text.get(at..).filter(|rest| !rest.is_empty())?;
        let length = rest
            .iter()
            .position(|byte| matches!(byte, b'\n' | b'\r'))
            .unwrap_or(rest.len());
        let end = if rest[length..].starts_with(b"\r\n") {
            2
        } else {
            1
        };
        at += length + end;
        Some((&rest[..length], at.min(text.len())))
    })
}

/// The separator that a line has most of, outside of quotes.
fn delimiter(line: &[u8]) -> u8 {
    let mut counts = [0; DELIMITERS.len()];
    let mut quoted = false;
    for byte in line {
        quoted ^= *byte == b'"';
        if let (false, Some(which)) = (quoted, DELIMITERS.iter().position(|d| d == byte)) {
            counts[which] += 1;
        }
    }
    // The first of those that are equal.
    let most = (0..counts.len()).rev().max_by_key(|&which| counts[which]);
    DELIMITERS[most.unwrap_or(0)]
}

fn fields(line: &[u8], delimiter: u8) -> Option<Vec<String>> {
    let mut reader = ReaderBuilder::new()
        .delimiter(delimiter)
        .has_headers(false)
        .trim(Trim::All)
        .from_reader(line);
    let mut record = ByteRecord::new();
    reader.read_byte_record(&mut record).ok()?;
    record
        .iter()
        .map(|field| Some(std::str::from_utf8(field).ok()?.to_owned()))
        .collect()
}

fn is_numbers(fields: &[String]) -> bool {
    fields.iter().all(|field| number(field).is_some())
}

/// Finds the header in the start of a file; a line and what is wrong with it where there is none.
fn table(start: &[u8]) -> Result<Table, (u64, &'static str)> {
    let mut comments: Vec<&[u8]> = Vec::new();
    let (mut stated, mut before) = (None, 0);
    for (line, (text, end)) in (1..).zip(lines(start)) {
        let text = text
            .strip_prefix(b"\xef\xbb\xbf")
            .unwrap_or(text)
            .trim_ascii();
        if let Some(&[delimiter]) = text.strip_prefix(b"sep=") {
            stated = Some(delimiter);
        } else if let Some(comment) = text.strip_prefix(b"#") {
            comments.push(comment);
        } else if !text.is_empty() {
            let delimiter = stated.unwrap_or_else(|| delimiter(text));
            let columns = fields(text, delimiter).ok_or((line, "is no text in UTF-8"))?;
            if !is_numbers(&columns) {
                let (start, lines) = (end as u64, line);
                return Ok(Table {
                    columns,
                    delimiter,
                    start,
                    lines,
                });
            }
            let names = comments.into_iter().rev().find_map(|comment| {
                let comment = comment.trim_ascii_start().trim_ascii_end();
                let comment = comment.strip_prefix(b"#").unwrap_or(comment);
                fields(comment, delimiter)
                    .filter(|names| names.len() == columns.len() && !is_numbers(names))
            });
            let columns = names.ok_or((
                line,
                "begins with numbers: it has no header that names its columns",
            ))?;
            let (start, lines) = (before, line - 1);
            return Ok(Table {
                columns,
                delimiter,
                start,
                lines,
            });
        }
        before = end as u64;
    }
    Err((
        1,
        "has no header: no line in its first 64 KiB names columns",
    ))
}

pub(super) fn header(path: &Path) -> Result<Header, RecordingError> {
    let (_, table) = open(path)?;
    Ok(Header {
        columns: table.columns,
        named: true,
        rate_hz: None,
        full_scale: false,
        remarks: Vec::new(),
    })
}

/// Rows, with NaN for what is no number in a column that is not `wanted`. A last row that is not whole is
/// left out with a remark.
pub(super) fn rows(
    path: &Path,
    wanted: &[usize],
    each: &mut EachRow<'_>,
) -> Result<Option<Remark>, RecordingError> {
    let (file, table) = open(path)?;
    let mut reader = ReaderBuilder::new()
        .delimiter(table.delimiter)
        .comment(Some(b'#'))
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(Lines::new(file));
    let width = table.columns.len();
    let is_wanted: Vec<bool> = (0..width).map(|column| wanted.contains(&column)).collect();
    let failed = |error: csv::Error| match error.into_kind() {
        csv::ErrorKind::Io(error) => RecordingError::of(path, Problem::Unreadable(error)),
        other => RecordingError::of(path, Problem::Format(format!("is no table ({other:?})"))),
    };
    let mut record = ByteRecord::new();
    let mut values = vec![f64::NAN; width];
    // The last row whose length is wrong: only at the end of the file may there be one.
    let mut odd: Option<(u64, usize)> = None;
    while reader.read_byte_record(&mut record).map_err(failed)? {
        let line = table.lines + record.position().map_or(0, csv::Position::line);
        let has_end = record.len() == width + 1 && record.get(width).is_some_and(<[u8]>::is_empty);
        if let Some((line, fields)) = odd.take() {
            let what = format!("has {fields} values where the header has {width}");
            let remedy = "correct or remove this line; a comma in a number counts as a separator";
            return Err(damaged(path, Some(line), what, remedy));
        }
        if record.len() != width && !has_end {
            odd = Some((line, record.len()));
            continue;
        }
        for (((field, column), value), wanted) in record
            .iter()
            .zip(&table.columns)
            .zip(&mut values)
            .zip(&is_wanted)
        {
            let text = std::str::from_utf8(field).unwrap_or("\u{fffd}");
            *value = match number(text) {
                Some(number) => number,
                None if !wanted => f64::NAN,
                None => {
                    let problem = Problem::NotANumber {
                        column: column.clone(),
                        value: text.chars().take(40).collect(),
                    };
                    return Err(RecordingError::at(path, line, problem));
                }
            };
        }
        if !each(line, &values)? {
            return Ok(None);
        }
    }
    Ok(odd.map(|(line, fields)| Remark {
        what: format!("is cut: its last row, line {line}, has {fields} values of {width}; the rows before are used"),
        remedy: "stop the logger before the file is copied, or remove this row",
    }))
}

/// A number; NaN for a value that is missing.
fn number(text: &str) -> Option<f64> {
    if text.is_empty() || text.eq_ignore_ascii_case("nan") || text.eq_ignore_ascii_case("na") {
        return Some(f64::NAN);
    }
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(start: &str) -> (Vec<String>, u8, u64) {
        let table = table(start.as_bytes()).unwrap_or_else(|(line, what)| panic!("{line} {what}"));
        (table.columns, table.delimiter, table.lines)
    }

    #[test]
    fn the_header_is_found_whatever_comes_before() {
        let expected = ["t", "x"].map(str::to_owned).to_vec();
        for (start, delimiter, lines) in [
            ("t,x\n0,1\n", b',', 1),
            ("\u{feff}\"t\";\"x\"\r\n0;1\r\n", b';', 1),
            ("sep=;\nt;x\n0;1\n", b';', 2),
            ("# made at a desk, with a, b, c\n\nt\tx\n0\t1\n", b'\t', 3),
            ("#t,x\n0,1\n", b',', 1),
            ("# a, b, c\n##t,x\n# 2 rows\n0,1\n", b',', 3),
            ("# t , x\r0,1\r", b',', 1),
        ] {
            assert_eq!(
                names(start),
                (expected.clone(), delimiter, lines),
                "{start:?}"
            );
        }
        assert_eq!(names("\"a, b\";x\n").0, ["a, b", "x"]);
    }

    #[test]
    fn a_file_without_a_header_says_so() {
        for (start, part) in [
            ("1,2\n", "begins with numbers"),
            ("# a,b,c\n1,2\n", "begins with numbers"),
            ("# a\n", "no header"),
        ] {
            let (_, what) = table(start.as_bytes()).err().unwrap_or((0, ""));
            assert!(what.contains(part), "{start:?} {what}");
        }
    }

    fn read(
        content: &str,
        wanted: &[usize],
    ) -> Result<(Vec<Vec<f64>>, Option<Remark>), RecordingError> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.csv");
        std::fs::write(&path, content).expect("written");
        let mut all = Vec::new();
        let remark = rows(&path, wanted, &mut |_, row| {
            all.push(row.to_vec());
            Ok(true)
        })?;
        Ok((all, remark))
    }

    #[test]
    fn text_matters_in_the_columns_that_are_asked_for() {
        let table = "t,label\n0,stroke\n1,air\n";
        let (all, _) = read(table, &[0]).expect("read");
        assert_eq!((all.len(), all[1][0]), (2, 1.0));
        let error = read(table, &[0, 1]).expect_err("asked for");
        assert!(
            error
                .to_string()
                .contains("a.csv:2: column \"label\" holds \"stroke\""),
            "{error}"
        );
    }

    #[test]
    fn the_last_row_alone_may_be_cut() {
        let (all, remark) = read("# c\nt,x\n0,1,\n1,2\n2", &[0, 1]).expect("read");
        assert_eq!(all.len(), 2);
        assert!(remark.expect("told").what.contains("line 5"));
        let error = read("t,x\n0,1\n1\n2,3\n", &[0, 1]).expect_err("not the last");
        assert!(
            error
                .to_string()
                .contains("a.csv:3: has 1 values where the header has 2"),
            "{error}"
        );
    }
}
