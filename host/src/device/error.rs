//! Why a device gave nothing, or took nothing, in a period.

use thiserror::Error;

/// Why a device gave nothing, or took nothing, in a period. It is small and made without an
/// allocation, since the servo thread makes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// Nothing came within the time.
    #[error("the device did not answer in time")]
    TimedOut,
    /// The device is gone.
    #[error("the device is gone")]
    Disconnected,
    /// Fewer bytes were transferred than a frame has.
    #[error("a transfer ended early: {got} of {wanted} bytes")]
    ShortTransfer {
        /// Bytes that were transferred.
        got: u16,
        /// Bytes of a frame.
        wanted: u16,
    },
    /// The endpoint stalled.
    #[error("the device refused a transfer (stall)")]
    Stalled,
    /// A frame that is not one.
    #[error("the device sent a frame that cannot be read")]
    Garbled,
    /// The motors are too warm.
    #[error("the motors are too warm")]
    WarmMotors,
    /// The device cut off a force that was too large.
    #[error("the device cut off a force that was too large")]
    ForceExceeded,
    /// The device was not calibrated, or lost its calibration.
    #[error("the device is not calibrated")]
    NotCalibrated,
    /// Another error of a vendor's library.
    #[error("the vendor's library reports error {0:#x}")]
    Vendor(i32),
}
