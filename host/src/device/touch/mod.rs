//! A 3D Systems Touch on USB: what can be said of it without its vendor's library.
//!
//! Its payload is proprietary. Only fragments are public, none verified, and a guessed frame could
//! move a powered arm. So nothing is ever sent to it but the requests that every USB device
//! answers: descriptors and strings. Forces go through the vendor's library, `openhaptics:`.

use super::usb::error::UsbError;
use super::usb::ids::{DeviceKind, Ids};
use super::usb::scan::{UsbDevice, refuse, scan};

/// Classes of interfaces, as USB numbers them.
const SERIAL: [u8; 2] = [0x02, 0x0a];
const HID: u8 = 0x03;

/// USB presentation of a Touch's firmware.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UsbPresentation {
    /// Serial line (CDC-ACM), `/dev/ttyACM…` on Linux.
    Serial,
    /// Human interface device, `/dev/hidraw…` on Linux: newer firmware.
    Hid,
    /// Any other, or unreadable descriptors.
    Other,
}

impl UsbPresentation {
    /// From the classes of a device's interfaces.
    #[must_use]
    pub fn of(found: &UsbDevice) -> Self {
        let has = |class: &u8| found.interface_classes.contains(class);
        if has(&HID) {
            Self::Hid
        } else if SERIAL.iter().any(has) {
            Self::Serial
        } else {
            Self::Other
        }
    }

    /// In a sentence.
    #[must_use]
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::Serial => "It presents itself as a serial line (CDC-ACM).",
            Self::Hid => {
                "It presents itself as a HID: newer firmware, which older drivers do not find."
            }
            Self::Other => "Its interfaces are of no class that was seen in public.",
        }
    }
}

/// The Touch that `which` names: by serial number, by bus and address, or the first.
///
/// # Errors
/// [`UsbError`] if there is none, or this user may not open it.
pub fn identify(ids: &Ids, which: &str) -> Result<UsbDevice, UsbError> {
    let mut all = scan(ids)?.into_iter();
    let ours = |found: &UsbDevice| found.kind == Some(DeviceKind::Touch) && found.is(which);
    let found = all.find(ours).ok_or_else(|| UsbError::NotFound {
        what: "3D Systems Touch",
        which: which.to_owned(),
    })?;
    refuse(&found, &found.access)?;
    Ok(found)
}

/// Why a Touch is not opened over USB.
///
/// # Errors
/// Always: [`UsbError::Proprietary`] for a Touch that is there, else what [`identify`] says.
pub fn open(ids: &Ids, which: &str) -> Result<std::convert::Infallible, UsbError> {
    let found = identify(ids, which)?;
    Err(UsbError::Proprietary {
        device: found.place(),
    })
}
