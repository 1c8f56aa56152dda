//! The configuration as a plain struct.

use crate::{
    AsperityStatus,
    arithmetic::ASPERITY_ARITHMETIC_FLOAT,
    memory,
    sized::{self, sized},
    status::{Fault, call},
};
use asperity_runtime::{
    Config, FrictionConfig, Limits, MechanicsConfig, SafetyConfig, Solid, TapConfig, VibrationAxis,
};
use core::ptr;

/// `AsperityConfig::solid`: the half-space below a plane through `solid_point_m` with
/// the outward normal `solid_normal`.
pub const ASPERITY_SOLID_PLANE: u32 = 0;
/// `AsperityConfig::solid`: a ball of `solid_radius_m` around `solid_point_m`.
pub const ASPERITY_SOLID_SPHERE: u32 = 1;
/// `AsperityConfig::solid`: a box around `solid_point_m`, edges along the axes, half
/// as long as `solid_half_extents_m` says.
pub const ASPERITY_SOLID_BOX: u32 = 2;
/// `AsperityConfig::vibration_axis`: along the motion.
pub const ASPERITY_VIBRATION_TANGENT: u32 = 0;
/// `AsperityConfig::vibration_axis`: across it.
pub const ASPERITY_VIBRATION_BINORMAL: u32 = 1;

/// Configuration of a renderer. Start from `asperity_config_default`, which also sets `struct_size`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsperityConfig {
    /// `sizeof(AsperityConfig)`.
    pub struct_size: u32,
    /// Servo rate, Hz; one tick is one period.
    pub servo_rate_hz: f32,
    /// Cut-off of the velocity filter, Hz.
    pub velocity_cutoff_hz: f32,
    /// Cut-off of the normal velocity that the wall's damping sees, Hz.
    pub normal_cutoff_hz: f32,
    /// One of `ASPERITY_SOLID_*`.
    pub solid: u32,
    /// A point of the plane, or the centre, m.
    pub solid_point_m: [f32; 3],
    /// Plane only: outward normal, any length above 0.
    pub solid_normal: [f32; 3],
    /// Sphere only: radius, m.
    pub solid_radius_m: f32,
    /// Box only: half the edge lengths, m.
    pub solid_half_extents_m: [f32; 3],
    /// One of `ASPERITY_VIBRATION_*`.
    pub vibration_axis: u32,
    /// Largest force, N.
    pub peak_n: f32,
    /// Largest change of force, N/s.
    pub slew_n_s: f32,
    /// Slowest impact that plays a transient, m/s.
    pub tap_min_speed_m_s: f32,
    /// Distance from the surface that re-arms the tap detector, m.
    pub tap_rearm_m: f32,
    /// Stiffness of the bristle, N/m.
    pub friction_stiffness_n_m: f32,
    /// Dead zone of the bristle, m.
    pub friction_dead_zone_m: f32,
    /// Speed at which the bristle's deflection leaks, m/s.
    pub friction_leak_speed_m_s: f32,
    /// Viscous damping of the mechanism alone, without a hand, N·s/m.
    pub mechanics_damping_n_s_m: f32,
    /// Coulomb friction of the mechanism, N.
    pub mechanics_coulomb_n: f32,
    /// Largest speed at which the Coulomb friction counts as damping, m/s.
    pub mechanics_fastest_m_s: f32,
    /// Size of one count of position, m; 0 if positions are not quantised.
    pub mechanics_position_step_m: f32,
    /// Whole periods between a force and its effect, beyond the one for which it is held.
    pub mechanics_delay_ticks: u32,
    /// Number of bad samples in a row for which the last good one is held, at most 2.
    pub hold_ticks: u32,
    /// Duration of the ramp after a fault, s.
    pub ramp_s: f32,
    /// Time constant with which model parameters follow speed and force, s.
    pub parameter_time_constant_s: f32,
    /// One of `ASPERITY_ARITHMETIC_*`.
    pub arithmetic: u32,
    /// Largest coordinate of a position, m, at most 1 in fixed point; beyond it a sample is bad. 1 in a
    /// struct of an older header.
    pub reach_m: f32,
}

impl AsperityConfig {
    /// Defaults of the fields that a program of an older header leaves out. The first version has
    /// all of them.
    const OF_LATER_VERSIONS: Self = Self {
        struct_size: size_of::<Self>() as u32,
        servo_rate_hz: 0.0,
        velocity_cutoff_hz: 0.0,
        normal_cutoff_hz: 0.0,
        solid: ASPERITY_SOLID_PLANE,
        solid_point_m: [0.0; 3],
        solid_normal: [0.0; 3],
        solid_radius_m: 0.0,
        solid_half_extents_m: [0.0; 3],
        vibration_axis: ASPERITY_VIBRATION_TANGENT,
        peak_n: 0.0,
        slew_n_s: 0.0,
        tap_min_speed_m_s: 0.0,
        tap_rearm_m: 0.0,
        friction_stiffness_n_m: 0.0,
        friction_dead_zone_m: 0.0,
        friction_leak_speed_m_s: 0.0,
        mechanics_damping_n_s_m: 0.0,
        mechanics_coulomb_n: 0.0,
        mechanics_fastest_m_s: 0.0,
        mechanics_position_step_m: 0.0,
        mechanics_delay_ticks: 0,
        hold_ticks: 0,
        ramp_s: 0.0,
        parameter_time_constant_s: 0.0,
        arithmetic: ASPERITY_ARITHMETIC_FLOAT,
        reach_m: 1.0,
    };
}

sized!(
    AsperityConfig,
    first version ends with parameter_time_constant_s,
    lacking fields are AsperityConfig::OF_LATER_VERSIONS
);

impl From<Config> for AsperityConfig {
    fn from(config: Config) -> Self {
        let (mut normal, mut radius_m, mut half_extents_m) = ([0.0, 0.0, 1.0], 0.0, [0.0; 3]);
        let (solid, point_m) = match config.solid {
            Solid::Plane { point_m, normal: n } => {
                normal = n;
                (ASPERITY_SOLID_PLANE, point_m)
            }
            Solid::Sphere {
                center_m,
                radius_m: r,
            } => {
                radius_m = r;
                (ASPERITY_SOLID_SPHERE, center_m)
            }
            Solid::Box {
                center_m,
                half_extents_m: h,
            } => {
                half_extents_m = h;
                (ASPERITY_SOLID_BOX, center_m)
            }
        };
        Self {
            struct_size: size_of::<Self>() as u32,
            servo_rate_hz: config.servo_rate_hz,
            velocity_cutoff_hz: config.velocity_cutoff_hz,
            normal_cutoff_hz: config.normal_cutoff_hz,
            solid,
            solid_point_m: point_m,
            solid_normal: normal,
            solid_radius_m: radius_m,
            solid_half_extents_m: half_extents_m,
            vibration_axis: match config.vibration_axis {
                VibrationAxis::Tangent => ASPERITY_VIBRATION_TANGENT,
                VibrationAxis::Binormal => ASPERITY_VIBRATION_BINORMAL,
            },
            peak_n: config.limits.peak_n,
            slew_n_s: config.limits.slew_n_s,
            tap_min_speed_m_s: config.tap.min_speed_m_s,
            tap_rearm_m: config.tap.rearm_m,
            friction_stiffness_n_m: config.friction.stiffness_n_m,
            friction_dead_zone_m: config.friction.dead_zone_m,
            friction_leak_speed_m_s: config.friction.leak_speed_m_s,
            mechanics_damping_n_s_m: config.mechanics.damping_n_s_m,
            mechanics_coulomb_n: config.mechanics.coulomb_n,
            mechanics_fastest_m_s: config.mechanics.fastest_m_s,
            mechanics_position_step_m: config.mechanics.position_step_m,
            mechanics_delay_ticks: config.mechanics.delay_ticks,
            hold_ticks: config.safety.hold_ticks,
            ramp_s: config.safety.ramp_s,
            parameter_time_constant_s: config.parameter_time_constant_s,
            arithmetic: ASPERITY_ARITHMETIC_FLOAT,
            reach_m: config.safety.reach_m,
        }
    }
}

impl AsperityConfig {
    /// An unknown solid or axis is refused here. The renderer checks every other field.
    pub(crate) fn checked(&self) -> Result<Config, Fault> {
        let unknown = |field, value, known| Fault::Choice {
            field,
            value,
            known,
        };
        Ok(Config {
            servo_rate_hz: self.servo_rate_hz,
            velocity_cutoff_hz: self.velocity_cutoff_hz,
            normal_cutoff_hz: self.normal_cutoff_hz,
            solid: match self.solid {
                ASPERITY_SOLID_PLANE => Solid::Plane {
                    point_m: self.solid_point_m,
                    normal: self.solid_normal,
                },
                ASPERITY_SOLID_SPHERE => Solid::Sphere {
                    center_m: self.solid_point_m,
                    radius_m: self.solid_radius_m,
                },
                ASPERITY_SOLID_BOX => Solid::Box {
                    center_m: self.solid_point_m,
                    half_extents_m: self.solid_half_extents_m,
                },
                other => {
                    let known = "0 (plane), 1 (sphere) or 2 (box)";
                    return Err(unknown("solid", other, known));
                }
            },
            vibration_axis: match self.vibration_axis {
                ASPERITY_VIBRATION_TANGENT => VibrationAxis::Tangent,
                ASPERITY_VIBRATION_BINORMAL => VibrationAxis::Binormal,
                other => {
                    let known = "0 (tangent) or 1 (binormal)";
                    return Err(unknown("vibration_axis", other, known));
                }
            },
            limits: Limits {
                peak_n: self.peak_n,
                slew_n_s: self.slew_n_s,
            },
            tap: TapConfig {
                min_speed_m_s: self.tap_min_speed_m_s,
                rearm_m: self.tap_rearm_m,
            },
            friction: FrictionConfig {
                stiffness_n_m: self.friction_stiffness_n_m,
                dead_zone_m: self.friction_dead_zone_m,
                leak_speed_m_s: self.friction_leak_speed_m_s,
            },
            mechanics: MechanicsConfig {
                damping_n_s_m: self.mechanics_damping_n_s_m,
                coulomb_n: self.mechanics_coulomb_n,
                fastest_m_s: self.mechanics_fastest_m_s,
                position_step_m: self.mechanics_position_step_m,
                delay_ticks: self.mechanics_delay_ticks,
            },
            safety: SafetyConfig {
                hold_ticks: self.hold_ticks,
                ramp_s: self.ramp_s,
                reach_m: self.reach_m,
            },
            parameter_time_constant_s: self.parameter_time_constant_s,
        })
    }
}

/// Fills in the defaults: a 3D Systems Touch at 1 kHz over the plane z = 0, in floats.
/// `struct_size` is `sizeof(AsperityConfig)`.
///
/// # Safety
/// `config` is null or leads to `struct_size` writable bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn asperity_config_default(
    config: *mut AsperityConfig,
    struct_size: usize,
) -> AsperityStatus {
    // SAFETY: the caller's promise; no error to fill.
    unsafe {
        call(ptr::null_mut(), || {
            let size = u32::try_from(struct_size).map_err(|_| AsperityStatus::StructSize)?;
            memory::write(config.cast::<u32>(), size)?;
            Ok(sized::write(config, &Config::default().into())?)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_configuration_survives_the_way_there_and_back() {
        let mut configs = [Config::default(), Config::default(), Config::default()];
        configs[0].limits.peak_n = 1.5;
        configs[0].safety.reach_m = 0.25;
        configs[1].solid = Solid::Sphere {
            center_m: [1.0, 2.0, 3.0],
            radius_m: 0.5,
        };
        configs[1].vibration_axis = VibrationAxis::Binormal;
        configs[2].solid = Solid::Box {
            center_m: [1.0, 2.0, 3.0],
            half_extents_m: [4.0, 5.0, 6.0],
        };
        for config in configs {
            assert_eq!(AsperityConfig::from(config.clone()).checked(), Ok(config));
        }
    }
}
