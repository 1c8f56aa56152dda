//! TOML files of the simulator: they are parsed strictly, and every value is checked.

use std::ops::RangeInclusive;
use std::path::Path;

use asperity_io::diagnostic::Diagnostic;
use asperity_io::input::{self, InputError, InputKind};
use asperity_io::toml_error::TomlError;
use serde::de::DeserializeOwned;

/// Why a device or grip file was refused.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file could not be read, is too large, or is not UTF-8.
    #[error(transparent)]
    Read(#[from] InputError),
    /// Not TOML, or not the expected keys.
    #[error("{file}:{}:{}: {}", place.line, place.column, place.message)]
    Parse {
        /// The file.
        file: String,
        /// Where, and what the parser expected.
        place: TomlError,
    },
    /// A value outside its range.
    #[error("{file}: `{field}` = {value} is outside {min}..={max} {unit}")]
    Range {
        /// The file.
        file: String,
        /// Dotted name of the field, with its index in an array.
        field: String,
        /// The value found.
        value: f64,
        /// Smallest accepted value.
        min: f64,
        /// Largest accepted value.
        max: f64,
        /// Unit of value and range; empty for counts.
        unit: &'static str,
    },
    /// A value that is as good as zero, and by which nothing can be divided.
    #[error("{file}: `{field}` = {value:e} is too small to compute with")]
    Tiny {
        /// The file.
        file: String,
        /// Dotted name of the field, with its index in an array.
        field: String,
        /// The value found.
        value: f64,
    },
    /// `unconfirmed` names something that is not a field.
    #[error("{file}: `unconfirmed` names `{name}`, which is not a field of the file")]
    UnknownField {
        /// The file.
        file: String,
        /// The name found.
        name: String,
    },
    /// Two values that contradict each other.
    #[error("{file}: `{field}` = {value} must not exceed `{other}` = {limit}")]
    Order {
        /// The file.
        file: String,
        /// The larger field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The field that bounds it.
        other: &'static str,
        /// Its value.
        limit: f64,
    },
}

impl Diagnostic for ConfigError {
    fn remedy(&self) -> String {
        match self {
            Self::Read(error) => error.remedy(),
            Self::Parse { .. } => {
                "compare with device-sim/devices/touch.toml or device-sim/grips/light.toml".into()
            }
            Self::Range {
                field,
                min,
                max,
                unit,
                ..
            } => format!("set `{field}` to a value in {min}..={max} {unit}")
                .trim_end()
                .into(),
            Self::Tiny { field, .. } => format!("set `{field}` to 0, or to {TINY:e} or more"),
            Self::UnknownField { .. } => {
                "write the dotted name of a field, e.g. \"mechanics.mass_kg\"".into()
            }
            Self::Order { field, other, .. } => format!("lower `{field}` or raise `{other}`"),
        }
    }
}

/// Reads a whole text file.
pub(crate) fn read_text(path: &Path) -> Result<String, ConfigError> {
    let text = input::read_text(path, InputKind::Settings);
    text.map_err(|problem| {
        let file = path.to_path_buf();
        ConfigError::Read(InputError { file, problem })
    })
}

/// Parses TOML, with the place in the error.
pub(crate) fn parse<T: DeserializeOwned>(text: &str, file: &str) -> Result<T, ConfigError> {
    toml::from_str(text).map_err(|error| ConfigError::Parse {
        file: file.into(),
        place: TomlError::new(text, &error),
    })
}

/// Nothing that a device or a hand has is smaller than this and not zero, in any unit.
const TINY: f64 = 1e-12;

/// Checks one value; NaN is outside every range.
pub(crate) fn check(
    file: &str,
    field: impl Into<String>,
    value: f64,
    range: RangeInclusive<f64>,
    unit: &'static str,
) -> Result<(), ConfigError> {
    if range.contains(&value) && value != 0.0 && value.abs() < TINY {
        return Err(ConfigError::Tiny {
            file: file.into(),
            field: field.into(),
            value,
        });
    }
    if range.contains(&value) {
        return Ok(());
    }
    Err(ConfigError::Range {
        file: file.into(),
        field: field.into(),
        value,
        min: *range.start(),
        max: *range.end(),
        unit,
    })
}

/// Checks every component of a vector, naming the index.
pub(crate) fn check_axes(
    file: &str,
    field: &str,
    values: [f64; 3],
    range: RangeInclusive<f64>,
    unit: &'static str,
) -> Result<(), ConfigError> {
    for (axis, value) in values.into_iter().enumerate() {
        check(file, format!("{field}[{axis}]"), value, range.clone(), unit)?;
    }
    Ok(())
}

/// Checks that `unconfirmed` names fields only.
pub(crate) fn check_names(file: &str, names: &[String], known: &[&str]) -> Result<(), ConfigError> {
    match names.iter().find(|name| !known.contains(&name.as_str())) {
        None => Ok(()),
        Some(name) => Err(ConfigError::UnknownField {
            file: file.into(),
            name: name.clone(),
        }),
    }
}
