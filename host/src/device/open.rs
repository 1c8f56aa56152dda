//! From the name of a device to the device.

use super::{
    Device, NullDevice, Scheme, Uri, UriError, dhd::Dhd, openhaptics::OpenHaptics, replay::Replay,
};
use thiserror::Error;

/// Why a device cannot be opened.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OpenError {
    /// The name is wrong.
    #[error(transparent)]
    Uri(#[from] UriError),
    /// A setting has a value that is none.
    #[error("`{uri}`: {key} must be {rule}")]
    Setting {
        /// The device.
        uri: String,
        /// The setting.
        key: &'static str,
        /// Rule for its value.
        rule: &'static str,
    },
    /// This program has no such device.
    #[error("`{uri}`: this program cannot open devices of the kind {scheme}:")]
    NotHere {
        /// The device.
        uri: String,
        /// Its kind.
        scheme: &'static str,
    },
    /// The device was found, or its library, and could not be used.
    #[error("`{uri}`: {why}")]
    Failed {
        /// The device.
        uri: String,
        /// Reason.
        why: String,
        /// Remedy.
        remedy: String,
    },
}

impl OpenError {
    /// A setting with a value that is none.
    #[must_use]
    pub fn setting(uri: &Uri, key: &'static str, rule: &'static str) -> Self {
        Self::Setting {
            uri: uri.to_string(),
            key,
            rule,
        }
    }

    /// Returns a remedy for the user, a single sentence.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Uri(_) | Self::Setting { .. } => {
                "write SCHEME:WHICH?key=value&key=value, such as `null:?z_mm=-1` or `sim:?grip=firm`"
                    .into()
            }
            Self::NotHere { scheme: "touch", .. } => {
                "its frames are the vendor's secret: use openhaptics: with the vendor's library".into()
            }
            Self::NotHere { .. } => "use null: or sim:".into(),
            Self::Failed { remedy, .. } => remedy.clone(),
        }
    }
}

/// Opens a device by its name, for a servo loop at `rate_hz`. A simulated one needs the simulator,
/// which has a function of its own.
///
/// # Errors
/// [`OpenError`].
pub fn open(uri: &Uri, _rate_hz: u32) -> Result<Box<dyn Device>, OpenError> {
    match uri.scheme {
        Scheme::Null => Ok(Box::new(NullDevice::open(uri)?)),
        Scheme::OpenHaptics => match OpenHaptics::open(uri) {
            Ok(device) => Ok(Box::new(device)),
            Err(error) => Err(failed(uri, &error, error.remedy())),
        },
        Scheme::Dhd => match Dhd::open(uri) {
            Ok(device) => Ok(Box::new(device)),
            Err(error) => Err(failed(uri, &error, error.remedy())),
        },
        Scheme::Replay => match Replay::open(uri) {
            Ok(device) => Ok(Box::new(device)),
            Err(error) => Err(failed(uri, &error, error.remedy())),
        },
        #[cfg(feature = "usb")]
        Scheme::Falcon => match super::falcon::on_usb::open(uri) {
            Ok(device) => Ok(Box::new(device)),
            Err(error) => Err(failed(uri, &error, error.remedy())),
        },
        scheme => Err(OpenError::NotHere {
            uri: uri.to_string(),
            scheme: scheme.name(),
        }),
    }
}

fn failed(uri: &Uri, why: &dyn std::fmt::Display, remedy: impl Into<String>) -> OpenError {
    OpenError::Failed {
        uri: uri.to_string(),
        why: why.to_string(),
        remedy: remedy.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_device_rests_where_it_is_told_to() {
        let height = |text: &str| -> Result<f32, OpenError> {
            let mut device = open(&text.parse()?, 1000)?;
            let reading = device.read().expect("it always answers");
            assert!(reading.fresh && device.write([1e9; 3]).is_ok());
            Ok(reading.position_m[2])
        };
        assert_eq!(height("null:").expect("no device"), 0.05);
        assert_eq!(height("null:?z_mm=-1").expect("no device"), -0.001);
        for bad in [
            "null:?z_mm=deep",
            "null:?z_mm=1e9",
            "null:?z_mm=nan",
            "null:?depth=1",
            "sim:",
        ] {
            let error = height(bad).expect_err(bad);
            assert!(!error.remedy().is_empty(), "{error}");
        }
    }
}
