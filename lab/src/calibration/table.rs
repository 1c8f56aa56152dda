//! The table of a measurement: `t_s,force_n,accel_m_s2`, a row a servo period.

use std::path::Path;

use asperity_io::input::{self, InputError, InputKind};
use asperity_io::table::{Table, TableError};

use super::{CalibrationError, Measured};

/// The columns of a table.
pub(super) const COLUMNS: [&str; 3] = ["t_s", "force_n", "accel_m_s2"];

impl Measured {
    /// The table as a file.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = COLUMNS.join(",") + "\n";
        for (n, (force, accel)) in self.force_n.iter().zip(&self.accel_m_s2).enumerate() {
            text += &format!("{},{force},{accel}\n", n as f64 / self.rate_hz);
        }
        text
    }

    /// Reads a table.
    ///
    /// # Errors
    /// [`CalibrationError`] with file and line.
    pub fn load(path: &Path) -> Result<Self, CalibrationError> {
        let text = input::read_text(path, InputKind::Trajectory).map_err(|problem| InputError {
            file: path.to_path_buf(),
            problem,
        })?;
        Self::from_csv(&text, &path.display().to_string())
    }

    /// Parses a table; `file` names it in errors.
    ///
    /// # Errors
    /// [`CalibrationError`] with file and line.
    pub fn from_csv(text: &str, file: &str) -> Result<Self, CalibrationError> {
        let fail = |line, what: String| CalibrationError::Table {
            file: file.into(),
            line,
            what,
        };
        let damaged = |error: TableError| {
            let line = error.line.unwrap_or(1);
            fail(line, error.problem.to_string())
        };
        // Units are in the names.
        let mut table = Table::open(text.as_bytes(), &|_| false).map_err(damaged)?;
        let names = &table.layout().columns;
        let mut places = [0; 3];
        for (place, column) in places.iter_mut().zip(COLUMNS) {
            let found = names.iter().position(|name| name == column);
            *place = found.ok_or_else(|| {
                let (found, needed) = (names.join(","), COLUMNS.join(","));
                let what = format!("the columns are {found}, but must be {needed}");
                fail(table.layout().header, what)
            })?;
        }
        let mut columns: [Vec<f64>; 3] = Default::default();
        while let Some(row) = table.next_row().map_err(damaged)? {
            for ((values, place), column) in columns.iter_mut().zip(places).zip(COLUMNS) {
                let value = row.number(place).filter(|value| value.is_finite());
                values.push(value.ok_or_else(|| {
                    fail(
                        row.line,
                        format!("{column} = `{}` is no number", row.text(place)),
                    )
                })?);
            }
            even(&columns[0]).map_err(|period_s| CalibrationError::Time {
                file: file.into(),
                line: row.line,
                found: columns[0].last().copied().unwrap_or_default(),
                period_s,
            })?;
        }
        if let Some((line, _)) = table.cut() {
            return Err(fail(line, "the row is not whole".into()));
        }
        let [times_s, force_n, accel_m_s2] = columns;
        let [first, second, ..] = times_s[..] else {
            return Err(fail(2, "no two rows".into()));
        };
        let spanned_s = times_s.last().copied().unwrap_or(second) - first;
        Ok(Self {
            rate_hz: (times_s.len() - 1) as f64 / spanned_s,
            force_n,
            accel_m_s2,
        })
    }
}

/// Checks that the last step is near the period of the first two times. The error is that period.
fn even(times_s: &[f64]) -> Result<(), f64> {
    let (&[first, second, ..], &[.., before, last]) = (times_s, times_s) else {
        return Ok(());
    };
    let period_s = second - first;
    if period_s > 0.0 && ((last - before) / period_s - 1.0).abs() < 0.5 {
        Ok(())
    } else {
        Err(period_s)
    }
}
