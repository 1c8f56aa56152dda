//! Devices on USB: which there are, whether they can be used, and what to do if not.
//!
//! | file | holds |
//! |---|---|
//! | [`ids`] | which ids are which device |
//! | [`scan`] | what is plugged in, and whether this user may use it |
//! | [`permission`] | the udev rule that lets a user in |
//! | [`absence`] | why USB as a whole cannot be used |
//! | [`error`] | what can be missing, with its remedy |
//!
//! libusb is built from source unless the feature `libusb-from-source` is off. It is under the
//! LGPL 2.1; who distributes a program with libusb inside must let its users replace it.

pub mod absence;
pub mod error;
pub mod ids;
pub mod permission;
pub mod scan;

pub use absence::Absence;
pub use error::UsbError;
pub use ids::{DeviceKind, Ids};
pub use scan::{Access, UsbDevice};
