//! Scan of the devices plugged in, and of this user's access to them.

use std::time::Duration;

use rusb::{Context, Device, DeviceHandle, UsbContext as _};

use super::absence::Absence;
use super::error::UsbError;
use super::ids::{DeviceKind, Ids};

/// Time for a device to tell its strings.
const PATIENCE: Duration = Duration::from_millis(200);

/// Access to a device.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Access {
    /// Usable.
    Ready,
    /// The system does not let this user in.
    NotPermitted,
    /// Another program or driver has it.
    InUse,
    /// Other error, in libusb's words.
    Failed(String),
    /// Not tried: not in the list of ids.
    Unknown,
}

/// A device that is plugged in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UsbDevice {
    /// Bus.
    pub bus: u8,
    /// Address on the bus; another one each time that it is plugged in.
    pub address: u8,
    /// Vendor id.
    pub vendor: u16,
    /// Product id.
    pub product: u16,
    /// Kind according to the list of ids.
    pub kind: Option<DeviceKind>,
    /// Name in the list of ids, or else its product string.
    pub name: String,
    /// Serial number, if reported.
    pub serial: Option<String>,
    /// Classes of its interfaces, as USB numbers them.
    pub interface_classes: Vec<u8>,
    /// Access for this user.
    pub access: Access,
}

impl UsbDevice {
    /// Name and place, for an error.
    #[must_use]
    pub fn place(&self) -> String {
        format!(
            "{} ({:04x}:{:04x}, {})",
            self.name,
            self.vendor,
            self.product,
            self.node()
        )
    }

    /// Its node on Linux, or bus and address.
    #[must_use]
    pub fn node(&self) -> String {
        if cfg!(target_os = "linux") {
            format!("/dev/bus/usb/{:03}/{:03}", self.bus, self.address)
        } else {
            format!("bus {} address {}", self.bus, self.address)
        }
    }

    /// Returns true if `which` names it: by serial number, by bus and address, or any for an empty name.
    #[must_use]
    pub fn is(&self, which: &str) -> bool {
        which.is_empty()
            || self.serial.as_deref() == Some(which)
            || which == format!("{}-{}", self.bus, self.address)
    }
}

/// Looks at a bus that changes meanwhile.
const TRIES: u32 = 5;

/// libusb, started.
///
/// # Errors
/// [`UsbError::NoUsb`].
pub(super) fn context() -> Result<Context, UsbError> {
    Ok(Context::new().map_err(Absence::here)?)
}

/// Everything that is plugged in. Devices of the list are opened for a moment to read their serial
/// number and to see whether they can be used; others are not touched.
///
/// # Errors
/// [`UsbError::NoUsb`].
pub fn scan(ids: &Ids) -> Result<Vec<UsbDevice>, UsbError> {
    let found = devices(ids)?;
    Ok(found.into_iter().map(|(found, _)| found).collect())
}

/// As [`scan`], with libusb's devices.
pub(crate) fn devices(ids: &Ids) -> Result<Vec<(UsbDevice, Device<Context>)>, UsbError> {
    // libusb fails as a whole while a device comes or goes; a moment later it does not.
    let mut tries = 0;
    let list = loop {
        let listed = context().and_then(|context| {
            let list = context.devices();
            Ok(list.map_err(Absence::here)?)
        });
        tries += 1;
        match listed {
            Err(_) if tries < TRIES => std::thread::sleep(PATIENCE / 4),
            listed => break listed?,
        }
    };
    let mut found: Vec<_> = list
        .iter()
        .filter_map(|device| Some((look(&device, ids)?, device)))
        .collect();
    found.sort_by_key(|(found, _)| (found.bus, found.address));
    Ok(found)
}

fn look(device: &Device<Context>, ids: &Ids) -> Option<UsbDevice> {
    let descriptor = device.device_descriptor().ok()?;
    let (vendor, product) = (descriptor.vendor_id(), descriptor.product_id());
    let known = ids.find(vendor, product);
    let mut found = UsbDevice {
        bus: device.bus_number(),
        address: device.address(),
        vendor,
        product,
        kind: known.map(|id| id.kind),
        name: known.map_or_else(|| "unknown device".into(), |id| id.name.clone()),
        serial: None,
        interface_classes: Vec::new(),
        access: Access::Unknown,
    };
    if let Ok(configuration) = device.active_config_descriptor() {
        let first =
            |interface: rusb::Interface<'_>| interface.descriptors().next().map(|d| d.class_code());
        found.interface_classes = configuration.interfaces().filter_map(first).collect();
    }
    if let Some(kind) = found.kind {
        match device.open() {
            Ok(handle) => {
                found.access = usable(&handle, kind);
                found.serial = serial(&handle, &descriptor);
            }
            Err(error) => found.access = access(error),
        }
    }
    Some(found)
}

/// Maps an error of libusb to an access.
pub(crate) fn access(error: rusb::Error) -> Access {
    match error {
        rusb::Error::Access => Access::NotPermitted,
        rusb::Error::Busy => Access::InUse,
        other => Access::Failed(other.to_string()),
    }
}

/// An error for a device that cannot be used.
///
/// # Errors
/// Always, but for [`Access::Ready`] and [`Access::Unknown`].
pub fn refuse(found: &UsbDevice, access: &Access) -> Result<(), UsbError> {
    let device = found.place();
    match access {
        Access::Ready | Access::Unknown => Ok(()),
        Access::NotPermitted => Err(UsbError::NotPermitted { device }),
        Access::InUse => Err(UsbError::InUse { device }),
        Access::Failed(problem) => Err(UsbError::Failed {
            device,
            problem: problem.clone(),
        }),
    }
}

/// A Falcon is claimed for a moment. A Touch is not: its own driver may be at work on it.
fn usable(handle: &DeviceHandle<Context>, kind: DeviceKind) -> Access {
    if kind == DeviceKind::Touch {
        return Access::Ready;
    }
    match handle.claim_interface(0) {
        Ok(()) => {
            let _ = handle.release_interface(0);
            Access::Ready
        }
        // A kernel driver is detached when the device is opened; a program is not.
        Err(rusb::Error::Busy) if handle.kernel_driver_active(0) == Ok(true) => Access::Ready,
        Err(error) => access(error),
    }
}

/// A device that does not tell its serial number is used without.
fn serial(handle: &DeviceHandle<Context>, descriptor: &rusb::DeviceDescriptor) -> Option<String> {
    let language = *handle.read_languages(PATIENCE).ok()?.first()?;
    handle
        .read_serial_number_string(language, descriptor, PATIENCE)
        .ok()
}
