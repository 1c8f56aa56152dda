//! Inventory of the devices that can be opened here, as text and as JSON.

use asperity_host::device::usb::scan::{Access, UsbDevice, refuse};
use asperity_host::device::usb::{DeviceKind, UsbError};
use asperity_host::device::vendor_library::LibraryError;
use asperity_host::device::{dhd, openhaptics};
use asperity_io::shown::{counted, plain};
use serde_json::{Value, json};

/// Devices that need neither USB nor a vendor's library.
const ANYWHERE: [&str; 3] = ["sim:", "null:", "replay:FILE"];

/// The devices and vendor libraries found on this machine.
pub(super) struct Inventory {
    /// USB devices, or why the bus cannot be scanned.
    pub(super) usb: Result<Vec<UsbDevice>, UsbError>,
    pub(super) libraries: Vec<VendorLibrary>,
    /// True if unsupported devices are listed too.
    pub(super) all: bool,
}

/// A vendor's library.
pub(super) struct VendorLibrary {
    product: &'static str,
    uri: &'static str,
    /// Its path, or why it cannot be used.
    found: Result<String, LibraryError>,
}

/// The vendors' libraries that there are.
pub(super) fn libraries() -> Vec<VendorLibrary> {
    vec![
        VendorLibrary {
            product: openhaptics::SOURCE.product,
            uri: "openhaptics:",
            found: openhaptics::installed(None),
        },
        VendorLibrary {
            product: dhd::SOURCE.product,
            uri: "dhd:",
            found: dhd::installed(None),
        },
    ]
}

impl VendorLibrary {
    fn state(&self) -> &'static str {
        match self.found {
            Ok(_) => "ready",
            Err(LibraryError::NotFound { .. }) => "not_installed",
            Err(_) => "unusable",
        }
    }

    fn line(&self) -> String {
        let Self { product, uri, .. } = self;
        match &self.found {
            Ok(path) => format!("{product}  {}\n  ready: {uri}\n", plain(path)),
            // The loader's words add nothing.
            Err(error @ LibraryError::NotFound { .. }) => {
                format!(
                    "{product}\n  not installed, but required by {uri}\n  help: {}\n",
                    error.remedy()
                )
            }
            Err(error) => format!(
                "{product}\n  {}\n  help: {}\n",
                plain(&error.to_string()),
                plain(&error.remedy())
            ),
        }
    }

    fn value(&self) -> Value {
        let mut value = json!({
            "product": self.product,
            "uri": self.uri,
            "state": self.state(),
            "path": self.found.as_ref().ok(),
        });
        if let Err(error) = &self.found {
            value["problem"] = error.to_string().into();
            value["remedy"] = error.remedy().into();
        }
        value
    }
}

impl Inventory {
    fn shown(&self) -> Vec<&UsbDevice> {
        let found = self.usb.iter().flatten();
        found
            .filter(|found| self.all || found.kind.is_some())
            .collect()
    }

    /// Problem and remedy where USB shows no device of ours.
    fn problem(&self) -> Option<(String, String)> {
        match &self.usb {
            Err(error) => Some((error.to_string(), error.remedy())),
            Ok(found) if found.iter().any(|found| found.kind.is_some()) => None,
            Ok(found) => Some((
                format!(
                    "no haptic device is plugged in ({} on USB)",
                    counted(found.len(), "other device", "other devices")
                ),
                "plug it in and switch its power on; `--all` lists every USB device, and if yours is \
                 listed under other ids, put these into a file for --ids"
                    .into(),
            )),
        }
    }

    pub(super) fn text(&self) -> String {
        let mut text = String::new();
        if let Some((problem, remedy)) = self.problem() {
            text += &format!("{problem}\n  help: {remedy}\n");
        }
        for found in self.shown() {
            text += &line(found);
        }
        for library in &self.libraries {
            text += &library.line();
        }
        text + &format!("Always available: {}\n", ANYWHERE.join(", "))
    }

    pub(super) fn value(&self) -> Value {
        let devices: Vec<Value> = self.shown().into_iter().map(value).collect();
        let libraries: Vec<Value> = self.libraries.iter().map(VendorLibrary::value).collect();
        let mut value = json!({
            "usb": self.usb.is_ok(),
            "devices": devices,
            "libraries": libraries,
            "anywhere": ANYWHERE,
        });
        if let Some((problem, remedy)) = self.problem() {
            value["problem"] = problem.into();
            value["remedy"] = remedy.into();
        }
        value
    }
}

/// The name to open a device by, if it can be opened over USB.
fn uri(found: &UsbDevice) -> Option<String> {
    let which = found.serial.clone();
    let which = which.unwrap_or_else(|| format!("{}-{}", found.bus, found.address));
    match found.kind? {
        DeviceKind::Falcon => Some(format!("falcon:{which}")),
        DeviceKind::Touch => Some(format!("touch:{which}")),
    }
}

fn state(found: &UsbDevice) -> (&'static str, String) {
    match (&found.access, found.kind) {
        (Access::Ready, Some(DeviceKind::Touch)) => (
            "identified",
            "identified only; to drive it, use its vendor's library: openhaptics:".into(),
        ),
        (Access::Ready, _) => (
            "ready",
            format!("ready: {}", uri(found).unwrap_or_default()),
        ),
        (Access::NotPermitted, _) => ("not_permitted", "this user may not open it".into()),
        (Access::InUse, _) => ("in_use", "in use by another program or driver".into()),
        (Access::Failed(problem), _) => ("failed", format!("cannot be opened: {problem}")),
        (Access::Unknown, _) => ("unknown", "not a known haptic device; not opened".into()),
    }
}

/// Formats the entry of a USB device.
fn line(found: &UsbDevice) -> String {
    // What a device says of itself is no part of our text.
    let serial = found.serial.as_deref().map(plain);
    let serial = serial.as_deref().unwrap_or("no serial number");
    let mut text = format!(
        "{}  {:04x}:{:04x}  {}  {}\n  {}\n",
        found.name,
        found.vendor,
        found.product,
        serial,
        found.node(),
        plain(&state(found).1)
    );
    if let Err(error) = refuse(found, &found.access) {
        text += &format!("  help: {}\n", error.remedy());
    }
    text
}

pub(super) fn value(found: &UsbDevice) -> Value {
    let mut value = json!({
        "name": found.name,
        "kind": found.kind,
        "vendor": format!("{:04x}", found.vendor),
        "product": format!("{:04x}", found.product),
        "serial": found.serial,
        "node": found.node(),
        "uri": uri(found),
        "state": state(found).0,
    });
    if let Err(error) = refuse(found, &found.access) {
        value["problem"] = error.to_string().into();
        value["remedy"] = error.remedy().into();
    }
    value
}

#[cfg(test)]
mod tests {
    use asperity_host::device::usb::Absence;

    use super::*;

    fn found(access: Access, kind: Option<DeviceKind>) -> UsbDevice {
        UsbDevice {
            bus: 1,
            address: 7,
            vendor: 0x0403,
            product: 0xcb48,
            kind,
            name: "Novint Falcon".into(),
            serial: Some("AB\u{1b}[31m12".into()),
            interface_classes: Vec::new(),
            access,
        }
    }

    fn missing() -> VendorLibrary {
        VendorLibrary {
            product: "OpenHaptics HD",
            uri: "openhaptics:",
            found: Err(LibraryError::NotFound {
                product: "OpenHaptics HD",
                names: "libHD.so".into(),
                variable: "ASPERITY_OPENHAPTICS",
                message: "no such file".into(),
            }),
        }
    }

    fn inventory(usb: Result<Vec<UsbDevice>, UsbError>) -> Inventory {
        Inventory {
            usb,
            libraries: vec![missing()],
            all: false,
        }
    }

    #[test]
    fn every_state_says_what_is_so_and_what_to_do() {
        let falcon = Some(DeviceKind::Falcon);
        let failed = Access::Failed("Input/Output Error".into());
        for (usb, state, words) in [
            (
                Err(UsbError::NoUsb(Absence::NoNodes)),
                None,
                [
                    "USB cannot be used here: there is no /dev/bus/usb",
                    "--device /dev/bus/usb",
                ],
            ),
            (
                Ok(vec![]),
                None,
                ["no haptic device is plugged in", "switch its power on"],
            ),
            (
                Ok(vec![found(Access::Unknown, None)]),
                None,
                ["(1 other device on USB)", "--ids"],
            ),
            (
                Ok(vec![found(Access::NotPermitted, falcon)]),
                Some("not_permitted"),
                ["this user may not open it", "help: "],
            ),
            (
                Ok(vec![found(Access::InUse, falcon)]),
                Some("in_use"),
                ["in use by another program", "lsof"],
            ),
            (
                Ok(vec![found(failed, falcon)]),
                Some("failed"),
                ["Input/Output Error", "plug the device out and in"],
            ),
            (
                Ok(vec![found(Access::Ready, falcon)]),
                Some("ready"),
                ["ready: falcon:", "AB"],
            ),
            (
                Ok(vec![found(Access::Ready, Some(DeviceKind::Touch))]),
                Some("identified"),
                ["its vendor's library", "openhaptics:"],
            ),
        ] {
            let works = usb.is_ok();
            let inventory = inventory(usb);
            let (text, value) = (inventory.text(), inventory.value());
            for word in words {
                assert!(text.contains(word), "{word} in {text}");
            }
            assert_eq!(value["usb"], works);
            assert_eq!(value["devices"][0]["state"].as_str(), state, "{value}");
            // The rest is listed whatever USB reports.
            for word in [
                "not installed, but required by openhaptics:",
                "ASPERITY_OPENHAPTICS",
                "sim:, null:",
            ] {
                assert!(text.contains(word), "{word} in {text}");
            }
            assert_eq!(value["libraries"][0]["state"], "not_installed");
            assert_eq!(value["anywhere"][0], "sim:");
            assert!(!text.contains('\u{1b}'), "{text:?}");
        }
    }

    #[test]
    fn what_is_none_of_ours_is_shown_on_request() {
        let mut inventory = inventory(Ok(vec![found(Access::Unknown, None)]));
        assert!(!inventory.text().contains("not a known haptic device"));
        inventory.all = true;
        assert!(
            inventory
                .text()
                .contains("not a known haptic device; not opened")
        );
        assert_eq!(inventory.value()["devices"][0]["state"], "unknown");
    }
}
