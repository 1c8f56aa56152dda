//! Why a texture does not fit a slot.

use asperity_formats::FormatError;
use thiserror::Error;

/// Why a texture does not fit a slot.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The bytes are not a valid asset.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// More of something than the slot has room for.
    #[error("{field}: the texture has {found}, the slot has room for {capacity}")]
    Capacity {
        /// Name of the capacity.
        field: &'static str,
        /// Required by the texture.
        found: usize,
        /// Capacity of the slot.
        capacity: usize,
    },
    /// The servo rate is no whole multiple of the models' rate, or more than 20 times it.
    #[error(
        "grid.sample_rate_hz: models run at {model_hz} Hz, the servo at {servo_hz} Hz, which must be 1 to 20 times as much, a whole number; convert the texture"
    )]
    Rate {
        /// Rate of the models, Hz.
        model_hz: f32,
        /// Rate of the servo loop, Hz.
        servo_hz: f32,
    },
    /// The processor is set to round otherwise than to nearest: the texture would have other bits.
    #[error("the processor rounds otherwise than to nearest: reset its rounding mode")]
    Rounding,
    /// A model whose filter rounding could make unstable.
    #[error(
        "grid.models[{model}]: |A| ranges over a factor of {range:.1e}, which must be at most {most:e}: rounding could make the filter unstable; take a lower order, or move the line spectral frequencies apart"
    )]
    Conditioning {
        /// Index of the model.
        model: usize,
        /// max |A(e^jω)| / min |A(e^jω)|.
        range: f32,
        /// The largest that loads.
        most: f32,
    },
    /// A number beyond what fixed point can hold.
    #[error("{field} = {value}: a tick in fixed point takes {least} to {most}")]
    Range {
        /// Which number.
        field: &'static str,
        /// Its value.
        value: f32,
        /// The smallest that fits.
        least: f32,
        /// The largest that fits.
        most: f32,
    },
}
