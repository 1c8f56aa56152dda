//! Devices as the sweeps vary them, and renderers that know them or do not.

use asperity_runtime::{Config, MechanicsConfig, Renderer};

use crate::stability::observer::Absorber;

/// Servo period, s.
pub const TICK_S: f64 = 1e-3;
/// The stiffness that the driver of the Touch reports, N/m, and our default damping, N·s/m.
pub const REPORTED: (f64, f64) = (500.0, 0.1);
/// Physical damping over which walls are tried, N·s/m.
pub const DAMPINGS_N_S_M: [f64; 9] = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 1.0];
/// Energy error from rounding f32 forces over a second of motion, J.
pub const ROUNDING_J: f64 = 2e-8;

/// A device as the sweeps vary it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bench {
    /// Physical damping, N·s/m.
    pub damping_n_s_m: f64,
    /// Coulomb friction, N.
    pub coulomb_n: f64,
    /// Position resolution (a count), m; 0 for a perfect sensor.
    pub position_step_m: f64,
    /// Ticks of delay on top of the hold.
    pub delay_ticks: u32,
}

impl Bench {
    /// A device with viscous damping alone, the strictest case.
    #[must_use]
    pub fn viscous(damping_n_s_m: f64, delay_ticks: u32) -> Self {
        Self {
            damping_n_s_m,
            coulomb_n: 0.0,
            position_step_m: 0.0,
            delay_ticks,
        }
    }

    /// The mechanics with which the runtime is configured.
    #[must_use]
    pub fn mechanics(&self) -> MechanicsConfig {
        MechanicsConfig {
            damping_n_s_m: self.damping_n_s_m as f32,
            coulomb_n: self.coulomb_n as f32,
            position_step_m: self.position_step_m as f32,
            delay_ticks: self.delay_ticks,
            ..Config::default().mechanics
        }
    }

    pub(super) fn absorber(&self) -> Absorber {
        Absorber {
            damping_n_s_m: self.damping_n_s_m,
            coulomb_n: self.coulomb_n,
        }
    }
}

/// A renderer that does not limit the wall, because it takes the device for heavily damped.
pub(super) fn as_given() -> Renderer {
    let mut config = Config::default();
    config.mechanics.damping_n_s_m = 1000.0;
    config.mechanics.coulomb_n = 1000.0;
    config.mechanics.delay_ticks = 0;
    Renderer::new(&config).expect("in range")
}

/// A renderer that knows the device's mechanics.
pub(super) fn told(mechanics: MechanicsConfig) -> Renderer {
    let config = Config {
        mechanics,
        ..Config::default()
    };
    Renderer::new(&config).expect("in range")
}
