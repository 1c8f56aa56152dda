//! 3D Systems devices through the vendor's library OpenHaptics HD (`libHD.so`).
//!
//! `openhaptics:NAME?lib=PATH` names a device by the name that the vendor's set-up program gave it,
//! and `openhaptics:` the default one. The library's scheduler calls back in a thread of its own,
//! 1,000 times a second. That thread and the servo loop exchange their newest values without
//! waiting. Their clocks differ a little, so now and then a reading is not fresh, or one is skipped.
//!
//! The device's frame has x to the right, y up and z toward the user, in mm. In the world frame y
//! points away from the user and z up, in m.
//!
//! No hardware has confirmed this back end. Its tests run against a library of our own that exports
//! the same functions.

mod constants;
#[cfg(test)]
mod interface;
mod library;
mod scheduled;
mod scheduled_device;
mod snapshot;

use std::ffi::CString;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};

use self::constants as hd;
use self::library::Hd;
use self::scheduled_device::{ScheduledDevice, fault};
use super::vendor_library::{Library, LibraryError, Source, VendorError};
use super::{Description, Device, DeviceError, Reading, Uri};

/// Search names of the library.
pub const SOURCE: Source = Source {
    product: "OpenHaptics HD",
    variable: "ASPERITY_OPENHAPTICS",
    names: if cfg!(windows) {
        &["HD.dll"]
    } else {
        &["libHD.so", "libHD.so.3.4", "libHD.so.3"]
    },
};

/// Readings in a row without a new measurement after which the scheduler counts as dead.
const QUIET: u32 = 3;

/// The library keeps its state in global variables, so a process has one session.
static IN_USE: AtomicBool = AtomicBool::new(false);

/// Gives the library back to the process when it is dropped.
#[derive(Debug)]
struct Claim;

impl Claim {
    fn make() -> Option<Self> {
        (!IN_USE.swap(true, SeqCst)).then_some(Self)
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        IN_USE.store(false, SeqCst);
    }
}

/// Checks that the library can be used; returns its path, or the name by which the system found it.
/// `setting` is the value of `lib=`. The library is loaded briefly; no function of it is called.
///
/// # Errors
/// [`LibraryError`], with a remedy.
pub fn installed(setting: Option<&str>) -> Result<String, LibraryError> {
    let library = Library::load(&SOURCE, setting)?;
    let path = library.path().to_owned();
    Hd::find(library)?;
    Ok(path)
}

/// A device of OpenHaptics HD. Dropping it takes the force to zero by small steps, stops the
/// scheduler and releases the device.
#[derive(Debug)]
pub struct OpenHaptics {
    description: Description,
    name: Option<CString>,
    hd: Arc<Hd>,
    /// `None` while the device is away.
    session: Option<ScheduledDevice>,
    last: Reading,
    last_number: u32,
    quiet: u32,
    lost: bool,
    // Dropped last.
    _claim: Claim,
}

impl OpenHaptics {
    /// Loads the library and opens the device of a URI.
    ///
    /// # Errors
    /// [`VendorError`], with what to do.
    pub fn open(uri: &Uri) -> Result<Self, VendorError> {
        uri.allow(&["lib"])?;
        let name = match uri.which.as_str() {
            "" => None,
            name => Some(CString::new(name).map_err(|_| VendorError::Setting {
                scheme: "openhaptics",
                key: "name",
                value: name.into(),
                rule: "a name without a zero byte",
            })?),
        };
        let claim = Claim::make().ok_or_else(|| VendorError::InUse {
            device: "OpenHaptics HD, which serves one session a process,".into(),
        })?;
        let library = Library::load(&SOURCE, uri.setting("lib"))?;
        let hd = Arc::new(Hd::find(library)?);
        let session = ScheduledDevice::open(&hd, name.as_ref())?;
        Ok(Self {
            description: describe(&hd),
            name,
            hd,
            session: Some(session),
            last: Reading {
                position_m: [0.0; 3],
                fresh: false,
                buttons: 0,
            },
            last_number: 0,
            quiet: 0,
            lost: false,
            _claim: claim,
        })
    }
}

/// The world frame, from the device's.
fn to_world([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, -z, y]
}

/// The device's frame, from the world's.
fn to_device([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y]
}

fn describe(hd: &Hd) -> Description {
    let text = |parameter| hd.string(parameter).filter(|text| !text.is_empty());
    let words = [text(hd::HD_DEVICE_VENDOR), text(hd::HD_DEVICE_MODEL_TYPE)];
    let name = words.into_iter().flatten().collect::<Vec<_>>().join(" ");
    let positive =
        |parameter| Some(hd.double(parameter) as f32).filter(|x| x.is_finite() && *x > 0.0);
    let peak = positive(hd::HD_NOMINAL_MAX_FORCE);
    let continuous = positive(hd::HD_NOMINAL_MAX_CONTINUOUS_FORCE);
    let mut unconfirmed = vec!["This back end has run with no real device yet.".to_owned()];
    if peak.is_none() {
        unconfirmed.push("The library tells no peak force; 3.3 N is assumed.".into());
    }
    if continuous.is_none() {
        unconfirmed.push("The library tells no continuous force; 0.88 N is assumed.".into());
    }
    // A device may not know one of these parameters.
    hd.error();
    Description {
        name: if name.is_empty() {
            "OpenHaptics device".into()
        } else {
            name
        },
        serial: text(hd::HD_DEVICE_SERIAL_NUMBER),
        peak_force_n: peak.unwrap_or(3.3),
        continuous_force_n: continuous.unwrap_or(0.88),
        unconfirmed,
    }
}

impl Device for OpenHaptics {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        let Some(session) = self.session.as_ref().filter(|_| !self.lost) else {
            return Err(DeviceError::Disconnected);
        };
        if let Some(code) = session.scheduled.take_fault() {
            let fault = fault(code);
            self.lost = fault == DeviceError::Disconnected;
            return Err(fault);
        }
        let newest = session.scheduled.newest();
        match newest.filter(|newest| newest.number != self.last_number) {
            Some(newest) => {
                self.quiet = 0;
                self.last_number = newest.number;
                self.last = Reading {
                    position_m: to_world(newest.position_m),
                    fresh: true,
                    buttons: newest.buttons,
                };
                Ok(self.last)
            }
            None => {
                self.quiet = self.quiet.saturating_add(1);
                if self.quiet > QUIET {
                    return Err(DeviceError::TimedOut);
                }
                Ok(Reading {
                    fresh: false,
                    ..self.last
                })
            }
        }
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        let session = self.session.as_ref().filter(|_| !self.lost);
        let session = session.ok_or(DeviceError::Disconnected)?;
        session.scheduled.command(to_device(force_n));
        Ok(())
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        if self.lost || self.session.is_none() || self.quiet > QUIET {
            // The old session ends before a new one begins.
            self.session = None;
            let opened = ScheduledDevice::open(&self.hd, self.name.as_ref());
            self.session = Some(opened.map_err(|error| match error {
                VendorError::NotCalibrated { .. } => DeviceError::NotCalibrated,
                VendorError::WarmMotors { .. } => DeviceError::WarmMotors,
                _ => DeviceError::Disconnected,
            })?);
            self.last_number = 0;
            (self.quiet, self.lost) = (0, false);
        } else {
            // A force error takes the capability away.
            self.hd.enable_force();
        }
        Ok(())
    }
}
