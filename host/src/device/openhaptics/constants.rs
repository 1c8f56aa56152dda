//! Numbers of the OpenHaptics HD interface that this back end uses.
//!
//! They are facts of the interface. `interface.rs` compares them with an openly licensed
//! description.

/// No error.
pub(super) const HD_SUCCESS: u32 = 0x0000;
/// The motors are too warm.
pub(super) const HD_WARM_MOTORS: u32 = 0x0200;
/// The force was too large.
pub(super) const HD_EXCEEDED_MAX_FORCE: u32 = 0x0201;
/// The force changed too fast.
pub(super) const HD_EXCEEDED_MAX_FORCE_IMPULSE: u32 = 0x0202;
/// The stylus moved too fast.
pub(super) const HD_EXCEEDED_MAX_VELOCITY: u32 = 0x0203;
/// The device is faulty, or its plug was pulled.
pub(super) const HD_DEVICE_FAULT: u32 = 0x0300;
/// Another program has the device.
pub(super) const HD_DEVICE_ALREADY_INITIATED: u32 = 0x0301;
/// The device does not answer.
pub(super) const HD_COMM_ERROR: u32 = 0x0302;
/// The connection is not configured.
pub(super) const HD_COMM_CONFIG_ERROR: u32 = 0x0303;
/// The scheduler's timer failed.
pub(super) const HD_TIMER_ERROR: u32 = 0x0304;

/// Held buttons, a bit each.
pub(super) const HD_CURRENT_BUTTONS: u32 = 0x2000;
/// Position of the stylus, mm.
pub(super) const HD_CURRENT_POSITION: u32 = 0x2050;
/// Model, as text.
pub(super) const HD_DEVICE_MODEL_TYPE: u32 = 0x2501;
/// Vendor, as text.
pub(super) const HD_DEVICE_VENDOR: u32 = 0x2503;
/// Serial number, as text.
pub(super) const HD_DEVICE_SERIAL_NUMBER: u32 = 0x2504;
/// Ways of calibration, bits.
pub(super) const HD_CALIBRATION_STYLE: u32 = 0x2555;
/// Largest force, N.
pub(super) const HD_NOMINAL_MAX_FORCE: u32 = 0x2603;
/// Force that the device can hold permanently, N.
pub(super) const HD_NOMINAL_MAX_CONTINUOUS_FORCE: u32 = 0x2604;
/// Force on the stylus, N.
pub(super) const HD_CURRENT_FORCE: u32 = 0x2700;
/// Capability: forces at all.
pub(super) const HD_FORCE_OUTPUT: u32 = 0x4000;

/// The device is calibrated.
pub(super) const HD_CALIBRATION_OK: u32 = 0x5000;
/// The device can be calibrated now.
pub(super) const HD_CALIBRATION_NEEDS_UPDATE: u32 = 0x5001;
/// Somebody must put the stylus where it is calibrated.
pub(super) const HD_CALIBRATION_NEEDS_MANUAL_INPUT: u32 = 0x5002;
/// Calibration in a known pose.
pub(super) const HD_CALIBRATION_ENCODER_RESET: u32 = 1 << 0;
/// Calibration by itself.
pub(super) const HD_CALIBRATION_AUTO: u32 = 1 << 1;
/// Calibration in the inkwell.
pub(super) const HD_CALIBRATION_INKWELL: u32 = 1 << 2;

/// The callback is called again.
pub(super) const HD_CALLBACK_CONTINUE: u32 = 1;
/// The highest priority of a callback.
pub(super) const HD_MAX_SCHEDULER_PRIORITY: u16 = u16::MAX;
/// No device.
pub(super) const HD_INVALID_HANDLE: u32 = 0xFFFF_FFFF;
