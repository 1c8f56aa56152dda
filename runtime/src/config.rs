//! What a renderer is told once: rates, cut-offs, limits, surface.

use crate::contact::Surface;
use thiserror::Error;

/// Configuration of a [`Renderer`](crate::Renderer). The default is a 3D Systems
/// Touch at 1 kHz over the plane z = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// Servo rate, Hz; one tick is one period.
    pub servo_rate_hz: f32,
    /// Cut-off of the velocity filter, Hz; its delay at low frequency is
    /// √2 / (2π f) plus half a period: 11.8 ms at 20 Hz and 1 kHz.
    pub velocity_cutoff_hz: f32,
    /// Cut-off of the normal velocity that the wall's damping sees, Hz.
    pub normal_cutoff_hz: f32,
    /// What is touched.
    pub surface: Surface,
    /// Along which tangent the vibration acts.
    pub vibration_axis: VibrationAxis,
    /// What the device can bear.
    pub limits: Limits,
    /// Tap detection.
    pub tap: TapConfig,
    /// Bristle friction.
    pub friction: FrictionConfig,
    /// Bad samples and recovery.
    pub safety: SafetyConfig,
    /// Time constant with which model parameters follow speed and force, s. Far
    /// below the 40 ms that a hand notices; it keeps the recursion bounded when
    /// speed or force jump.
    pub parameter_time_constant_s: f32,
}

/// Direction of the vibration in the tangent plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VibrationAxis {
    /// Along the motion, t̂, as in the paper.
    Tangent,
    /// Across it, t̂ × n̂, as the HaTT renderer has it.
    Binormal,
}

/// Force limits of a device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest force, N.
    pub peak_n: f32,
    /// Largest change of force, N/s.
    pub slew_n_s: f32,
}

/// When an impact counts as a tap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TapConfig {
    /// Slowest impact that plays a transient, m/s.
    pub min_speed_m_s: f32,
    /// Distance from the surface that re-arms the detector, m.
    pub rearm_m: f32,
}

/// The bristle that carries friction: `F = k·(|d| − h)`, at most μF_n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionConfig {
    /// Bristle stiffness k, N/m. It does not depend on the normal force, or else a
    /// loaded bristle would give back more energy than it took.
    pub stiffness_n_m: f32,
    /// Dead zone h, m: a little more than two counts of position, so that a resting hand
    /// with noise of ±1 count feels no change of sign.
    pub dead_zone_m: f32,
}

/// Bad samples and recovery.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafetyConfig {
    /// Bad samples in a row that hold the last good one, at most 2.
    pub hold_ticks: u32,
    /// Duration of the ramp after a fault, s.
    pub ramp_s: f32,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            servo_rate_hz: 1000.0,
            velocity_cutoff_hz: 20.0,
            normal_cutoff_hz: 100.0,
            surface: Surface::Plane {
                point_m: [0.0; 3],
                normal: [0.0, 0.0, 1.0],
            },
            vibration_axis: VibrationAxis::Tangent,
            limits: Limits {
                peak_n: 3.3,
                slew_n_s: 2000.0,
            },
            tap: TapConfig {
                min_speed_m_s: 0.01,
                rearm_m: 0.5e-3,
            },
            friction: FrictionConfig {
                stiffness_n_m: 300.0,
                dead_zone_m: 0.12e-3,
            },
            safety: SafetyConfig {
                hold_ticks: 2,
                ramp_s: 0.1,
            },
            parameter_time_constant_s: 0.005,
        }
    }
}

/// A configuration that makes no sense.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("config {field} = {value}: {rule}")]
pub struct ConfigError {
    /// Which field.
    pub field: &'static str,
    /// Its value.
    pub value: f32,
    /// The rule it breaks.
    pub rule: &'static str,
}

impl Config {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field that is not finite or not in its range.
    pub fn check(&self) -> Result<(), ConfigError> {
        let rate = self.servo_rate_hz;
        let tiny = f32::MIN_POSITIVE;
        let mut fields = [
            ("servo_rate_hz", rate, 100.0, 20_000.0, "100 Hz to 20 kHz"),
            (
                "velocity_cutoff_hz",
                self.velocity_cutoff_hz,
                0.1,
                0.45 * rate,
                "0.1 Hz to 0.45 of the servo rate",
            ),
            (
                "normal_cutoff_hz",
                self.normal_cutoff_hz,
                0.1,
                0.45 * rate,
                "0.1 Hz to 0.45 of the servo rate",
            ),
            (
                "limits.peak_n",
                self.limits.peak_n,
                tiny,
                10_000.0,
                "above 0, at most 1e4 N",
            ),
            (
                "limits.slew_n_s",
                self.limits.slew_n_s,
                tiny,
                1e9,
                "above 0, at most 1e9 N/s",
            ),
            (
                "tap.min_speed_m_s",
                self.tap.min_speed_m_s,
                0.0,
                100.0,
                "0 to 100 m/s",
            ),
            ("tap.rearm_m", self.tap.rearm_m, 0.0, 0.1, "0 to 0.1 m"),
            (
                "friction.stiffness_n_m",
                self.friction.stiffness_n_m,
                tiny,
                100_000.0,
                "above 0, at most 1e5 N/m",
            ),
            (
                "friction.dead_zone_m",
                self.friction.dead_zone_m,
                0.0,
                0.01,
                "0 to 0.01 m",
            ),
            (
                "safety.hold_ticks",
                self.safety.hold_ticks as f32,
                0.0,
                2.0,
                "at most 2",
            ),
            ("safety.ramp_s", self.safety.ramp_s, 0.0, 10.0, "0 to 10 s"),
            (
                "parameter_time_constant_s",
                self.parameter_time_constant_s,
                0.0,
                0.04,
                "0 to 0.04 s, what a hand does not notice",
            ),
        ]
        .into_iter();
        match fields.find(|&(_, value, low, high, _)| !(value >= low && value <= high)) {
            Some((field, value, _, _, rule)) => Err(ConfigError { field, value, rule }),
            None => self.surface.check(),
        }
    }
}
