//! Response of a device to a force: limits, mechanics, delay, and a filter that equalises it.
//!
//! A profile is a TOML file. Two devices do not feel alike: the same force produces different
//! accelerations at the tip. [`response::estimate`] estimates the response from a commanded force
//! and an acceleration, and [`compensation::design`] derives a short filter from it, so that a
//! texture has the same acceleration spectrum on both.

pub mod compensation;
mod error;
pub mod response;
pub mod sweep;

pub use error::ProfileError;

use std::path::Path;

use crate::regular_file;
use asperity_runtime::{Config, Limits, MechanicsConfig};
use serde::{Deserialize, Serialize};

/// The most coefficients of a compensation filter.
pub const MOST_TAPS: usize = 8;

/// Every name that `unconfirmed` may hold.
pub const FIELDS: [&str; 9] = [
    "limits.peak_n",
    "limits.continuous_n",
    "limits.slew_n_s",
    "mechanics.mass_kg",
    "mechanics.damping_n_s_m",
    "mechanics.coulomb_n",
    "mechanics.position_step_mm",
    "timing.delay_ticks",
    "compensation.taps",
];

/// A device's profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Name, for reports.
    pub name: String,
    /// Dotted names of the fields with values unconfirmed on a device.
    #[serde(default)]
    pub unconfirmed: Vec<String>,
    /// Limits of the force.
    pub limits: ForceLimits,
    /// Mass, damping, friction, counts.
    pub mechanics: Mechanics,
    /// Delays.
    pub timing: Timing,
    /// The filter, if the device was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compensation: Option<Compensation>,
}

/// Force limits of a device.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ForceLimits {
    /// Largest magnitude of the force, N.
    pub peak_n: f32,
    /// Magnitude that the device can hold permanently, N.
    pub continuous_n: f32,
    /// Largest change of force, N/s.
    pub slew_n_s: f32,
}

/// Mechanics of the weakest axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mechanics {
    /// Apparent mass at the tip, kg.
    pub mass_kg: f32,
    /// Viscous damping, N·s/m.
    pub damping_n_s_m: f32,
    /// Coulomb friction, N.
    pub coulomb_n: f32,
    /// Position resolution, mm; 0 for unquantised positions.
    pub position_step_mm: f32,
}

/// Delays.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// Whole periods between a force and its effect, on top of the hold of one.
    pub delay_ticks: u32,
}

/// A filter on the force of the vibration: y\[n\] = Σ taps\[k\]·x\[n − k\]. It is of minimum phase,
/// so it delays as little as its gains allow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compensation {
    /// Servo rate for which it was made, Hz.
    pub rate_hz: f32,
    /// The coefficients, at most eight.
    pub taps: Vec<f32>,
}

impl Profile {
    /// Reads and checks a file of at most 1 MiB.
    ///
    /// # Errors
    /// [`ProfileError`] with file, field, value and range.
    pub fn load(path: &Path) -> Result<Self, ProfileError> {
        use std::io::Read as _;
        const MOST: u64 = 1 << 20;
        let file = path.display().to_string();
        let mut text = String::new();
        regular_file::open(path)
            .and_then(|opened| opened.take(MOST).read_to_string(&mut text))
            .map_err(|cause| ProfileError::Read {
                file: file.clone(),
                cause,
            })?;
        Self::from_toml(&text, &file)
    }

    /// Parses and checks a text; `file` names it in errors.
    ///
    /// # Errors
    /// [`ProfileError`].
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ProfileError> {
        let parsed: Result<Self, _> = toml::from_str(text);
        let profile = parsed.map_err(|cause| ProfileError::Parse {
            file: file.into(),
            message: cause.to_string().trim_end().to_owned(),
        })?;
        profile.check(file)?;
        Ok(profile)
    }

    fn check(&self, file: &str) -> Result<(), ProfileError> {
        let (limits, mechanics) = (&self.limits, &self.mechanics);
        for (field, value, min, max, unit) in [
            ("limits.peak_n", limits.peak_n, 0.01, 100.0, "N"),
            (
                "limits.continuous_n",
                limits.continuous_n,
                0.0,
                limits.peak_n,
                "N, the peak at most",
            ),
            ("limits.slew_n_s", limits.slew_n_s, 1.0, 1e6, "N/s"),
            ("mechanics.mass_kg", mechanics.mass_kg, 0.001, 10.0, "kg"),
            (
                "mechanics.damping_n_s_m",
                mechanics.damping_n_s_m,
                0.0,
                100.0,
                "N·s/m",
            ),
            ("mechanics.coulomb_n", mechanics.coulomb_n, 0.0, 20.0, "N"),
            (
                "mechanics.position_step_mm",
                mechanics.position_step_mm,
                0.0,
                1.0,
                "mm",
            ),
            (
                "timing.delay_ticks",
                self.timing.delay_ticks as f32,
                0.0,
                100.0,
                "periods",
            ),
        ] {
            if !(min..=max).contains(&value) {
                return Err(ProfileError::Range {
                    file: file.into(),
                    field,
                    value,
                    min,
                    max,
                    unit,
                });
            }
        }
        if let Some(name) = self
            .unconfirmed
            .iter()
            .find(|name| !FIELDS.contains(&name.as_str()))
        {
            return Err(ProfileError::UnknownField {
                file: file.into(),
                name: name.clone(),
            });
        }
        match &self.compensation {
            Some(filter) => compensation::check(filter, file),
            None => Ok(()),
        }
    }

    /// The profile as a file.
    ///
    /// # Panics
    /// Never: strings and numbers are TOML.
    #[must_use]
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("strings and numbers are TOML")
    }

    /// A configuration with the limits and the mechanics of this device.
    #[must_use]
    pub fn apply(&self, config: &Config) -> Config {
        Config {
            limits: Limits {
                peak_n: self.limits.peak_n,
                slew_n_s: self.limits.slew_n_s,
            },
            mechanics: MechanicsConfig {
                damping_n_s_m: self.mechanics.damping_n_s_m,
                coulomb_n: self.mechanics.coulomb_n,
                position_step_m: 1e-3 * self.mechanics.position_step_mm,
                delay_ticks: self.timing.delay_ticks,
                ..config.mechanics
            },
            ..config.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOUCH: &str = include_str!("../../devices/touch.toml");
    const FALCON: &str = include_str!("../../devices/falcon.toml");

    #[test]
    fn the_files_of_devices_are_valid_and_read_back() {
        for text in [TOUCH, FALCON] {
            let mut profile = Profile::from_toml(text, "device.toml").expect("a profile");
            assert!(!profile.unconfirmed.is_empty());
            assert!(asperity_runtime::Renderer::new(&profile.apply(&Config::default())).is_ok());
            profile.name = "a \"b\" \\ \u{7f} \u{1b} c".into();
            profile.compensation = Some(Compensation {
                rate_hz: 1000.0,
                taps: vec![1.25, -0.3, 0.1 / 3.0],
            });
            let again = Profile::from_toml(&profile.to_toml(), "again.toml").expect("a profile");
            assert_eq!(again, profile);
        }
    }

    #[test]
    fn every_bad_value_is_named() {
        for (good, bad, named) in [
            ("peak_n = 3.3", "peak_n = 0.0", "limits.peak_n"),
            (
                "continuous_n = 0.88",
                "continuous_n = 4.0",
                "limits.continuous_n",
            ),
            ("mass_kg = 0.045", "mass_kg = nan", "mechanics.mass_kg"),
            ("coulomb_n = 0.26", "coulomb = 0.26", "coulomb"),
            ("delay_ticks = 0", "delay_ticks = -1", "delay_ticks"),
            ("\"limits.slew_n_s\",", "\"limits.slew\",", "limits.slew"),
            (
                "delay_ticks = 0",
                "delay_ticks = 0\n[compensation]\nrate_hz = 1000.0\ntaps = []",
                "compensation.taps",
            ),
            (
                "delay_ticks = 0",
                "delay_ticks = 0\n[compensation]\nrate_hz = 1000.0\ntaps = [1.0, -2.0]",
                "minimum phase",
            ),
        ] {
            assert!(TOUCH.contains(good), "{good}");
            let error =
                Profile::from_toml(&TOUCH.replacen(good, bad, 1), "mine.toml").expect_err(bad);
            let text = error.to_string();
            assert!(text.contains("mine.toml") && text.contains(named), "{text}");
            assert!(!error.remedy().is_empty());
        }
    }
}
