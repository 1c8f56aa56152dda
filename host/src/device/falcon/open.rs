//! Opening a Falcon: where it is found, and what may be missing.

use std::sync::Arc;

use thiserror::Error;

use super::firmware::FirmwareError;
use super::settings::SettingsError;
use super::transport::{TransferError, Transport};
use crate::device::DeviceError;
#[cfg(feature = "usb")]
use crate::device::usb::error::UsbError;

/// A device that was found and claimed.
pub struct Opened {
    /// Carries bytes to it.
    pub transport: Arc<dyn Transport>,
    /// Serial number, if it tells one.
    pub serial: Option<String>,
}

/// Finds a Falcon, at first and again after it was lost.
pub trait Opener: Send {
    /// Finds and claims it.
    ///
    /// # Errors
    /// [`OpenError`].
    fn open(&mut self) -> Result<Opened, OpenError>;
}

impl<F: FnMut() -> Result<Opened, OpenError> + Send> Opener for F {
    fn open(&mut self) -> Result<Opened, OpenError> {
        self()
    }
}

/// Why a Falcon cannot be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenError {
    /// The name says something that is not so.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// USB does not give it.
    #[cfg(feature = "usb")]
    #[error(transparent)]
    Usb(#[from] UsbError),
    /// It is a device of another kind of transport, and that is gone.
    #[error("{0}")]
    Transport(#[from] TransferError),
    /// It has no firmware, and no file was named.
    #[error("the Falcon has no firmware: it loses it when its power goes")]
    NoFirmware,
    /// The firmware did not get in, or does not run.
    #[error("{0}")]
    Firmware(#[from] FirmwareError),
    /// The system gives no thread.
    #[error("no thread for the device: {0}")]
    Thread(std::io::Error),
}

impl OpenError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Settings(error) => error.remedy(),
            #[cfg(feature = "usb")]
            Self::Usb(error) => error.remedy(),
            Self::Transport(_) => "plug the device in again".into(),
            Self::NoFirmware => {
                "name the firmware's file: `falcon:?firmware=FILE`; docs/devices.md says where one \
                 comes from"
                    .into()
            }
            Self::Firmware(error) => error.remedy().into(),
            Self::Thread(_) => "end other programs, or raise `ulimit -u`".into(),
        }
    }

    /// The fault that the servo loop receives.
    #[must_use]
    pub fn fault(&self) -> DeviceError {
        match self {
            Self::Firmware(FirmwareError::Transfer(TransferError::TimedOut))
            | Self::Transport(TransferError::TimedOut) => DeviceError::TimedOut,
            Self::Firmware(FirmwareError::Transfer(TransferError::Stalled)) => DeviceError::Stalled,
            Self::NoFirmware | Self::Firmware(_) => DeviceError::NotCalibrated,
            _ => DeviceError::Disconnected,
        }
    }
}
