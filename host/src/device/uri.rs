//! Names of devices: `scheme:what?key=value&key=value`.

use thiserror::Error;

/// A kind of device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scheme {
    /// A simulated device with a simulated hand.
    Sim,
    /// A Novint Falcon over USB.
    Falcon,
    /// Any device of the vendor's library OpenHaptics HD.
    OpenHaptics,
    /// Any device of the vendor's library Force Dimension DHD.
    Dhd,
    /// A 3D Systems Touch over USB, identified only.
    Touch,
    /// A recorded session.
    Replay,
    /// No device: it rests in free air, and takes any force.
    Null,
}

impl Scheme {
    /// Every scheme.
    pub const ALL: [Self; 7] = [
        Self::Sim,
        Self::Falcon,
        Self::OpenHaptics,
        Self::Dhd,
        Self::Touch,
        Self::Replay,
        Self::Null,
    ];

    /// Returns the scheme's name, before the colon.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sim => "sim",
            Self::Falcon => "falcon",
            Self::OpenHaptics => "openhaptics",
            Self::Dhd => "dhd",
            Self::Touch => "touch",
            Self::Replay => "replay",
            Self::Null => "null",
        }
    }
}

/// The name of a device, such as `falcon:?firmware=falcon.bin` or `replay:session.aspr`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Uri {
    /// Kind of the device.
    pub scheme: Scheme,
    /// Which one: a serial number, a configured name, a path; empty for the first.
    pub which: String,
    /// Settings, in the order in which they were written.
    pub settings: Vec<(String, String)>,
}

/// Why a name is none of a device.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum UriError {
    /// No scheme, or an unknown one.
    #[error(
        "`{0}` is not a known kind of device; known kinds are sim:, falcon:, openhaptics:, dhd:, touch:, replay:FILE and null:"
    )]
    Scheme(String),
    /// A setting without a value.
    #[error("`{0}` is no setting; write key=value")]
    Setting(String),
    /// A setting that this kind of device does not have.
    #[error("{scheme}: has no setting `{key}`; it has {known}")]
    Unknown {
        /// Scheme, before the colon.
        scheme: &'static str,
        /// The setting.
        key: String,
        /// Known settings.
        known: String,
    },
}

impl Uri {
    /// The value of a setting.
    #[must_use]
    pub fn setting(&self, key: &str) -> Option<&str> {
        let found = self.settings.iter().find(|(name, _)| name == key);
        found.map(|(_, value)| value.as_str())
    }

    /// Refuses settings that are not among `known`.
    ///
    /// # Errors
    /// [`UriError::Unknown`].
    pub fn allow(&self, known: &[&str]) -> Result<(), UriError> {
        let unknown = self
            .settings
            .iter()
            .find(|(key, _)| !known.contains(&key.as_str()));
        unknown.map_or(Ok(()), |(key, _)| {
            Err(UriError::Unknown {
                scheme: self.scheme.name(),
                key: key.clone(),
                known: if known.is_empty() {
                    "none".into()
                } else {
                    known.join(", ")
                },
            })
        })
    }
}

impl std::str::FromStr for Uri {
    type Err = UriError;

    fn from_str(text: &str) -> Result<Self, UriError> {
        let (name, rest) = text
            .split_once(':')
            .ok_or_else(|| UriError::Scheme(text.into()))?;
        let scheme = Scheme::ALL.into_iter().find(|scheme| scheme.name() == name);
        let scheme = scheme.ok_or_else(|| UriError::Scheme(text.into()))?;
        let (which, settings) = rest.split_once('?').unwrap_or((rest, ""));
        let settings = settings.split('&').filter(|setting| !setting.is_empty());
        let settings = settings.map(|setting| {
            let pair = setting.split_once('=').filter(|(key, _)| !key.is_empty());
            let (key, value) = pair.ok_or_else(|| UriError::Setting(setting.into()))?;
            Ok((key.to_owned(), value.to_owned()))
        });
        Ok(Self {
            scheme,
            which: which.to_owned(),
            settings: settings.collect::<Result<_, _>>()?,
        })
    }
}

impl std::fmt::Display for Uri {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}", self.scheme.name(), self.which)?;
        for (n, (key, value)) in self.settings.iter().enumerate() {
            write!(f, "{}{key}={value}", if n == 0 { '?' } else { '&' })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        for text in [
            "null:",
            "sim:",
            "replay:a/b c.aspr",
            "falcon:AB12?firmware=f.bin&rate=1000",
        ] {
            let uri: Uri = text.parse().expect(text);
            assert_eq!(uri.to_string(), text);
        }
    }

    #[test]
    fn what_is_no_device_is_refused() {
        for text in ["", "falcon", "phantom:", "C:\\replay"] {
            assert!(
                matches!(text.parse::<Uri>(), Err(UriError::Scheme(_))),
                "{text}"
            );
        }
        assert!(matches!(
            "sim:?grip".parse::<Uri>(),
            Err(UriError::Setting(_))
        ));
        let uri: Uri = "null:?speed=1".parse().expect("a name");
        assert!(uri.allow(&["speed"]).is_ok() && uri.allow(&[]).is_err());
    }
}
