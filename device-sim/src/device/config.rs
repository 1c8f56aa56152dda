//! The configuration of a simulated device, read from TOML.

use std::path::Path;

use asperity_runtime::{Config, MechanicsConfig};
use serde::Deserialize;

use crate::config::{self, ConfigError};

/// The built-in device file.
const TOUCH: &str = include_str!("../../devices/touch.toml");

/// Every name that `unconfirmed` may hold.
const FIELDS: [&str; 10] = [
    "workspace.size_mm",
    "mechanics.mass_kg",
    "mechanics.damping_n_s_m",
    "mechanics.coulomb_n",
    "sensor.position_step_mm",
    "actuator.peak_force_n",
    "actuator.continuous_force_n",
    "actuator.dac_bits",
    "timing.servo_rate_hz",
    "timing.transport_delay_ticks",
];

/// A simulated device.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeviceConfig {
    /// Name, for reports.
    pub name: String,
    /// Dotted names of the fields whose values are unconfirmed.
    #[serde(default)]
    pub unconfirmed: Vec<String>,
    /// The space in which the stylus can move.
    pub workspace: Workspace,
    /// Mass, damping and friction.
    pub mechanics: Mechanics,
    /// Position measurement.
    pub sensor: Sensor,
    /// Force output.
    pub actuator: Actuator,
    /// Rates and delays.
    pub timing: Timing,
}

/// Workspace, a box centred on the origin with inelastic stops.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Workspace {
    /// Full extent along each axis, mm.
    pub size_mm: [f64; 3],
}

/// Mechanics of each axis. The axes are independent, and gravity counts as compensated.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mechanics {
    /// Apparent mass, kg.
    pub mass_kg: [f64; 3],
    /// Viscous damping, N·s/m.
    pub damping_n_s_m: [f64; 3],
    /// Coulomb (back-drive) friction, N.
    pub coulomb_n: [f64; 3],
}

/// Position measurement.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// Quantisation step, mm; 0 for a perfect sensor.
    pub position_step_mm: f64,
}

/// Force output.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Actuator {
    /// Largest magnitude of the force vector, N. It is enforced.
    pub peak_force_n: f64,
    /// Force that the device can hold permanently, N. Reports refer to it; it is not enforced.
    pub continuous_force_n: f64,
    /// Bits of each axis's converter over ±peak; 0 for a perfect converter.
    pub dac_bits: u32,
}

/// Rates and delays.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// Servo rate, Hz.
    pub servo_rate_hz: f64,
    /// Whole ticks from a command to its effect, on top of the zero-order hold.
    pub transport_delay_ticks: usize,
}

impl DeviceConfig {
    /// The mechanics with which the runtime is configured: the smallest values of the three axes.
    #[must_use]
    pub fn mechanics_config(&self) -> MechanicsConfig {
        let least = |values: [f64; 3]| values.into_iter().fold(f64::INFINITY, f64::min) as f32;
        MechanicsConfig {
            damping_n_s_m: least(self.mechanics.damping_n_s_m),
            coulomb_n: least(self.mechanics.coulomb_n),
            position_step_m: (1e-3 * self.sensor.position_step_mm) as f32,
            delay_ticks: self.timing.transport_delay_ticks as u32,
            ..Config::default().mechanics
        }
    }

    /// The built-in Touch.
    ///
    /// # Errors
    /// None: a test checks the built-in file.
    pub fn touch() -> Result<Self, ConfigError> {
        Self::from_toml(TOUCH, "touch.toml")
    }

    /// Reads and checks a device file.
    ///
    /// # Errors
    /// [`ConfigError`] with file, line or field, value and range.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        Self::from_toml(&config::read_text(path)?, &path.display().to_string())
    }

    /// Parses and checks the text of a device file; `file` names it in errors.
    ///
    /// # Errors
    /// [`ConfigError`] with file, line or field, value and range.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, ConfigError> {
        let device: Self = config::parse(text, file)?;
        device.validate(file)?;
        Ok(device)
    }

    fn validate(&self, file: &str) -> Result<(), ConfigError> {
        let axes =
            |field, values, range, unit| config::check_axes(file, field, values, range, unit);
        let check =
            |field: &str, value, range, unit| config::check(file, field, value, range, unit);
        axes(
            "workspace.size_mm",
            self.workspace.size_mm,
            1.0..=2000.0,
            "mm",
        )?;
        axes(
            "mechanics.mass_kg",
            self.mechanics.mass_kg,
            0.001..=10.0,
            "kg",
        )?;
        axes(
            "mechanics.damping_n_s_m",
            self.mechanics.damping_n_s_m,
            0.0..=100.0,
            "N·s/m",
        )?;
        axes(
            "mechanics.coulomb_n",
            self.mechanics.coulomb_n,
            0.0..=20.0,
            "N",
        )?;
        check(
            "sensor.position_step_mm",
            self.sensor.position_step_mm,
            0.0..=1.0,
            "mm",
        )?;
        check(
            "actuator.peak_force_n",
            self.actuator.peak_force_n,
            0.01..=100.0,
            "N",
        )?;
        check(
            "actuator.continuous_force_n",
            self.actuator.continuous_force_n,
            0.0..=100.0,
            "N",
        )?;
        check(
            "actuator.dac_bits",
            f64::from(self.actuator.dac_bits),
            0.0..=24.0,
            "bits",
        )?;
        check(
            "timing.servo_rate_hz",
            self.timing.servo_rate_hz,
            100.0..=10_000.0,
            "Hz",
        )?;
        let delay = self.timing.transport_delay_ticks as f64;
        check("timing.transport_delay_ticks", delay, 0.0..=1000.0, "ticks")?;
        if self.actuator.continuous_force_n > self.actuator.peak_force_n {
            return Err(ConfigError::Order {
                file: file.into(),
                field: "actuator.continuous_force_n",
                value: self.actuator.continuous_force_n,
                other: "actuator.peak_force_n",
                limit: self.actuator.peak_force_n,
            });
        }
        config::check_names(file, &self.unconfirmed, &FIELDS)
    }

    /// Half the workspace, m.
    #[must_use]
    pub fn half_extents_m(&self) -> [f64; 3] {
        self.workspace.size_mm.map(|size_mm| size_mm * 0.5e-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_io::diagnostic::Diagnostic as _;

    #[test]
    fn the_built_in_device_is_valid_and_marks_what_nobody_confirmed() {
        let touch = DeviceConfig::touch().expect("built-in file");
        assert_eq!(touch.actuator.peak_force_n, 3.3);
        assert!(
            touch
                .unconfirmed
                .iter()
                .any(|name| name == "mechanics.mass_kg")
        );
    }

    #[test]
    fn every_bad_value_is_named_with_its_file_field_and_range() {
        let cases = [
            (
                "coulomb_n = [0.26, 0.26, 0.26]",
                "coulomb_n = [0.26, -1.0, 0.26]",
                "mechanics.coulomb_n[1]",
            ),
            (
                "position_step_mm = 0.055",
                "position_step_mm = nan",
                "sensor.position_step_mm",
            ),
            (
                "position_step_mm = 0.055",
                "position_step_mm = 5e-324",
                "sensor.position_step_mm",
            ),
            (
                "coulomb_n = [0.26, 0.26, 0.26]",
                "coulomb_n = [0.26, 0.26, 1e-310]",
                "mechanics.coulomb_n[2]",
            ),
            ("dac_bits = 12", "dac_bits = 99", "actuator.dac_bits"),
            (
                "peak_force_n = 3.3",
                "peak_force_n = inf",
                "actuator.peak_force_n",
            ),
            (
                "continuous_force_n = 0.88",
                "continuous_force_n = 9.0",
                "actuator.continuous_force_n",
            ),
            (
                "servo_rate_hz = 1000.0",
                "servo_rate_hz = 0.0",
                "timing.servo_rate_hz",
            ),
            (
                "\"actuator.dac_bits\",",
                "\"actuator.dac_bit\",",
                "actuator.dac_bit",
            ),
        ];
        for (good, bad, field) in cases {
            assert!(TOUCH.contains(good), "{good}");
            let error =
                DeviceConfig::from_toml(&TOUCH.replace(good, bad), "mine.toml").expect_err(bad);
            let text = error.to_string();
            assert!(
                text.starts_with("mine.toml") && text.contains(field),
                "{text}"
            );
            assert!(!error.remedy().is_empty());
        }
    }

    #[test]
    fn unknown_missing_and_mistyped_keys_are_refused_with_their_line() {
        let unknown = TOUCH.replace("dac_bits = 12", "dac_bit = 12");
        let line = 1 + unknown
            .lines()
            .position(|l| l == "dac_bit = 12")
            .expect("the line");
        let text = DeviceConfig::from_toml(&unknown, "mine.toml")
            .expect_err("unknown")
            .to_string();
        assert!(
            text.contains(&format!("mine.toml:{line}:")) && text.contains("dac_bit"),
            "{text}"
        );
        let missing = TOUCH.replace("position_step_mm = 0.055", "");
        let text = DeviceConfig::from_toml(&missing, "mine.toml")
            .expect_err("missing")
            .to_string();
        assert!(text.contains("position_step_mm"), "{text}");
        let mistyped = TOUCH.replace("transport_delay_ticks = 0", "transport_delay_ticks = -1");
        assert!(DeviceConfig::from_toml(&mistyped, "mine.toml").is_err());
    }
}
