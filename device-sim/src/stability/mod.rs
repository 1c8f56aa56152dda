//! Where methods fail: a table of scenarios with the figure of ours and of others.
//!
//! Every row states a figure that must not exceed a limit. Ours comes from the runtime
//! itself; the others ([`methods`]) follow the paper, the reference renderer or the textbook
//! as published descriptions have them. Everything is seeded and runs in virtual time.
//!
//! | file | tries |
//! |---|---|
//! | [`grid`] | queries on edges, on the border and beyond |
//! | [`mixing`] | mixtures of models, parameters that change every sample |
//! | [`coefficients`] | poles near the circle, coefficients in 16 bits |
//! | [`friction`] | rest, ramps, reversal, closed paths |
//! | [`wall`] | stiff walls, delay, lost samples, counts, grips |
//! | [`tap`] | bouncing, grazing, sliding, taps in close succession |
//! | [`change`] | another texture in mid-stroke |
//! | [`fault`] | NaN, stuck samples |
//!
//! [`observer`] measures energy; [`sheet`] draws the map of stable walls and the worst
//! waveforms; [`markdown`] prints the tables of the documentation.

pub mod change;
pub mod coefficients;
pub mod fault;
pub mod friction;
pub mod grid;
pub mod markdown;
pub mod material;
pub mod methods;
pub mod mixing;
pub mod observer;
pub mod row;
pub mod sheet;
pub mod tap;
pub mod wall;

use std::fmt;
use std::path::PathBuf;

use asperity::diagnostic::Diagnostic;
use asperity_plot::PlotError;
use serde::Serialize;

pub use material::Material;
pub use row::{Other, Row, Verdict, Words};

/// What to try, and with what.
#[derive(Debug, Clone, Default)]
pub struct StabilityOptions {
    /// Folder of HaTT XML files, for the rows that need real materials.
    pub hatt: Option<PathBuf>,
    /// Seed of everything random.
    pub seed: u64,
}

/// Why the table could not be made.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// A HaTT folder was refused.
    #[error(transparent)]
    Hatt(#[from] asperity::hatt::HattError),
    /// A HaTT material could not be imported.
    #[error(transparent)]
    Import(#[from] asperity::hatt::ImportError),
    /// A built-in file was refused.
    #[error(transparent)]
    Config(#[from] crate::config::ConfigError),
    /// A texture could not be lowered.
    #[error(transparent)]
    Lower(#[from] asperity::lower::LowerError),
    /// A picture could not be drawn.
    #[error(transparent)]
    Plot(#[from] PlotError),
}

impl Diagnostic for StabilityError {
    fn remedy(&self) -> String {
        match self {
            Self::Hatt(error) => error.remedy(),
            Self::Import(error) => error.remedy(),
            Self::Config(error) => error.remedy(),
            Self::Lower(error) => error.remedy(),
            Self::Plot(_) => "report this as a bug".into(),
        }
    }
}

/// Every row.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// The rows, theme by theme.
    pub rows: Vec<Row>,
}

impl Table {
    /// How many rows pass, fail, were skipped.
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

    /// The last line of the table.
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
    rows.extend(tap::rows()?);
    rows.extend(change::rows(options.seed)?);
    rows.extend(fault::rows(options.seed)?);
    Ok(Table { rows })
}
