//! Calibrating a device: a sweep of force, the acceleration that follows, and a profile made of
//! both.
//!
//! A table holds one row a servo period: `t_s,force_n,accel_m_s2`, the force that was commanded and
//! the acceleration of the tip along it. A user records one with an accelerometer; [`simulate`]
//! computes one for the simulated device, with the stylus held by a weak spring and by no hand.

mod chart;
mod error;
mod plausible;
mod table;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use asperity_host::profile::compensation::{self, Design};
use asperity_host::profile::response::{self, Response};
use asperity_host::profile::sweep::Sweep;
use asperity_host::profile::{FIELDS, ForceLimits, Mechanics, Profile, Timing};

use asperity_sim::axis::Pull;
use asperity_sim::device::{Device, DeviceConfig};

pub use chart::draw;
pub use error::CalibrationError;
pub use plausible::{doubts, median_gain};

/// Least coherence of a measurement that makes a filter.
pub const LEAST_COHERENCE: f64 = 0.5;

/// Constraint on the stylus of a simulated measurement: a weak spring, and no hand.
pub const HELD: Pull = Pull {
    stiffness_n_m: 20.0,
    damping_n_s_m: 0.2,
    target_m: 0.0,
    target_m_s: 0.0,
    force_n: 0.0,
};

/// A commanded force and the acceleration that followed.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Servo rate, Hz.
    pub rate_hz: f64,
    /// Force of every period, N.
    pub force_n: Vec<f64>,
    /// Mean acceleration within every period, m/s².
    pub accel_m_s2: Vec<f64>,
}

/// Plays a sweep on the simulated device, along x.
#[must_use]
pub fn simulate(config: &DeviceConfig, sweep: &Sweep) -> Measured {
    let tick_s = 1.0 / sweep.rate_hz;
    let mut device = Device::new(config, 0.0, [0.0; 3]);
    let force_n = sweep.force_n();
    let accel_m_s2 = force_n.iter().map(|&force_n| {
        let before_m_s = device.velocity_m_s()[0];
        device.command([force_n, 0.0, 0.0]);
        device.advance(tick_s, |_, _| [HELD; 3]);
        (device.velocity_m_s()[0] - before_m_s) / tick_s
    });
    Measured {
        rate_hz: sweep.rate_hz,
        accel_m_s2: accel_m_s2.collect(),
        force_n,
    }
}

impl Measured {
    /// Estimates the response, and makes the filter.
    ///
    /// # Errors
    /// [`CalibrationError::Response`], and [`CalibrationError::Coherence`] below
    /// [`LEAST_COHERENCE`]; `file` names the table.
    pub fn fit(&self, file: &str) -> Result<(Response, Design), CalibrationError> {
        let response = response::estimate(&self.force_n, &self.accel_m_s2, self.rate_hz);
        let response = response.map_err(|cause| CalibrationError::Response {
            file: file.into(),
            cause,
        })?;
        let (low, high) = response::BAND_HZ;
        let band = response
            .points
            .iter()
            .filter(|point| (low..=high).contains(&point.freq_hz));
        let worst = band.min_by(|a, b| a.coherence.total_cmp(&b.coherence));
        if let Some(point) = worst.filter(|point| point.coherence < LEAST_COHERENCE) {
            return Err(CalibrationError::Coherence {
                file: file.into(),
                found: point.coherence,
                freq_hz: point.freq_hz,
            });
        }
        let design = compensation::design(&response);
        Ok((response, design))
    }
}

/// A profile of the simulated device, before it is measured. A simulation confirms nothing.
#[must_use]
pub fn profile_of(config: &DeviceConfig) -> Profile {
    let least = |values: [f64; 3]| values.into_iter().fold(f64::INFINITY, f64::min) as f32;
    Profile {
        name: config.name.clone(),
        unconfirmed: FIELDS.map(str::to_owned).to_vec(),
        limits: ForceLimits {
            peak_n: config.actuator.peak_force_n as f32,
            continuous_n: config.actuator.continuous_force_n as f32,
            slew_n_s: asperity_runtime::Config::default().limits.slew_n_s,
        },
        mechanics: Mechanics {
            mass_kg: least(config.mechanics.mass_kg),
            damping_n_s_m: least(config.mechanics.damping_n_s_m),
            coulomb_n: least(config.mechanics.coulomb_n),
            position_step_mm: config.sensor.position_step_mm as f32,
        },
        timing: Timing {
            delay_ticks: config.timing.transport_delay_ticks as u32,
        },
        compensation: None,
    }
}

/// Reads a profile to begin with, or takes that of the simulated Touch.
///
/// # Errors
/// [`CalibrationError::Profile`].
pub fn base(path: Option<&PathBuf>, simulated: &DeviceConfig) -> Result<Profile, CalibrationError> {
    match path {
        Some(path) => Ok(Profile::load(path)?),
        None => Ok(profile_of(simulated)),
    }
}
