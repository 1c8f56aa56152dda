//! Settings in a URI such as `falcon:?firmware=novint.bin&peak_n=4`.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::firmware;
use super::geometry::PEAK_FORCE_N;
use crate::device::{Uri, UriError};
use crate::regular_file;

/// Settings of a Falcon, by name.
pub const KNOWN: [&str; 5] = ["firmware", "tries", "peak_n", "motor_step", "ids"];

/// Settings of a Falcon.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Serial number, or bus and address as `3-7`; empty for the first Falcon.
    pub which: String,
    /// File of the firmware, for a device that has none.
    pub firmware: Option<PathBuf>,
    /// Tries of loading it.
    pub tries: u32,
    /// Largest force, N.
    pub peak_n: f32,
    /// Largest change of a motor's command from one frame to the next, counts.
    pub motor_step: i16,
    /// A list of USB ids to use instead of the one built in.
    pub ids: Option<PathBuf>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            which: String::new(),
            firmware: None,
            // Users report that it takes several.
            tries: 10,
            peak_n: PEAK_FORCE_N,
            // Some 2 N a period, what the renderer's limiter lets through.
            motor_step: 1536,
            ids: None,
        }
    }
}

/// Why settings were refused.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// Not one of them.
    #[error(transparent)]
    Uri(#[from] UriError),
    /// A value outside its range.
    #[error("falcon: {key}={value} is outside {range}")]
    Value {
        /// Which setting.
        key: &'static str,
        /// Its value.
        value: String,
        /// Valid values.
        range: &'static str,
    },
    /// The firmware's file cannot be read.
    #[error("{file}: {problem}")]
    File {
        /// The file.
        file: PathBuf,
        /// Reason for the failure.
        problem: String,
    },
}

impl SettingsError {
    /// Returns a remedy for the user.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Uri(_) => "write for instance `falcon:?firmware=FILE&tries=10`".into(),
            Self::Value { key, range, .. } => format!("set {key} to {range}"),
            Self::File { .. } => {
                "name a firmware file with `falcon:?firmware=FILE`; docs/devices.md says where one \
                 comes from"
                    .into()
            }
        }
    }
}

impl Settings {
    /// Reads a name.
    ///
    /// # Errors
    /// [`SettingsError`] for an unknown setting, or a value outside its range.
    pub fn of(uri: &Uri) -> Result<Self, SettingsError> {
        uri.allow(&KNOWN)?;
        let mut settings = Self {
            which: uri.which.clone(),
            firmware: uri.setting("firmware").map(PathBuf::from),
            ids: uri.setting("ids").map(PathBuf::from),
            ..Self::default()
        };
        let refuse = |key, value: &str, range| SettingsError::Value {
            key,
            value: value.into(),
            range,
        };
        if let Some(text) = uri.setting("tries") {
            let value = text.parse().ok().filter(|n| (1..=100).contains(n));
            settings.tries = value.ok_or_else(|| refuse("tries", text, "1 to 100"))?;
        }
        if let Some(text) = uri.setting("peak_n") {
            let value = text.parse().ok();
            let value = value.filter(|n| *n > 0.0 && *n <= PEAK_FORCE_N);
            settings.peak_n =
                value.ok_or_else(|| refuse("peak_n", text, "more than 0, at most 8.9 N"))?;
        }
        if let Some(text) = uri.setting("motor_step") {
            let value = text.parse().ok().filter(|n| (1..=4096).contains(n));
            settings.motor_step =
                value.ok_or_else(|| refuse("motor_step", text, "1 to 4096 counts a frame"))?;
        }
        Ok(settings)
    }

    /// The bytes of the firmware, if a file is named.
    ///
    /// # Errors
    /// [`SettingsError::File`].
    pub fn firmware_bytes(&self) -> Result<Option<Vec<u8>>, SettingsError> {
        self.firmware.as_deref().map(read).transpose()
    }
}

fn read(file: &Path) -> Result<Vec<u8>, SettingsError> {
    let refuse = |problem: String| SettingsError::File {
        file: file.into(),
        problem,
    };
    let opened = regular_file::open(file).map_err(|error| refuse(error.to_string()))?;
    let mut bytes = Vec::new();
    let most = firmware::MAX_BYTES as u64 + 1;
    let read = opened.take(most).read_to_end(&mut bytes);
    read.map_err(|error| refuse(error.to_string()))?;
    if bytes.is_empty() || bytes.len() > firmware::MAX_BYTES {
        return Err(refuse(format!(
            "no firmware: it must have 1 to {} bytes",
            firmware::MAX_BYTES
        )));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(text: &str) -> Result<Settings, SettingsError> {
        Settings::of(&text.parse().expect(text))
    }

    #[test]
    fn a_name_says_everything_or_nothing() {
        assert_eq!(settings("falcon:"), Ok(Settings::default()));
        let all = "falcon:AB12?firmware=a/b.bin&tries=20&peak_n=4.5&motor_step=100&ids=my.toml";
        let expected = Settings {
            which: "AB12".into(),
            firmware: Some("a/b.bin".into()),
            tries: 20,
            peak_n: 4.5,
            motor_step: 100,
            ids: Some("my.toml".into()),
        };
        assert_eq!(settings(all), Ok(expected));
    }

    #[test]
    fn values_outside_their_range_are_refused_by_name() {
        for (text, key) in [
            ("falcon:?tries=0", "tries"),
            ("falcon:?tries=many", "tries"),
            ("falcon:?peak_n=9", "peak_n"),
            ("falcon:?peak_n=NaN", "peak_n"),
            ("falcon:?peak_n=-1", "peak_n"),
            ("falcon:?motor_step=5000", "motor_step"),
            ("falcon:?colour=red", "colour"),
        ] {
            let error = settings(text).expect_err(text);
            assert!(error.to_string().contains(key), "{text}: {error}");
            assert!(!error.remedy().is_empty());
        }
    }

    #[test]
    fn a_firmware_that_is_no_file_is_refused_with_its_name() {
        let folder = std::env::temp_dir().display().to_string();
        for file in ["/nowhere/falcon.bin", &folder] {
            let settings = settings(&format!("falcon:?firmware={file}")).expect("a name");
            let error = settings.firmware_bytes().expect_err(file);
            assert!(error.to_string().starts_with(file), "{error}");
        }
    }
}
