//! Why a profile is refused.

use thiserror::Error;

/// Why a profile is refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The system could not read it.
    #[error("{file}: {cause}")]
    Read {
        /// The file.
        file: String,
        /// Error of the system.
        cause: std::io::Error,
    },
    /// It is not TOML, or has other keys.
    #[error("{file}: {message}")]
    Parse {
        /// The file.
        file: String,
        /// Where and what.
        message: String,
    },
    /// A value outside its range.
    #[error("{file}: `{field}` = {value} is outside {min}..={max} {unit}")]
    Range {
        /// The file.
        file: String,
        /// Dotted name.
        field: &'static str,
        /// Value found.
        value: f32,
        /// The smallest value.
        min: f32,
        /// The largest value.
        max: f32,
        /// Unit of the value.
        unit: &'static str,
    },
    /// `unconfirmed` names no field.
    #[error("{file}: `unconfirmed` names `{name}`, which is no field of a profile")]
    UnknownField {
        /// The file.
        file: String,
        /// Name found.
        name: String,
    },
    /// A filter that cannot be used.
    #[error("{file}: `compensation.taps`: {rule}")]
    Filter {
        /// The file.
        file: String,
        /// The rule that it breaks.
        rule: &'static str,
    },
}

impl ProfileError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Read { .. } => "check the path and your rights",
            Self::Filter { .. } => {
                "measure the device again with `asperity-lab device calibrate`, or leave out `[compensation]`"
            }
            _ => "compare the file with host/devices/touch.toml",
        }
    }
}
