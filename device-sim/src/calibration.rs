//! Calibrating a device: a sweep of force, the acceleration that follows, and a profile made of
//! both.
//!
//! A table holds one row a servo period: `t_s,force_n,accel_m_s2`, the force that was commanded and
//! the acceleration of the tip along it. A user records one with an accelerometer; [`simulate`]
//! makes one of the simulated device, with the stylus held by a weak spring and by no hand.

use std::path::{Path, PathBuf};

use asperity::diagnostic::Diagnostic;
use asperity::input::{self, InputError, Kind};
use asperity_host::profile::compensation::{self, Design};
use asperity_host::profile::response::{self, Response, ResponseError};
use asperity_host::profile::sweep::Sweep;
use asperity_host::profile::{FIELDS, ForceLimits, Mechanics, Profile, ProfileError, Timing};

use crate::axis::Pull;
use crate::device::{Device, DeviceConfig};

/// The columns of a table.
const COLUMNS: [&str; 3] = ["t_s", "force_n", "accel_m_s2"];

/// Least coherence of a measurement that makes a filter.
pub const LEAST_COHERENCE: f64 = 0.5;

/// Why a device cannot be calibrated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// The table cannot be read.
    #[error(transparent)]
    Read(#[from] InputError),
    /// The table is none.
    #[error("{file}:{line}: {what}")]
    Table {
        /// The file.
        file: String,
        /// The line, from 1.
        line: u64,
        /// What is wrong.
        what: String,
    },
    /// The times do not advance evenly.
    #[error("{file}:{line}: t_s = {found} after a period of {period_s} s")]
    Time {
        /// The file.
        file: String,
        /// The line, from 1.
        line: u64,
        /// What was found.
        found: f64,
        /// The period of the first rows, s.
        period_s: f64,
    },
    /// No response can be estimated.
    #[error("{file}: {cause}")]
    Response {
        /// The file.
        file: String,
        /// Why.
        cause: ResponseError,
    },
    /// The acceleration does not follow from the force.
    #[error(
        "{file}: the acceleration follows from the force by {found:.2} only (coherence at {freq_hz:.0} Hz)"
    )]
    Coherence {
        /// The file.
        file: String,
        /// The least coherence.
        found: f64,
        /// Where.
        freq_hz: f64,
    },
    /// The profile to begin with is refused.
    #[error(transparent)]
    Profile(#[from] ProfileError),
}

impl Diagnostic for CalibrationError {
    fn remedy(&self) -> String {
        match self {
            Self::Read(error) => error.remedy(),
            Self::Table { .. } => format!("write the columns {} and a row a servo period", COLUMNS.join(",")),
            Self::Time { .. } => "write every servo period, each once, in order".into(),
            Self::Response { cause, .. } => cause.remedy().into(),
            Self::Coherence { .. } => {
                "fasten the accelerometer, hold the stylus by a thread or a weak spring, and raise the amplitude".into()
            }
            Self::Profile(error) => error.remedy().into(),
        }
    }
}

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
    let held = Pull {
        stiffness_n_m: 20.0,
        damping_n_s_m: 0.2,
        ..Pull::default()
    };
    let accel_m_s2 = force_n.iter().map(|&force_n| {
        let before_m_s = device.velocity_m_s()[0];
        device.command([force_n, 0.0, 0.0]);
        device.advance(tick_s, |_, _| [held; 3]);
        (device.velocity_m_s()[0] - before_m_s) / tick_s
    });
    Measured {
        rate_hz: sweep.rate_hz,
        accel_m_s2: accel_m_s2.collect(),
        force_n,
    }
}

impl Measured {
    /// The table as a file.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let mut text = COLUMNS.join(",") + "\n";
        for (n, (force, accel)) in self.force_n.iter().zip(&self.accel_m_s2).enumerate() {
            text += &format!("{},{force},{accel}\n", n as f64 / self.rate_hz);
        }
        text
    }

    /// Reads a table.
    ///
    /// # Errors
    /// [`CalibrationError`] with file and line.
    pub fn load(path: &Path) -> Result<Self, CalibrationError> {
        let text = input::read_text(path, Kind::Trajectory).map_err(|problem| InputError {
            file: path.to_path_buf(),
            problem,
        })?;
        Self::from_csv(&text, &path.display().to_string())
    }

    /// Parses a table; `file` names it in errors.
    ///
    /// # Errors
    /// [`CalibrationError`] with file and line.
    pub fn from_csv(text: &str, file: &str) -> Result<Self, CalibrationError> {
        let table = |line, what: String| CalibrationError::Table {
            file: file.into(),
            line,
            what,
        };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let head = reader
            .headers()
            .map_err(|error| table(1, error.to_string()))?;
        if !head.iter().eq(COLUMNS) {
            let found: Vec<&str> = head.iter().collect();
            return Err(table(
                1,
                format!("columns {}, not {}", found.join(","), COLUMNS.join(",")),
            ));
        }
        let (mut times_s, mut force_n, mut accel_m_s2) = (Vec::new(), Vec::new(), Vec::new());
        for record in reader.records() {
            let record = record.map_err(|error| {
                let line = error.position().map_or(0, csv::Position::line);
                table(line, error.to_string())
            })?;
            let line = record.position().map_or(0, csv::Position::line);
            for (column, values) in [&mut times_s, &mut force_n, &mut accel_m_s2]
                .into_iter()
                .enumerate()
            {
                let cell = record.get(column).unwrap_or_default();
                let value: Option<f64> = cell.parse().ok().filter(|value: &f64| value.is_finite());
                values.push(value.ok_or_else(|| {
                    table(line, format!("{} = `{cell}` is no number", COLUMNS[column]))
                })?);
            }
            even(&times_s).map_err(|period_s| CalibrationError::Time {
                file: file.into(),
                line,
                found: times_s.last().copied().unwrap_or_default(),
                period_s,
            })?;
        }
        let [first, second, ..] = times_s[..] else {
            return Err(table(2, "no two rows".into()));
        };
        let spanned_s = times_s.last().copied().unwrap_or(second) - first;
        Ok(Self {
            rate_hz: (times_s.len() - 1) as f64 / spanned_s,
            force_n,
            accel_m_s2,
        })
    }

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

/// Whether the last time follows after the period of the first two; the period where it does not.
fn even(times_s: &[f64]) -> Result<(), f64> {
    let (&[first, second, ..], &[.., before, last]) = (times_s, times_s) else {
        return Ok(());
    };
    let period_s = second - first;
    if period_s > 0.0 && ((last - before) / period_s - 1.0).abs() < 0.5 {
        Ok(())
    } else {
        Err(period_s)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Simulated devices whose masses differ by four either way: ±12 dB of acceleration.
    fn devices() -> [DeviceConfig; 3] {
        let touch = DeviceConfig::touch().expect("built-in file");
        [0.25, 1.0, 4.0].map(|factor| {
            let mut device = touch.clone();
            device.mechanics.mass_kg = touch.mechanics.mass_kg.map(|kg| factor * kg);
            device.mechanics.coulomb_n = [0.02; 3];
            device.timing.transport_delay_ticks = if factor < 1.0 { 2 } else { 0 };
            device
        })
    }

    fn sweep() -> Sweep {
        Sweep::standard(1000.0, 1.0)
    }

    #[test]
    fn three_simulated_devices_that_differ_by_12_db_agree_within_3_db() {
        for device in devices() {
            let measured = simulate(&device, &sweep());
            let (response, design) = measured.fit("simulated").expect("a fit");
            let mass_kg = device.mechanics.mass_kg[0];
            println!(
                "{mass_kg} kg: {:.1} dB before, {:.2} dB after",
                design.before_db, design.after_db
            );
            assert!(design.after_db < 3.0, "{design:?}");
            if (mass_kg - 0.045).abs() > 1e-6 {
                assert!(design.before_db > 10.0, "{design:?}");
            }
            let delay_s = 1e-3 * device.timing.transport_delay_ticks as f64;
            assert!(
                (response.delay_s - delay_s).abs() < 0.5e-3,
                "{}",
                response.delay_s
            );

            // Played through the filter, the simulated device has the reference's spectrum.
            let taps: Vec<f64> = design
                .filter
                .taps
                .iter()
                .map(|&tap| f64::from(tap))
                .collect();
            let force = sweep().force_n();
            let filtered: Vec<f64> = (0..force.len())
                .map(|n| {
                    (0..taps.len().min(n + 1))
                        .map(|k| taps[k] * force[n - k])
                        .sum()
                })
                .collect();
            let mut machine = Device::new(&device, 0.0, [0.0; 3]);
            let accel: Vec<f64> = filtered
                .iter()
                .map(|&force_n| {
                    let before = machine.velocity_m_s()[0];
                    machine.command([force_n, 0.0, 0.0]);
                    machine.advance(1e-3, |_, _| {
                        [Pull {
                            stiffness_n_m: 20.0,
                            damping_n_s_m: 0.2,
                            ..Pull::default()
                        }; 3]
                    });
                    (machine.velocity_m_s()[0] - before) * 1e3
                })
                .collect();
            let again = response::estimate(&force, &accel, 1000.0).expect("a response");
            for point in again
                .points
                .iter()
                .filter(|point| (40.0..=400.0).contains(&point.freq_hz))
            {
                let off_db = 20.0 * libm::log10(point.gain_m_s2_n / compensation::REFERENCE_M_S2_N);
                assert!(
                    off_db.abs() < 3.0,
                    "{mass_kg} kg: {off_db:.2} dB at {:.0} Hz",
                    point.freq_hz
                );
            }
        }
    }

    #[test]
    fn a_table_reads_back_and_bad_ones_are_named() {
        let short = Sweep {
            seconds: 0.2,
            ..sweep()
        };
        let measured = simulate(&devices()[1], &short);
        let again = Measured::from_csv(&measured.to_csv(), "a.csv").expect("a table");
        assert_eq!(
            (&again.force_n, &again.accel_m_s2),
            (&measured.force_n, &measured.accel_m_s2)
        );
        assert!((again.rate_hz - 1000.0).abs() < 1e-6);
        for (text, named) in [
            ("", "a.csv:1"),
            ("t,f,a\n", "columns t,f,a"),
            ("t_s,force_n,accel_m_s2\n0,0,0\n", "no two rows"),
            (
                "t_s,force_n,accel_m_s2\n0,0,0\n0.001,x,0\n",
                "force_n = `x`",
            ),
            (
                "t_s,force_n,accel_m_s2\n0,0,0\n0.001,0,nan\n",
                "accel_m_s2 = `nan`",
            ),
            ("t_s,force_n,accel_m_s2\n0,0,0\n0.001,0\n", "a.csv:3"),
            (
                "t_s,force_n,accel_m_s2\n0,0,0\n0.001,0,0\n0.005,0,0\n",
                "t_s = 0.005",
            ),
            ("t_s,force_n,accel_m_s2\n0,0,0\n0,0,0\n", "t_s = 0"),
        ] {
            let error = Measured::from_csv(text, "a.csv").expect_err(named);
            assert!(error.to_string().contains(named), "{error}");
            assert!(!error.remedy().is_empty());
        }
        let error = again.fit("a.csv").expect_err("too short");
        assert!(error.to_string().contains("too few"), "{error}");
    }

    #[test]
    fn a_profile_of_a_simulation_says_that_nothing_in_it_is_confirmed() {
        let profile = profile_of(&devices()[1]);
        assert_eq!(profile.unconfirmed, FIELDS);
        assert!(Profile::from_toml(&profile.to_toml(), "simulated.toml").is_ok());
    }

    #[test]
    fn an_accelerometer_that_fell_off_makes_no_profile() {
        let mut measured = simulate(&devices()[1], &sweep());
        let mut random = 1_u64;
        for accel in &mut measured.accel_m_s2 {
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            *accel = (random >> 40) as f64;
        }
        let error = measured.fit("a.csv").expect_err("noise");
        assert!(
            matches!(error, CalibrationError::Coherence { .. }),
            "{error}"
        );
    }
}
