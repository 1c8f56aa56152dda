//! The table of a trajectory: columns, numbers and times, checked row by row.

use super::{columns::INPUT_COLUMNS, error::RenderError, limits::MAX_ROW_BYTES};
use asperity_io::input::{InputError, InputProblem, Kind};
use std::{
    cell::Cell,
    io::{self, Read},
    path::Path,
    rc::Rc,
};

/// A row's time may differ from its place by this share of a period: enough for times
/// printed with few digits, too little for another rate to go unnoticed for long.
const TIME_TOLERANCE: f64 = 0.25;

/// One row: time and position.
pub(super) struct Row {
    pub(super) t_s: f64,
    pub(super) position_mm: [f64; 3],
}

/// Checked rows of a trajectory.
pub(super) struct Rows<'a, R> {
    pub(super) file: &'a Path,
    reader: csv::Reader<Bounded<R>>,
    row_bytes: Rc<Cell<usize>>,
    columns: [usize; 4],
    record: csv::StringRecord,
    rate_hz: f32,
    first_t_s: f64,
    row: u64,
}

impl<'a, R: Read> Rows<'a, R> {
    /// Reads the header.
    pub(super) fn new(file: &'a Path, input: R, rate_hz: f32) -> Result<Self, RenderError> {
        let row_bytes = Rc::new(Cell::new(0));
        let input = Bounded {
            input,
            row_bytes: Rc::clone(&row_bytes),
            left: Kind::Trajectory.max_bytes(),
        };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .buffer_capacity(BUFFER_BYTES)
            .from_reader(input);
        let headers = reader.headers().map_err(|e| csv_error(file, 1, e))?;
        let mut columns = [0; 4];
        for (place, column) in columns.iter_mut().zip(INPUT_COLUMNS) {
            let is_it = |name: &str| name.trim_start_matches('\u{feff}') == column;
            let mut found = headers.iter().enumerate().filter(|(_, name)| is_it(name));
            *place = found
                .next()
                .ok_or_else(|| RenderError::MissingColumn {
                    file: file.to_owned(),
                    column,
                })?
                .0;
            if found.next().is_some() {
                return Err(RenderError::RepeatedColumn {
                    file: file.to_owned(),
                    column,
                });
            }
        }
        Ok(Self {
            file,
            reader,
            row_bytes,
            columns,
            record: csv::StringRecord::new(),
            rate_hz,
            first_t_s: 0.0,
            row: 0,
        })
    }

    /// The next row, if there is one.
    pub(super) fn next(&mut self) -> Result<Option<Row>, RenderError> {
        self.row_bytes.set(0);
        let line = self.reader.position().line();
        let more = self
            .reader
            .read_record(&mut self.record)
            .map_err(|e| csv_error(self.file, line, e))?;
        if !more {
            return Ok(None);
        }
        let line = self.record.position().map_or(0, csv::Position::line);
        let mut values = [0.0; 4];
        for (k, value) in values.iter_mut().enumerate() {
            let text = self.record.get(self.columns[k]).unwrap_or_default();
            *value = text
                .parse()
                .ok()
                .filter(|value: &f64| value.is_finite())
                .ok_or_else(|| RenderError::NotANumber {
                    file: self.file.to_owned(),
                    line,
                    column: INPUT_COLUMNS[k],
                    value: text.chars().take(40).collect(),
                })?;
        }
        let [t_s, x, y, z] = values;
        if self.row == 0 {
            self.first_t_s = t_s;
        }
        let due = self.first_t_s + self.row as f64 / f64::from(self.rate_hz);
        let slack = TIME_TOLERANCE / f64::from(self.rate_hz) + 1e-12 * due.abs();
        if (t_s - due).abs() > slack {
            return Err(RenderError::Rate {
                file: self.file.to_owned(),
                line,
                row: self.row,
                found: t_s,
                due,
                rate_hz: self.rate_hz,
            });
        }
        self.row += 1;
        Ok(Some(Row {
            t_s,
            position_mm: [x, y, z],
        }))
    }
}

/// Bytes that the parser reads at once.
const BUFFER_BYTES: usize = 8 * 1024;

/// A reader that fails where one row, or the file, gives too many bytes. The parser keeps a row in
/// memory, however long it is, and an unclosed quotation mark turns the rest into one row.
struct Bounded<R> {
    input: R,
    /// Bytes read since the row before was complete: the row's, and what the parser reads ahead.
    row_bytes: Rc<Cell<usize>>,
    left: u64,
}

/// What [`Bounded`] tells [`csv_error`].
#[derive(Debug, thiserror::Error)]
#[error("the row is too long")]
struct RowTooLong;

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.row_bytes.get() > MAX_ROW_BYTES + BUFFER_BYTES {
            return Err(io::Error::other(RowTooLong));
        }
        let len = self.input.read(buffer)?;
        self.row_bytes.set(self.row_bytes.get() + len);
        let kind = Kind::Trajectory;
        self.left = self
            .left
            .checked_sub(len as u64)
            .ok_or(InputProblem::TooLarge { kind })?;
        Ok(len)
    }
}

fn csv_error(file: &Path, line: u64, error: csv::Error) -> RenderError {
    let file = file.to_owned();
    let text = error.to_string();
    match error.into_kind() {
        csv::ErrorKind::Io(cause) if cause.get_ref().is_some_and(|e| e.is::<RowTooLong>()) => {
            RenderError::RowTooLong { file, line }
        }
        csv::ErrorKind::Io(cause) => {
            let problem = cause.into();
            RenderError::Input(InputError { file, problem })
        }
        _ => RenderError::NotCsv { file, cause: text },
    }
}
