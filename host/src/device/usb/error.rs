//! Why USB does not give a device, in words.

use thiserror::Error;

use super::absence::Absence;
use super::ids::IdsError;
use super::permission;

/// Why USB does not give a device.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum UsbError {
    /// The list of ids is wrong.
    #[error(transparent)]
    Ids(#[from] IdsError),
    /// libusb does not start.
    #[error("USB cannot be used here: {0}")]
    NoUsb(#[from] Absence),
    /// Nothing with these ids is plugged in.
    #[error("no {what} is plugged in{}", named(which))]
    NotFound {
        /// Kind of device sought.
        what: &'static str,
        /// Serial number or place, if given.
        which: String,
    },
    /// The system does not let this user in.
    #[error("{device} is there, but this user may not open it")]
    NotPermitted {
        /// The device, with its place.
        device: String,
    },
    /// Another program has it.
    #[error("{device} is in use by another program or driver")]
    InUse {
        /// The device, with its place.
        device: String,
    },
    /// It went away, or failed otherwise.
    #[error("{device} cannot be opened: {problem}")]
    Failed {
        /// The device, with its place.
        device: String,
        /// Message of libusb.
        problem: String,
    },
    /// A known device whose protocol is not public.
    #[error("{device} is there, but its protocol is not public")]
    Proprietary {
        /// The device, with its place.
        device: String,
    },
}

fn named(which: &str) -> String {
    if which.is_empty() {
        String::new()
    } else {
        format!(" with the serial number or place `{which}`")
    }
}

impl UsbError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Ids(error) => error.remedy(),
            Self::NoUsb(absence) => absence.remedy().into(),
            Self::NotFound { .. } => {
                "plug it in, switch its power on, and see `asperity-lab device list --all`; if it is \
                 there under other ids, put them into a list for --ids"
                    .into()
            }
            Self::NotPermitted { .. } => permission::remedy(),
            Self::InUse { .. } => {
                "end the other program; `lsof` with the device's node says which it is".into()
            }
            Self::Failed { .. } => "plug the device out and in, then try again".into(),
            Self::Proprietary { .. } => {
                "install the vendor's OpenHaptics and its driver, and use `openhaptics:`".into()
            }
        }
    }
}
