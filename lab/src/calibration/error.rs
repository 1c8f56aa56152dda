//! Why a device cannot be calibrated.

use asperity_host::profile::ProfileError;
use asperity_host::profile::response::ResponseError;
use asperity_io::diagnostic::Diagnostic;
use asperity_io::input::InputError;

use super::table::COLUMNS;

/// Why a device cannot be calibrated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// The table cannot be read.
    #[error(transparent)]
    Read(#[from] InputError),
    /// The table is none.
    #[error("{file}:{line}: {what}")]
    Table {
        /// The file.
        file: String,
        /// The line, from 1.
        line: u64,
        /// The problem.
        what: String,
    },
    /// The times do not advance evenly.
    #[error("{file}:{line}: t_s = {found} after a period of {period_s} s")]
    Time {
        /// The file.
        file: String,
        /// The line, from 1.
        line: u64,
        /// The offending time, s.
        found: f64,
        /// The period of the first rows, s.
        period_s: f64,
    },
    /// No response can be estimated.
    #[error("{file}: {cause}")]
    Response {
        /// The file.
        file: String,
        /// Why.
        cause: ResponseError,
    },
    /// The acceleration does not follow from the force.
    #[error(
        "{file}: the acceleration follows from the force by {found:.2} only (coherence at {freq_hz:.0} Hz)"
    )]
    Coherence {
        /// The file.
        file: String,
        /// The least coherence.
        found: f64,
        /// Where.
        freq_hz: f64,
    },
    /// A gain, a force or a filter that no device has.
    #[error("{file}: {what}")]
    Implausible {
        /// The file.
        file: String,
        /// The implausible value.
        what: String,
        /// The remedy.
        remedy: String,
    },
    /// The profile to begin with is refused.
    #[error(transparent)]
    Profile(#[from] ProfileError),
}

impl Diagnostic for CalibrationError {
    fn remedy(&self) -> String {
        match self {
            Self::Read(error) => error.remedy(),
            Self::Table { .. } => format!("write the columns {} and one row per servo period", COLUMNS.join(",")),
            Self::Time { .. } => "write every servo period, each once, in order".into(),
            Self::Response { cause, .. } => cause.remedy().into(),
            Self::Coherence { .. } => {
                "fasten the accelerometer, hold the stylus by a thread or a weak spring, and raise the amplitude".into()
            }
            Self::Implausible { remedy, .. } => format!("{remedy}; --force keeps it"),
            Self::Profile(error) => error.remedy().into(),
        }
    }
}
