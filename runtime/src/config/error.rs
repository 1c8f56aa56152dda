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
