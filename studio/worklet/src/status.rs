//! Status codes of the exports.

use asperity_runtime::{LoadError, PrepareError};

/// Status code of an export. `page/worklet.js` has the same numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// 16 kHz is not 1 to 20 times the rate of the asset's models, a whole number: the asset has to
    /// be compiled for another rate.
    Rate = 1,
    /// The bytes are not a valid asset, or not all of its haptic sections.
    Format = 2,
    /// The asset is larger than a slot of the runtime.
    Capacity = 3,
    /// Rounding could make the asset's filters unstable.
    Conditioning = 4,
    /// Every spare slot is on its way: try again after the next block.
    Busy = 5,
    /// No asset is loaded.
    Empty = 6,
    /// More bytes or events than the buffer holds.
    Length = 7,
    /// A number of an event is not finite, or a coordinate is beyond 10 m.
    Event = 8,
    /// The runtime refuses this processor or the configuration.
    Runtime = 9,
}

impl From<&LoadError> for Status {
    fn from(error: &LoadError) -> Self {
        match error {
            LoadError::Rate { .. } => Self::Rate,
            LoadError::Format(_) => Self::Format,
            LoadError::Capacity { .. } => Self::Capacity,
            LoadError::Conditioning { .. } => Self::Conditioning,
            _ => Self::Runtime,
        }
    }
}

impl From<&PrepareError> for Status {
    fn from(error: &PrepareError) -> Self {
        match error {
            PrepareError::NoneSpare => Self::Busy,
            PrepareError::Load(cause) => cause.into(),
            _ => Self::Runtime,
        }
    }
}
