//! Haptic devices behind one trait.
//!
//! A device is opened outside the servo thread, where it may allocate, print and take its time.
//! Once a period the servo thread calls [`Device::read`] and [`Device::write`]. These two neither
//! allocate nor print, and they return within the period.

pub mod dhd;
mod error;
pub mod falcon;
pub mod fault_injection;
mod null;
mod open;
pub mod openhaptics;
pub mod replay;
pub mod supervised;
#[cfg(feature = "usb")]
pub mod touch;
mod uri;
#[cfg(feature = "usb")]
pub mod usb;
pub mod vendor_library;

pub use error::DeviceError;
pub use null::NullDevice;
pub use open::{OpenError, open};
pub use uri::{Scheme, Uri, UriError};

/// Reading of a device in one servo period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Stylus position in the world frame, m.
    pub position_m: [f32; 3],
    /// True if measured since the last reading.
    pub fresh: bool,
    /// Pressed buttons, a bit each, the first in bit 0.
    pub buttons: u32,
}

/// Properties of a device that the servo loop needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Name for reports, such as `Novint Falcon`.
    pub name: String,
    /// Serial number, if the device tells one.
    pub serial: Option<String>,
    /// Largest magnitude of the force, N.
    pub peak_force_n: f32,
    /// Magnitude that the device can hold permanently, N.
    pub continuous_force_n: f32,
    /// Properties not yet confirmed on hardware, a sentence each; empty for what runs in software.
    pub unconfirmed: Vec<String>,
}

/// A haptic device that is open.
///
/// Dropping a device releases it: its force goes to zero first.
pub trait Device: Send {
    /// Returns its properties.
    fn description(&self) -> &Description;

    /// The newest position. A device that has nothing new repeats the last reading with `fresh`
    /// false.
    ///
    /// # Errors
    /// [`DeviceError`] where nothing can be read in this period. The loop goes on, and asks again in the
    /// next one.
    fn read(&mut self) -> Result<Reading, DeviceError>;

    /// Commands a force in the world frame, N. It holds until the next.
    ///
    /// # Errors
    /// [`DeviceError`] where the command did not reach the device.
    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError>;

    /// Tries to recover a device whose last call failed. It is called outside the servo thread's
    /// periods while the force is zero, and may allocate and wait.
    ///
    /// # Errors
    /// [`DeviceError`] while the device is still away.
    fn recover(&mut self) -> Result<(), DeviceError> {
        Ok(())
    }
}

impl<D: Device + ?Sized> Device for &mut D {
    fn description(&self) -> &Description {
        (**self).description()
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        (**self).read()
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        (**self).write(force_n)
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        (**self).recover()
    }
}
