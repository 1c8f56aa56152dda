//! The table of a measurement: `t_s,force_n,accel_m_s2`, a row a servo period.

use std::path::Path;

use asperity_io::input::{self, InputError, Kind};

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
        let text = input::read_text(path, Kind::Trajectory).map_err(|problem| InputError {
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
        let table = |line, what: String| CalibrationError::Table {
            file: file.into(),
            line,
            what,
        };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let head = reader
            .headers()
            .map_err(|error| table(1, error.to_string()))?;
        if !head.iter().eq(COLUMNS) {
            let found: Vec<&str> = head.iter().collect();
            return Err(table(
                1,
                format!(
                    "the columns are {}, but must be {}",
                    found.join(","),
                    COLUMNS.join(",")
                ),
            ));
        }
        let (mut times_s, mut force_n, mut accel_m_s2) = (Vec::new(), Vec::new(), Vec::new());
        for record in reader.records() {
            let record = record.map_err(|error| {
                let line = error.position().map_or(0, csv::Position::line);
                table(line, error.to_string())
            })?;
            let line = record.position().map_or(0, csv::Position::line);
            for (column, values) in [&mut times_s, &mut force_n, &mut accel_m_s2]
                .into_iter()
                .enumerate()
            {
                let cell = record.get(column).unwrap_or_default();
                let value: Option<f64> = cell.parse().ok().filter(|value: &f64| value.is_finite());
                values.push(value.ok_or_else(|| {
                    table(line, format!("{} = `{cell}` is no number", COLUMNS[column]))
                })?);
            }
            even(&times_s).map_err(|period_s| CalibrationError::Time {
                file: file.into(),
                line,
                found: times_s.last().copied().unwrap_or_default(),
                period_s,
            })?;
        }
        let [first, second, ..] = times_s[..] else {
            return Err(table(2, "no two rows".into()));
        };
        let spanned_s = times_s.last().copied().unwrap_or(second) - first;
        Ok(Self {
            rate_hz: (times_s.len() - 1) as f64 / spanned_s,
            force_n,
            accel_m_s2,
        })
    }
}

/// Whether the last time follows after the period of the first two; the period where it does not.
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
