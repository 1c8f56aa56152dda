//! Grip parameters of a hand on the stylus, read from TOML.

use std::path::Path;

use serde::Deserialize;

use crate::config::{self, ConfigError};

const LIGHT: &str = include_str!("../../grips/light.toml");
const FIRM: &str = include_str!("../../grips/firm.toml");

const FIELDS: [&str; 4] = [
    "mass_kg",
    "stiffness_n_m",
    "damping_n_s_m",
    "force_bandwidth_hz",
];

/// A grip: a mass that is rigid with the stylus, and a spring and a damper that pull it to the
/// intended position. It is the same along every axis.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grip {
    /// Name, for reports.
    pub name: String,
    /// Names of the fields whose values are unconfirmed.
    #[serde(default)]
    pub unconfirmed: Vec<String>,
    /// Mass that moves with the stylus, kg.
    pub mass_kg: f64,
    /// Spring to the intended position, N/m.
    pub stiffness_n_m: f64,
    /// Damper to the intended motion, N·s/m.
    pub damping_n_s_m: f64,
    /// Bandwidth with which the hand corrects its normal force, Hz.
    pub force_bandwidth_hz: f64,
}

impl Grip {
    /// A built-in grip by name, `light` or `firm`.
    ///
    /// # Errors
    /// None: a test checks the built-in files.
    pub fn preset(preset: GripPreset) -> Result<Self, ConfigError> {
        match preset {
            GripPreset::Light => Self::from_toml(LIGHT, "light.toml"),
            GripPreset::Firm => Self::from_toml(FIRM, "firm.toml"),
        }
    }

    /// Reads and checks a grip file.
    ///
    /// # Errors
    /// [`ConfigError`] with file, line or field, value and range.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Self::from_toml(&config::read_text(path)?, &path.display().to_string())
    }

    /// Parses and checks the text of a grip file; `file` names it in errors.
    ///
    /// # Errors
    /// [`ConfigError`] with file, line or field, value and range.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ConfigError> {
        let grip: Self = config::parse(text, file)?;
        config::check(file, "mass_kg", grip.mass_kg, 0.0..=5.0, "kg")?;
        config::check(
            file,
            "stiffness_n_m",
            grip.stiffness_n_m,
            10.0..=5000.0,
            "N/m",
        )?;
        config::check(
            file,
            "damping_n_s_m",
            grip.damping_n_s_m,
            0.1..=100.0,
            "N·s/m",
        )?;
        config::check(
            file,
            "force_bandwidth_hz",
            grip.force_bandwidth_hz,
            0.1..=10.0,
            "Hz",
        )?;
        config::check_names(file, &grip.unconfirmed, &FIELDS)?;
        Ok(grip)
    }
}

/// The built-in grips.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GripPreset {
    /// Fingertips only.
    Light,
    /// A tight pen hold.
    Firm,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_grips_are_valid_and_firm_is_stiffer() {
        let light = Grip::preset(GripPreset::Light).expect("built-in file");
        let firm = Grip::preset(GripPreset::Firm).expect("built-in file");
        assert!(firm.stiffness_n_m > light.stiffness_n_m && firm.mass_kg > light.mass_kg);
        assert!(!light.unconfirmed.is_empty());
    }

    #[test]
    fn bad_values_are_named() {
        let text = Grip::from_toml(&LIGHT.replace("0.040", "nan"), "g.toml")
            .expect_err("NaN mass")
            .to_string();
        assert!(
            text.contains("g.toml") && text.contains("mass_kg"),
            "{text}"
        );
    }
}
