//! A texture on a device for a number of ticks, and what became of every one of them.
//!
//! It is no servo loop: it sleeps between ticks as well as the system lets it. It shows whether a
//! device works, and that no fault of it makes a force beyond the limits.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use asperity_runtime::{Config, HostTexture, MechanicsConfig, Output, Renderer, Sample, State};
use serde::Serialize;

use super::{Description, Device, DeviceError};

/// Time that a device has for its answer where the ticks wait for it.
const ANSWER: Duration = Duration::from_millis(50);

/// Parameters of an exercise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// Ticks.
    pub ticks: u32,
    /// Tick rate, Hz; 0 waits for an answer of the device in each tick.
    pub rate_hz: f64,
    /// The mechanics of the device.
    pub mechanics: MechanicsConfig,
    /// Largest force, N; the device's limit if that is less.
    pub peak_n: f32,
    /// Seed of the texture's excitation.
    pub seed: u64,
    /// Recovery attempts for a lost device, each up to 0.1 s.
    pub patience: u32,
}

impl Plan {
    /// The configuration of the renderer for a device.
    #[must_use]
    pub fn config(&self, device: &Description) -> Config {
        let mut config = Config {
            mechanics: self.mechanics,
            ..Config::default()
        };
        let most = device.peak_force_n;
        config.limits.peak_n = if self.peak_n < most {
            self.peak_n
        } else {
            most
        };
        config
    }
}

/// Statistics of an exercise.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Report {
    /// Ticks.
    pub ticks: u32,
    /// Ticks with a position that the device had just measured.
    pub fresh: u32,
    /// Ticks with an older one.
    pub stale: u32,
    /// Ticks without one, by the fault.
    pub faults: BTreeMap<String, u32>,
    /// Commands that the device did not take.
    pub lost_writes: u32,
    /// Times that a device was lost and came back.
    pub recovered: u32,
    /// True if it was lost for good.
    pub lost: bool,
    /// Ticks in contact.
    pub contact: u32,
    /// Ticks in the safe state.
    pub safe: u32,
    /// Largest force that was commanded, N.
    pub largest_force_n: f32,
    /// Largest change of the commanded force in a tick, N.
    pub largest_step_n: f32,
    /// Commands beyond the peak or the slew limit.
    pub beyond_limits: u32,
    /// Largest force that may be, N.
    pub peak_n: f32,
    /// Largest change in a tick that may be, N.
    pub step_n: f32,
    /// Time that it took, s.
    pub seconds: f64,
}

/// Runs a texture on a device. `each` sees what the renderer was given and what it answered, in every
/// tick, those included that let go of the force while the device is away.
///
/// # Errors
/// A configuration that the renderer refuses.
pub fn exercise(
    device: &mut dyn Device,
    texture: &HostTexture,
    plan: &Plan,
    mut each: impl FnMut(&Sample, &Output),
) -> Result<Report, asperity_runtime::config::ConfigError> {
    let config = plan.config(device.description());
    let renderer = Renderer::new(&config)?;
    let mut state = State::new(plan.seed);
    let mut report = Report {
        peak_n: config.limits.peak_n,
        step_n: config.limits.slew_n_s / config.servo_rate_hz,
        ..Report::default()
    };
    let begun = Instant::now();
    let mut due = begun;
    let mut before = [0.0; 3];
    let mut missed = 0;
    while report.ticks < plan.ticks {
        if plan.rate_hz > 0.0 {
            due += Duration::from_secs_f64(1.0 / plan.rate_hz);
            std::thread::sleep(due.saturating_duration_since(Instant::now()));
        }
        report.ticks += 1;
        let mut read = device.read();
        if plan.rate_hz <= 0.0 {
            let asked = Instant::now();
            while matches!(read, Ok(reading) if !reading.fresh) && asked.elapsed() < ANSWER {
                std::thread::sleep(Duration::from_micros(100));
                read = device.read();
            }
        }
        let sample = match &read {
            Ok(reading) if reading.fresh => {
                report.fresh += 1;
                let elapsed_ticks = 1 + std::mem::take(&mut missed);
                Sample {
                    position_m: reading.position_m,
                    elapsed_ticks,
                }
            }
            Ok(_) => {
                report.stale += 1;
                missed += 1;
                Sample::STALE
            }
            Err(fault) => {
                *report.faults.entry(fault.to_string()).or_default() += 1;
                missed += 1;
                Sample::STALE
            }
        };
        let output = renderer.tick(texture, &mut state, &sample);
        each(&sample, &output);
        report.contact += u32::from(output.flags.contains(asperity_runtime::Flags::CONTACT));
        report.safe += u32::from(output.flags.contains(asperity_runtime::Flags::SAFE_STATE));
        report.see(output.force_n, &mut before);
        let written = device.write(output.force_n);
        report.lost_writes += u32::from(written.is_err());
        if let Err(fault) = read
            && away(fault)
        {
            let gone = Instant::now();
            // The force goes to zero before anybody waits.
            while before != [0.0; 3] {
                let output = renderer.tick(texture, &mut state, &Sample::STALE);
                each(&Sample::STALE, &output);
                report.see(output.force_n, &mut before);
                let _ = device.write(output.force_n);
            }
            if !(0..plan.patience).any(|_| came_back(device)) {
                report.lost = true;
                break;
            }
            report.recovered += 1;
            // The hand moved on meanwhile.
            missed = (gone.elapsed().as_secs_f32() * config.servo_rate_hz) as u32;
            due = Instant::now();
        }
    }
    report.seconds = begun.elapsed().as_secs_f64();
    Ok(report)
}

/// Returns true for faults that waiting for the next tick does not clear.
fn away(fault: DeviceError) -> bool {
    matches!(
        fault,
        DeviceError::Disconnected | DeviceError::TimedOut | DeviceError::NotCalibrated
    )
}

fn came_back(device: &mut dyn Device) -> bool {
    device.recover().is_ok() || {
        std::thread::sleep(Duration::from_millis(20));
        false
    }
}

impl Report {
    fn see(&mut self, force_n: [f32; 3], before: &mut [f32; 3]) {
        let size = |v: [f32; 3]| libm::sqrtf(v.iter().map(|x| x * x).sum());
        let step = size(std::array::from_fn(|n| force_n[n] - before[n]));
        let force = size(force_n);
        // Rounding of the limiter's division.
        let beyond = force > self.peak_n * 1.000_01 || step > self.step_n * 1.000_01;
        // NaN is beyond as well.
        self.beyond_limits += u32::from(beyond || !force.is_finite());
        if force > self.largest_force_n {
            self.largest_force_n = force;
        }
        if step > self.largest_step_n {
            self.largest_step_n = step;
        }
        *before = force_n;
    }
}
