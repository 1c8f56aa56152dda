//! A Falcon on USB.
//!
//! libusb's blocking transfers allocate and take locks. They run on the link's own threads, never
//! on the servo thread.

use std::sync::Arc;
use std::time::Duration;

use rusb::{Context, DeviceHandle};

use super::Falcon;
use super::ftdi::{ENDPOINT_IN, ENDPOINT_OUT, REQUEST_TYPE};
use super::open::{OpenError, Opened, Opener};
use super::settings::Settings;
use super::transport::{Direction, TransferError, Transport};
use crate::device::Uri;
use crate::device::usb::error::UsbError;
use crate::device::usb::ids::{DeviceKind, Ids};
use crate::device::usb::scan::{UsbDevice, access, devices, refuse};

/// Time of a control request.
const PATIENCE: Duration = Duration::from_secs(1);

/// Finds a Falcon on USB.
#[derive(Debug, Clone)]
pub struct UsbOpener {
    ids: Ids,
    which: String,
}

impl UsbOpener {
    /// Creates an opener for `settings`.
    ///
    /// # Errors
    /// [`UsbError::Ids`] for a wrong list of ids.
    pub fn new(settings: &Settings) -> Result<Self, UsbError> {
        Ok(Self {
            ids: Ids::load(settings.ids.as_deref())?,
            which: settings.which.clone(),
        })
    }
}

/// Opens the Falcon of a name such as `falcon:?firmware=FILE`.
///
/// # Errors
/// [`OpenError`] with what is missing and what to do.
pub fn open(uri: &Uri) -> Result<Falcon, OpenError> {
    let settings = Settings::of(uri)?;
    let opener = UsbOpener::new(&settings)?;
    Falcon::open(Box::new(opener), settings)
}

impl Opener for UsbOpener {
    fn open(&mut self) -> Result<Opened, OpenError> {
        // A context of its own each time: a device that came back is certainly seen.
        let mut all = devices(&self.ids)?.into_iter();
        let ours = |(found, _): &(UsbDevice, _)| {
            found.kind == Some(DeviceKind::Falcon) && found.is(&self.which)
        };
        let (found, device) = all.find(ours).ok_or_else(|| UsbError::NotFound {
            what: "Novint Falcon",
            which: self.which.clone(),
        })?;
        refuse(&found, &found.access)?;
        let claim = || {
            let handle = device.open()?;
            // Not every system can detach a driver; where it cannot, the claim says so.
            let _ = handle.set_auto_detach_kernel_driver(true);
            handle.claim_interface(0)?;
            Ok(handle)
        };
        match claim() {
            Ok(handle) => Ok(Opened {
                transport: Arc::new(Claimed { handle }),
                serial: found.serial,
            }),
            Err(error) => {
                refuse(&found, &access(error))?;
                Err(UsbError::Failed {
                    device: found.place(),
                    problem: "unknown".into(),
                }
                .into())
            }
        }
    }
}

struct Claimed {
    handle: DeviceHandle<Context>,
}

fn transfer_error(error: rusb::Error) -> TransferError {
    match error {
        rusb::Error::Timeout => TransferError::TimedOut,
        rusb::Error::Pipe => TransferError::Stalled,
        rusb::Error::NoDevice | rusb::Error::NotFound => TransferError::Disconnected,
        _ => TransferError::Failed,
    }
}

impl Transport for Claimed {
    fn control(&self, request: u8, value: u16, index: u16) -> Result<(), TransferError> {
        let sent = self
            .handle
            .write_control(REQUEST_TYPE, request, value, index, &[], PATIENCE);
        sent.map(drop).map_err(transfer_error)
    }

    fn send(&self, bytes: &[u8], patience: Duration) -> Result<usize, TransferError> {
        let sent = self.handle.write_bulk(ENDPOINT_OUT, bytes, patience);
        sent.map_err(transfer_error)
    }

    fn receive(&self, packet: &mut [u8], patience: Duration) -> Result<usize, TransferError> {
        let got = self.handle.read_bulk(ENDPOINT_IN, packet, patience);
        got.map_err(transfer_error)
    }

    fn clear_stall(&self, direction: Direction) -> Result<(), TransferError> {
        let endpoint = match direction {
            Direction::In => ENDPOINT_IN,
            Direction::Out => ENDPOINT_OUT,
        };
        self.handle.clear_halt(endpoint).map_err(transfer_error)
    }
}

impl Drop for Claimed {
    fn drop(&mut self) {
        // A device that is gone cannot be released.
        let _ = self.handle.release_interface(0);
    }
}
