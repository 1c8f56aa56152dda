//! Force Dimension devices, and the Novint Falcon, through the vendor's library DHD (`libdhd.so`).
//!
//! `dhd:SERIAL?lib=PATH&peak=NEWTON` names a device by its serial number, and `dhd:` the first one.
//! The servo loop polls: each reading asks the device, and each force is sent at once.
//!
//! The device's frame has x toward the user, y to the right and z up, in m. In the world frame x
//! points to the right and y away from the user.
//!
//! No hardware has confirmed this back end. Its tests run against a library of our own that exports
//! the same functions.

mod constants;
#[cfg(test)]
mod interface;
mod library;

use self::constants as dhd;
use self::library::{Code, Dhd as Functions, Number};
use super::vendor_library::{Library, LibraryError, Source, VendorError};
use super::{Description, Device, DeviceError, Reading, Uri};

/// Search names of the library. The vendor's robotics library contains it.
pub const SOURCE: Source = Source {
    product: "Force Dimension SDK",
    variable: "ASPERITY_DHD",
    names: if cfg!(windows) {
        &["dhd64.dll", "drd64.dll"]
    } else if cfg!(target_os = "macos") {
        &["libdhd.dylib", "libdrd.dylib"]
    } else {
        &["libdhd.so", "libdhd.so.3", "libdrd.so", "libdrd.so.3"]
    },
};

/// Peak force where the URI names none, N. The library does not tell it, so it is a cautious one:
/// the weakest of the devices, the Falcon, is said to give 8 N and more.
const PEAK_N: f32 = 8.0;

/// Calibration instructions for the user.
const HOW: &str = "calibrate it as the vendor's manual says: move it to its resting place at \
                   start-up, or run the vendor's HapticInit; then try again";

/// Checks that the library can be used; returns its path, or the name by which the system found it.
/// `setting` is the value of `lib=`. The library is loaded briefly; no function of it is called.
///
/// # Errors
/// [`LibraryError`], with a remedy.
pub fn installed(setting: Option<&str>) -> Result<String, LibraryError> {
    let library = Library::load(&SOURCE, setting)?;
    let path = library.path().to_owned();
    Functions::find(library)?;
    Ok(path)
}

/// A device of the DHD. Dropping it sets the force to zero and closes the device.
#[derive(Debug)]
pub struct Dhd {
    description: Description,
    functions: Functions,
    serial: Option<u16>,
    /// `None` while the device is away.
    device: Option<Number>,
}

impl Dhd {
    /// Loads the library and opens the device of a URI.
    ///
    /// # Errors
    /// [`VendorError`], with what to do.
    pub fn open(uri: &Uri) -> Result<Self, VendorError> {
        uri.allow(&["lib", "peak"])?;
        let setting = |key, value: &str, rule| VendorError::Setting {
            scheme: "dhd",
            key,
            value: value.into(),
            rule,
        };
        let serial = match uri.which.as_str() {
            "" => None,
            text => Some(
                text.parse::<u16>()
                    .map_err(|_| setting("serial", text, "a serial number, 0 to 65535"))?,
            ),
        };
        let peak_n = uri.setting("peak").map(|text| {
            let peak = text
                .parse::<f32>()
                .ok()
                .filter(|peak| *peak > 0.0 && *peak <= 40.0);
            peak.ok_or_else(|| setting("peak", text, "a force above 0, at most 40 N"))
        });
        let peak_n = peak_n.transpose()?;
        let functions = Functions::find(Library::load(&SOURCE, uri.setting("lib"))?)?;
        let device = start(&functions, serial)?;
        Ok(Self {
            description: describe(&functions, device, peak_n),
            functions,
            serial,
            device: Some(device),
        })
    }

    fn device(&self) -> Result<Number, DeviceError> {
        self.device.ok_or(DeviceError::Disconnected)
    }

    /// The fault of an error. A lost connection closes the device.
    fn failed(&mut self, code: Code) -> DeviceError {
        let fault = fault(code);
        if fault == DeviceError::Disconnected {
            self.release();
        }
        fault
    }

    /// Sets the force to zero, and closes the device.
    fn release(&mut self) {
        if let Some(device) = self.device.take() {
            // Each is tried, whatever became of the others.
            let _ = self.functions.set_force(device, [0.0; 3]);
            let _ = self.functions.enable_force(device, false);
            let _ = self.functions.close(device);
        }
    }
}

/// Maps an error code within a period to a device error.
fn fault(Code(code): Code) -> DeviceError {
    match code {
        dhd::ERROR_COM | dhd::ERROR_NO_DEVICE_FOUND | dhd::ERROR_NO_DRIVER_FOUND => {
            DeviceError::Disconnected
        }
        dhd::ERROR_TIMEOUT | dhd::ERROR_DHC_BUSY => DeviceError::TimedOut,
        dhd::ERROR_DEVICE_NOT_READY => DeviceError::NotCalibrated,
        other => DeviceError::Vendor(other),
    }
}

fn to_world([x, y, z]: [f64; 3]) -> [f32; 3] {
    [y as f32, -x as f32, z as f32]
}

fn to_device([x, y, z]: [f32; 3]) -> [f64; 3] {
    [-y, x, z].map(f64::from)
}

/// Opens a device, checks that it is calibrated, and turns forces on.
fn start(functions: &Functions, serial: Option<u16>) -> Result<Number, VendorError> {
    let shown = serial.map_or("the first Force Dimension device".into(), |serial| {
        format!("Force Dimension device {serial}")
    });
    let refuse = |doing, code: Code| {
        let (device, message) = (shown.clone(), functions.message(code));
        let code = code.0;
        match code {
            dhd::ERROR_DEVICE_IN_USE => VendorError::InUse { device },
            dhd::ERROR_NO_DEVICE_FOUND | dhd::ERROR_NO_DRIVER_FOUND | dhd::ERROR_COM => {
                VendorError::NoDevice {
                    device,
                    message,
                    code,
                }
            }
            dhd::ERROR_CONFIGURATION => VendorError::Configuration {
                device,
                message,
                code,
            },
            dhd::ERROR_DEVICE_NOT_READY => VendorError::NotCalibrated { device, how: HOW },
            _ => VendorError::Refused {
                device,
                doing,
                message,
                code,
            },
        }
    };
    let device = functions
        .open(serial)
        .map_err(|code| refuse("opening", code))?;
    let started = (|| {
        let status = functions
            .status(device)
            .map_err(|code| refuse("reading its status", code))?;
        if status[dhd::STATUS_RESET] == 0 {
            return Err(VendorError::NotCalibrated {
                device: shown.clone(),
                how: HOW,
            });
        }
        functions
            .enable_force(device, true)
            .and_then(|()| functions.set_force(device, [0.0; 3]))
            .map_err(|code| refuse("turning its forces on", code))?;
        Ok(device)
    })();
    if started.is_err() {
        // The error that is reported is the first one.
        let _ = functions.enable_force(device, false);
        let _ = functions.close(device);
    }
    started
}

fn describe(functions: &Functions, device: Number, peak_n: Option<f32>) -> Description {
    let mut unconfirmed = vec!["This back end has run with no real device yet.".to_owned()];
    if peak_n.is_none() {
        unconfirmed.push(format!(
            "The library tells no peak force; {PEAK_N} N is assumed, and peak= in the URI sets another."
        ));
    }
    unconfirmed
        .push("The library tells no continuous force; a quarter of the peak is assumed.".into());
    let peak_force_n = peak_n.unwrap_or(PEAK_N);
    let name = functions.name(device).filter(|name| !name.is_empty());
    Description {
        name: name.map_or("Force Dimension device".into(), |name| {
            format!("Force Dimension {name}")
        }),
        serial: functions.serial(device).map(|serial| serial.to_string()),
        peak_force_n,
        continuous_force_n: 0.25 * peak_force_n,
        unconfirmed,
    }
}

impl Device for Dhd {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        let device = self.device()?;
        let (position_m, fresh) = self
            .functions
            .position(device)
            .map_err(|code| self.failed(code))?;
        Ok(Reading {
            position_m: to_world(position_m),
            fresh,
            buttons: self.functions.buttons(device),
        })
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        let device = self.device()?;
        // The runtime gives no such force. Nobody else's may reach an arm.
        let finite = force_n.iter().all(|x| x.is_finite());
        let force_n = if finite { force_n } else { [0.0; 3] };
        let sent = self.functions.set_force(device, to_device(force_n));
        sent.map_err(|code| {
            let failed = self.failed(code);
            let status = self.device.map(|device| self.functions.status(device));
            match status {
                Some(Ok(status))
                    if status[dhd::STATUS_FORCE] == 0
                        && status[dhd::STATUS_FORCEOFFCAUSE] == dhd::FORCE_OFF_VELOCITY =>
                {
                    DeviceError::ForceExceeded
                }
                Some(Ok(status)) if status[dhd::STATUS_ERROR] != 0 => DeviceError::Vendor(code.0),
                _ => failed,
            }
        })
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        if let Some(device) = self.device {
            let on = self.functions.enable_force(device, true);
            return on.map_err(|code| self.failed(code));
        }
        let started = start(&self.functions, self.serial);
        self.device = Some(started.map_err(|error| match error {
            VendorError::NotCalibrated { .. } => DeviceError::NotCalibrated,
            _ => DeviceError::Disconnected,
        })?);
        Ok(())
    }
}

impl Drop for Dhd {
    fn drop(&mut self) {
        self.release();
    }
}
