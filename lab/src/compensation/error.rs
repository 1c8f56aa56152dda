//! Errors of compensating a texture for a device.

use asperity::emit::lower::LowerError;
use asperity_formats::{EncodeError, FormatError};
use asperity_io::diagnostic::Diagnostic;

/// Why a texture cannot take a device's filter.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompensationError {
    /// The bytes are no asset.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The filter has a zero outside of the unit circle.
    #[error("vertex {vertex}: with the device's filter, a zero leaves the unit circle")]
    Numerator {
        /// Which vertex of the grid.
        vertex: usize,
    },
    /// The result is outside of the format's limits.
    #[error("with the device's filter: {0}")]
    Lower(#[from] LowerError),
    /// The library cannot be written.
    #[error("with the device's filter: {0}")]
    Encode(#[from] EncodeError),
}

impl Diagnostic for CompensationError {
    fn remedy(&self) -> String {
        match self {
            Self::Format(_) => "build the file again from its source".into(),
            _ => "measure the device again with `asperity-lab device calibrate`, or leave out \
                  `[compensation]` of its profile"
                .into(),
        }
    }
}
