//! The configuration of a renderer: rates, cut-offs, limits, the solid.

mod check;
mod error;

pub use self::error::ConfigError;
use asperity_formats::Solid;

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
    /// The solid to touch.
    pub solid: Solid,
    /// Tangent along which the vibration acts.
    pub vibration_axis: VibrationAxis,
    /// Limits of the device's force.
    pub limits: Limits,
    /// Tap detection.
    pub tap: TapConfig,
    /// Bristle friction.
    pub friction: FrictionConfig,
    /// Damping, friction and delay of the device, which bound the stiffness of a wall.
    pub mechanics: MechanicsConfig,
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

/// The bristle that carries friction: `F = k·(|d| − h)`, at most μF_n, with a leak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionConfig {
    /// Bristle stiffness k, N/m. It does not depend on the normal force, or else a
    /// loaded bristle would give back more energy than it took.
    pub stiffness_n_m: f32,
    /// Dead zone h, m: a little more than two counts of position, so that a resting hand
    /// with noise of ±1 count feels no change of sign.
    pub dead_zone_m: f32,
    /// Speed v_c of the leak, m/s: steady friction grows by F_n/v_c with speed until it is
    /// μF_n at μ·v_c + kh·v_c/F_n. 5.5 mm/s is 0.018 F_n per 0.1 mm/s; 0 is Coulomb
    /// friction that holds for ever.
    pub leak_speed_m_s: f32,
}

/// Dissipation and delay of the device itself: an upper bound for the energy that the sampled wall
/// may generate ([`passivity`](crate::stage::passivity)).
///
/// The default is a 3D Systems Touch, all of it unconfirmed on a device: 0.26 N of back-drive
/// friction as published, 0.1 N·s/m assumed, no delay beyond the hold of one period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MechanicsConfig {
    /// Viscous damping b of the mechanism, N·s/m, without any hand.
    pub damping_n_s_m: f32,
    /// Coulomb friction f_c of the mechanism, N.
    pub coulomb_n: f32,
    /// Speed V up to which that friction counts as damping f_c/V, m/s. The default is the
    /// fastest tap of the corpus.
    pub fastest_m_s: f32,
    /// Position resolution Δ, m; 0 for unquantised positions.
    pub position_step_m: f32,
    /// Whole periods between a force and its effect, on top of the hold of one. Add two for a loop
    /// that may lose two samples in a row.
    pub delay_ticks: u32,
}

/// Bad samples and recovery.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SafetyConfig {
    /// Bad samples in a row that hold the last good one, at most 2.
    pub hold_ticks: u32,
    /// Duration of the ramp after a fault, s.
    pub ramp_s: f32,
    /// Largest coordinate of a position, m; beyond it a sample is bad. No desk is larger than the
    /// default of 1 m, so that millimetres given as metres are found out. Fixed point takes no more.
    pub reach_m: f32,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            servo_rate_hz: 1000.0,
            velocity_cutoff_hz: 20.0,
            normal_cutoff_hz: 100.0,
            solid: Solid::Plane {
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
                leak_speed_m_s: 5.5e-3,
            },
            mechanics: MechanicsConfig {
                damping_n_s_m: 0.1,
                coulomb_n: 0.26,
                fastest_m_s: 0.65,
                position_step_m: 0.055e-3,
                delay_ticks: 0,
            },
            safety: SafetyConfig {
                hold_ticks: 2,
                ramp_s: 0.1,
                reach_m: 1.0,
            },
            parameter_time_constant_s: 0.005,
        }
    }
}
