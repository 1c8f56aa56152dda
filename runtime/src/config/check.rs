//! The range of every field.

use super::{Config, error::ConfigError};
use crate::math::{Vec3, norm};
use asperity_formats::Solid;

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
                "friction.leak_speed_m_s",
                self.friction.leak_speed_m_s,
                0.0,
                1.0,
                "0 to 1 m/s",
            ),
            (
                "mechanics.damping_n_s_m",
                self.mechanics.damping_n_s_m,
                0.0,
                1000.0,
                "0 to 1000 N·s/m",
            ),
            (
                "mechanics.coulomb_n",
                self.mechanics.coulomb_n,
                0.0,
                1000.0,
                "0 to 1000 N",
            ),
            (
                "mechanics.fastest_m_s",
                self.mechanics.fastest_m_s,
                0.01,
                100.0,
                "0.01 to 100 m/s",
            ),
            (
                "mechanics.position_step_m",
                self.mechanics.position_step_m,
                0.0,
                0.01,
                "0 to 0.01 m",
            ),
            (
                "mechanics.delay_ticks",
                self.mechanics.delay_ticks as f32,
                0.0,
                100.0,
                "at most 100",
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
                "safety.reach_m",
                self.safety.reach_m,
                0.001,
                10_000.0,
                "1 mm to 10 km",
            ),
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
            None => check_solid(&self.solid),
        }
    }
}

/// Checks a solid.
fn check_solid(solid: &Solid) -> Result<(), ConfigError> {
    let finite = |field, v: Vec3| match v.iter().find(|x| x.is_nan() || x.abs() > 1e4) {
        Some(&value) => Err(ConfigError {
            field,
            value,
            rule: "finite, at most 1e4",
        }),
        None => Ok(()),
    };
    let positive = |field, value: f32| {
        if value > 1e-6 && value <= 1e4 {
            Ok(())
        } else {
            Err(ConfigError {
                field,
                value,
                rule: "above 1e-6, at most 1e4",
            })
        }
    };
    match *solid {
        Solid::Plane { point_m, normal } => {
            finite("solid.point_m", point_m)?;
            finite("solid.normal", normal)?;
            positive("solid.normal length", norm(normal))
        }
        Solid::Sphere { center_m, radius_m } => {
            finite("solid.center_m", center_m)?;
            positive("solid.radius_m", radius_m)
        }
        Solid::Box {
            center_m,
            half_extents_m,
        } => {
            finite("solid.center_m", center_m)?;
            half_extents_m
                .into_iter()
                .try_for_each(|h| positive("solid.half_extents_m", h))
        }
    }
}
