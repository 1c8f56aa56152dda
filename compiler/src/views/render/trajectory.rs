//! The table of a trajectory: columns, numbers and times, checked row by row.

use super::columns::INPUT_COLUMNS;
use asperity_io::{
    diagnostic::Fault,
    input::{InputKind, InputProblem},
    table::{Table, TableError, TableProblem, number},
};
use std::{
    io::{self, Read},
    path::Path,
};

/// A row's time may differ from its place by this share of a period: enough for times
/// printed with few digits, too little for another rate to go unnoticed for long.
const TIME_TOLERANCE: f64 = 0.25;

/// Row of a trajectory: time and position.
pub(super) struct TrajectoryRow {
    pub(super) t_s: f64,
    pub(super) position_mm: [f64; 3],
}

/// Checked rows of a trajectory.
pub(super) struct Rows<'a, R> {
    pub(super) file: &'a Path,
    table: Table<Bounded<R>>,
    columns: [usize; 4],
    rate_hz: f32,
    first_t_s: f64,
    row: u64,
}

impl<'a, R: Read> Rows<'a, R> {
    /// Reads the header.
    pub(super) fn new(file: &'a Path, input: R, rate_hz: f32) -> Result<Self, Fault> {
        let left = InputKind::Trajectory.max_bytes();
        let table = Table::open(Bounded { input, left }, &|_| false);
        let table = table.map_err(|error| fault(file, error))?;
        let line = table.layout().header;
        let mut columns = [0; 4];
        for (place, column) in columns.iter_mut().zip(INPUT_COLUMNS) {
            let names = table.layout().columns.iter().enumerate();
            let mut found = names.filter(|(_, name)| *name == column);
            let fault = match (found.next(), found.next()) {
                (Some((index, _)), None) => {
                    *place = index;
                    continue;
                }
                (None, _) => "is missing",
                (Some(_), Some(_)) => "appears twice",
            };
            let remedy = format!("start the file with the header {}", INPUT_COLUMNS.join(","));
            let fault = Fault::new(format!("column {column} {fault}"), remedy);
            return Err(fault.at(file).line(line));
        }
        Ok(Self {
            file,
            table,
            columns,
            rate_hz,
            first_t_s: 0.0,
            row: 0,
        })
    }

    /// The next row, if there is one.
    pub(super) fn next(&mut self) -> Result<Option<TrajectoryRow>, Fault> {
        let decimal_comma = self.table.layout().decimal_comma;
        let next = self.table.next_row();
        let Some(row) = next.map_err(|error| fault(self.file, error))? else {
            let Some((line, values)) = self.table.cut() else {
                return Ok(None);
            };
            let what = format!("is cut: it has {values} values");
            let remedy = "write the whole trajectory, or remove this row";
            let problem = TableProblem::Damaged { what, remedy };
            let line = Some(line);
            return Err(fault(self.file, TableError { line, problem }));
        };
        let line = row.line;
        let mut values = [0.0; 4];
        for (k, value) in values.iter_mut().enumerate() {
            let text = row.text(self.columns[k]);
            *value = number(&text, decimal_comma)
                .filter(|value| value.is_finite())
                .ok_or_else(|| {
                    let (column, value) = (INPUT_COLUMNS[k], text.chars().take(40));
                    let value: String = value.collect();
                    let what = format!("{column} = {value:?} is not a finite number");
                    let fault = Fault::new(what, "write a number, such as 12.5");
                    fault.at(self.file).line(line)
                })?;
        }
        let [t_s, x, y, z] = values;
        if self.row == 0 {
            self.first_t_s = t_s;
        }
        let due = self.first_t_s + self.row as f64 / f64::from(self.rate_hz);
        let slack = TIME_TOLERANCE / f64::from(self.rate_hz) + 1e-12 * due.abs();
        if (t_s - due).abs() > slack {
            let rate_hz = self.rate_hz;
            let what = format!(
                "t_s = {t_s} s, but at {rate_hz} Hz row {} must be at {due} s",
                self.row
            );
            let remedy = format!(
                "resample the trajectory to {rate_hz} Hz, so that t_s increases by {} s per row",
                1.0 / rate_hz
            );
            return Err(Fault::new(what, remedy).at(self.file).line(line));
        }
        self.row += 1;
        Ok(Some(TrajectoryRow {
            t_s,
            position_mm: [x, y, z],
        }))
    }
}

/// A reader that fails where the file gives too many bytes.
struct Bounded<R> {
    input: R,
    left: u64,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let len = self.input.read(buffer)?;
        let kind = InputKind::Trajectory;
        self.left = self
            .left
            .checked_sub(len as u64)
            .ok_or(InputProblem::TooLarge { kind })?;
        Ok(len)
    }
}

fn fault(file: &Path, error: TableError) -> Fault {
    match error.problem {
        TableProblem::Unreadable(cause) => Fault::from(InputProblem::from(cause)).at(file),
        _ => no_table(file, &error.to_string()),
    }
}

/// Returns the fault of a file that is no table, or an empty or a damaged one.
pub(super) fn no_table(file: &Path, what: &str) -> Fault {
    let header = INPUT_COLUMNS.join(",");
    let remedy = format!("give UTF-8 text with the header {header} and one row per tick");
    Fault::new(what, remedy).at(file)
}
