//! Why a vendor's device cannot be opened, and what to do about it.

use thiserror::Error;

use crate::device::UriError;

/// Why a vendor's library cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum LibraryError {
    /// It is not where the system looks.
    #[error("{product} is not installed: the system finds none of {names} ({message})")]
    NotFound {
        /// The vendor's product.
        product: &'static str,
        /// The names that were tried.
        names: String,
        /// Environment variable that may hold a path.
        variable: &'static str,
        /// Message of the system's loader.
        message: String,
    },
    /// The named file does not exist, or cannot be read.
    #[error("library of {product} {path}: {message}")]
    NoFile {
        /// The vendor's product.
        product: &'static str,
        /// The file.
        path: String,
        /// Message of the system.
        message: String,
    },
    /// The named file is no shared library.
    #[error("library of {product} {path}: this file is no shared library")]
    NotALibrary {
        /// The vendor's product.
        product: &'static str,
        /// The file.
        path: String,
    },
    /// It was built for another machine.
    #[error(
        "library of {product} {path}: it was built for {built_for}, and this program for {here}"
    )]
    Architecture {
        /// The vendor's product.
        product: &'static str,
        /// The file.
        path: String,
        /// Its machine.
        built_for: String,
        /// The machine of this program.
        here: &'static str,
    },
    /// The system's loader refused it, most often because it needs another library.
    #[error("library of {product} {path}: {message}")]
    Load {
        /// The vendor's product.
        product: &'static str,
        /// The file.
        path: String,
        /// Message of the system's loader.
        message: String,
    },
    /// It lacks a function.
    #[error("library of {product} {path}: it has no function {symbol}")]
    Symbol {
        /// The vendor's product.
        product: &'static str,
        /// The file, or the name that the system found.
        path: String,
        /// The function.
        symbol: &'static str,
    },
}

impl LibraryError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::NotFound {
                product, variable, ..
            } => format!(
                "install {product} from its vendor, or name the file: `lib=PATH` in the URI, or \
                 {variable}=PATH in the environment"
            ),
            Self::NoFile { .. } => "check the path, and that you may read the file".into(),
            Self::NotALibrary { product, .. } => {
                format!("name the shared library of {product} itself, no archive and no script")
            }
            Self::Architecture { product, here, .. } => {
                format!(
                    "install the {product} for {here}, or use a machine that its vendor supports"
                )
            }
            Self::Load { path, .. } => {
                format!("install the library that is missing; `ldd {path}` lists them all")
            }
            Self::Symbol { product, .. } => format!(
                "install a newer {product}; docs/vendor.md lists the functions that are needed"
            ),
        }
    }
}

/// Why a vendor's device cannot be opened.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum VendorError {
    /// The library cannot be used.
    #[error(transparent)]
    Library(#[from] LibraryError),
    /// A setting that this kind of device does not have.
    #[error(transparent)]
    Uri(#[from] UriError),
    /// A setting whose value makes no sense.
    #[error("{scheme}: setting {key}={value}: {rule}")]
    Setting {
        /// Scheme, before the colon.
        scheme: &'static str,
        /// The setting.
        key: &'static str,
        /// Its value.
        value: String,
        /// The rule that it breaks.
        rule: &'static str,
    },
    /// The device is open already.
    #[error("{device} is in use")]
    InUse {
        /// The device.
        device: String,
    },
    /// The library found no such device, or the device did not answer.
    #[error("{device} cannot be opened: {message} (error {code:#x})")]
    NoDevice {
        /// The device.
        device: String,
        /// Message of the library.
        message: String,
        /// Error code of the library.
        code: i32,
    },
    /// Its configuration is missing or wrong.
    #[error("{device} is not configured: {message} (error {code:#x})")]
    Configuration {
        /// The device.
        device: String,
        /// Message of the library.
        message: String,
        /// Error code of the library.
        code: i32,
    },
    /// The device was not calibrated.
    #[error("{device} is not calibrated")]
    NotCalibrated {
        /// The device.
        device: String,
        /// Calibration instructions.
        how: &'static str,
    },
    /// The motors are too warm to begin.
    #[error("the motors of {device} are too warm")]
    WarmMotors {
        /// The device.
        device: String,
    },
    /// Another error of the library.
    #[error("{device}: {doing} failed: {message} (error {code:#x})")]
    Refused {
        /// The device.
        device: String,
        /// Operation that failed.
        doing: &'static str,
        /// Message of the library.
        message: String,
        /// Error code of the library.
        code: i32,
    },
}

impl VendorError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Library(error) => error.remedy(),
            Self::Uri(_) | Self::Setting { .. } => {
                "docs/vendor.md lists the settings of each device".into()
            }
            Self::InUse { .. } => "end the other program or servo loop that has the device".into(),
            Self::NoDevice { .. } => {
                "switch the device on, check its cable with `lsusb`, allow your \
                                      user to open it (udev rule of the vendor), and try the \
                                      vendor's own test program"
                    .into()
            }
            Self::Configuration { .. } => {
                "configure the device with the vendor's set-up program; OpenHaptics keeps the \
                 result in ~/.3dsystems/config"
                    .into()
            }
            Self::NotCalibrated { how, .. } => (*how).into(),
            Self::WarmMotors { .. } => "let the motors cool for some minutes".into(),
            Self::Refused { .. } => {
                "try the vendor's own test program; if that runs, report this as a bug".into()
            }
        }
    }
}
