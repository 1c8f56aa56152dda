//! Why USB as a whole cannot be used: libusb says no more than "Other error" for most reasons.

use std::io::ErrorKind;
use std::path::Path;

use thiserror::Error;

/// Where Linux shows its USB devices.
const NODES: &str = "/dev/bus/usb";

/// Why libusb does not start.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Absence {
    /// The system shows no USB at all.
    #[error("there is no {NODES}")]
    NoNodes,
    /// The folder of devices is there, and no bus in it.
    #[error("{NODES} is empty: there is no USB bus")]
    NoBus,
    /// The folder of devices cannot be read.
    #[error("this user may not read {NODES}")]
    NotPermitted,
    /// The devices are there, and libusb fails nonetheless.
    #[error("libusb does not start ({0})")]
    Libusb(String),
}

impl Absence {
    /// Diagnoses the system after libusb failed with `error`.
    pub(super) fn here(error: rusb::Error) -> Self {
        let nodes = if cfg!(target_os = "linux") {
            Self::of(Path::new(NODES))
        } else {
            None
        };
        nodes.unwrap_or_else(|| Self::Libusb(error.to_string()))
    }

    /// Diagnoses a folder of devices; `None` if it is fine.
    fn of(nodes: &Path) -> Option<Self> {
        match nodes.read_dir().map(|mut buses| buses.next().is_none()) {
            Ok(true) => Some(Self::NoBus),
            Ok(false) => None,
            Err(error) => Self::unreadable(error.kind()),
        }
    }

    fn unreadable(kind: ErrorKind) -> Option<Self> {
        match kind {
            ErrorKind::NotFound => Some(Self::NoNodes),
            ErrorKind::PermissionDenied => Some(Self::NotPermitted),
            _ => None,
        }
    }

    /// Returns a remedy for the user.
    pub(super) fn remedy(&self) -> &'static str {
        match self {
            Self::NoNodes | Self::NoBus => {
                "start a container with `--device /dev/bus/usb`, or give a virtual machine a USB \
                 controller and the device; on a machine of its own, see whether `lsusb` lists \
                 anything and the firmware's set-up has USB switched on. `sim:` needs no USB"
            }
            Self::NotPermitted => {
                "see `ls -ld /dev/bus/usb`: everybody must be able to read it \
                 (`sudo chmod 755 /dev/bus/usb`); in a container or sandbox, permit /dev/bus/usb. \
                 `sim:` needs no USB"
            }
            Self::Libusb(_) => {
                "`LIBUSB_DEBUG=4 asperity-lab device list` says what libusb tried; it needs netlink \
                 sockets, /sys/bus/usb and /dev/bus/usb, which a sandbox may forbid. `sim:` needs no \
                 USB"
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_folder_of_devices_lacks_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let nodes = folder.path().join("usb");
        assert_eq!(Absence::of(&nodes), Some(Absence::NoNodes));
        std::fs::create_dir(&nodes).expect("a folder");
        assert_eq!(Absence::of(&nodes), Some(Absence::NoBus));
        std::fs::create_dir(nodes.join("001")).expect("a folder");
        assert_eq!(Absence::of(&nodes), None);
        // A test that runs as root may read every folder.
        assert_eq!(
            Absence::unreadable(ErrorKind::PermissionDenied),
            Some(Absence::NotPermitted)
        );
    }

    #[test]
    fn every_reason_has_words_of_its_own_and_a_remedy() {
        let reasons = [
            (Absence::NoNodes, "there is no /dev/bus/usb", "--device"),
            (Absence::NoBus, "is empty", "controller"),
            (Absence::NotPermitted, "may not read", "ls -ld"),
            (
                Absence::Libusb("Other error".into()),
                "does not start",
                "LIBUSB_DEBUG=4",
            ),
        ];
        for (reason, words, remedy) in reasons {
            assert!(reason.to_string().contains(words), "{reason}");
            assert!(reason.remedy().contains(remedy), "{}", reason.remedy());
            assert!(reason.remedy().contains("/dev/bus/usb") && reason.remedy().contains("`sim:`"));
        }
    }
}
