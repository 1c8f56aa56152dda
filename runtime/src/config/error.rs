//! Why a configuration is refused.

use thiserror::Error;

/// A configuration that makes no sense.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("config {field} = {value}: {rule}")]
pub struct ConfigError {
    /// Which field.
    pub field: &'static str,
    /// Its value.
    pub value: f32,
    /// The rule it breaks.
    pub rule: &'static str,
}

impl ConfigError {
    /// The processor is set to round otherwise than to nearest, which no field can say.
    pub const ROUNDING: Self = Self {
        field: "rounds_to_nearest",
        value: 0.0,
        rule: "the processor rounds otherwise than to nearest: reset its rounding mode",
    };
}
