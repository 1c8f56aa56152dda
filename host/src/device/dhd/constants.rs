//! Numbers of the Force Dimension DHD interface that this back end uses.
//!
//! They are facts of the interface. `interface.rs` compares them with an openly licensed
//! description.

/// Success: the newest data are less old than the time guard, so nothing was asked of the device.
pub(super) const TIMEGUARD: i32 = 1;
/// Places of a status.
pub(super) const MAX_STATUS: usize = 17;
/// Place in a status: whether the device is calibrated.
pub(super) const STATUS_RESET: usize = 3;
/// Place in a status: whether forces are on.
pub(super) const STATUS_FORCE: usize = 5;
/// Place in a status: whether the device has an error.
pub(super) const STATUS_ERROR: usize = 9;
/// Place in a status: why forces went off.
pub(super) const STATUS_FORCEOFFCAUSE: usize = 14;

/// Forces went off since the stylus moved too fast.
pub(super) const FORCE_OFF_VELOCITY: i32 = 2;

/// The connection failed.
pub(super) const ERROR_COM: i32 = 2;
/// The controller is busy.
pub(super) const ERROR_DHC_BUSY: i32 = 3;
/// No driver.
pub(super) const ERROR_NO_DRIVER_FOUND: i32 = 4;
/// No device.
pub(super) const ERROR_NO_DEVICE_FOUND: i32 = 5;
/// No answer in time.
pub(super) const ERROR_TIMEOUT: i32 = 7;
/// The device is not ready, or not calibrated.
pub(super) const ERROR_DEVICE_NOT_READY: i32 = 12;
/// A configuration is missing.
pub(super) const ERROR_CONFIGURATION: i32 = 14;
/// Another program has the device.
pub(super) const ERROR_DEVICE_IN_USE: i32 = 20;
