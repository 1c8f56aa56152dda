//! The table: all rows, and how they are made.

use std::fmt;
use std::path::PathBuf;

use serde::Serialize;

use super::error::StabilityError;
use super::row::{ScenarioResult, Verdict};
use super::{change, coefficients, contact, fault, friction, grid, material, mixing, tap, wall};

/// Which materials to try, and the seed.
#[derive(Debug, Clone, Default)]
pub struct StabilityOptions {
    /// Folder of HaTT XML files, for the rows that need real materials.
    pub hatt: Option<PathBuf>,
    /// Seed of everything random.
    pub seed: u64,
}

/// All rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// The rows, theme by theme.
    pub rows: Vec<ScenarioResult>,
}

impl Table {
    /// Returns the numbers of rows that pass, fail and were skipped.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        let count = |wanted: fn(&Verdict) -> bool| {
            self.rows.iter().filter(|row| wanted(&row.verdict)).count()
        };
        [
            count(|v| *v == Verdict::Pass),
            count(|v| *v == Verdict::Fail),
            count(|v| matches!(v, Verdict::Skipped(_))),
        ]
    }

    /// The last line of the table, with the counts.
    #[must_use]
    pub fn summary(&self) -> String {
        let [passed, failed, skipped] = self.counts();
        format!(
            "{} rows: {passed} passed, {failed} failed, {skipped} skipped",
            self.rows.len()
        )
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for row in &self.rows {
            writeln!(f, "{row}")?;
        }
        write!(f, "{}", self.summary())
    }
}

/// Makes the table.
///
/// # Errors
/// [`StabilityError`] for a HaTT folder that cannot be read.
pub fn run(options: &StabilityOptions) -> Result<Table, StabilityError> {
    let materials = material::all(options.hatt.as_deref())?;
    let mut rows = Vec::new();
    rows.extend(grid::rows(&materials, options.seed));
    rows.extend(mixing::rows(&materials, options.seed));
    rows.extend(coefficients::rows(&materials, options.seed));
    rows.extend(friction::rows(options.seed)?);
    rows.extend(wall::rows(options.seed)?);
    rows.extend(contact::rows(options.seed)?);
    rows.extend(tap::rows()?);
    rows.extend(change::rows(options.seed)?);
    rows.extend(fault::rows(options.seed)?);
    Ok(Table { rows })
}
