//! Trials of a single fault during contact, and the response of the force.
//!
//! A trial is a servo loop without a clock: the device says when a period is over. It runs the same
//! on a simulated device, a vendor's library and USB.

use std::time::{Duration, Instant};

use asperity_runtime::{
    Config, ConfigError, Flags, HostTexture, Renderer, Sample, State, math::norm,
};
use serde::Serialize;

use super::{DeviceFaultInjector, InjectedFault};
use crate::device::supervised::{Plausible, Report, Supervised};
use crate::device::{Description, Device, DeviceError, Reading};
use crate::fault_plan::FaultPlan;

/// Periods of a fault. A clock step skips as many at once.
pub const LASTS: u32 = 20;
/// Periods in which everything must be well again.
pub const AFTER: u32 = 400;

/// Response to a fault. Periods are those of the loop.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct FaultResponse {
    /// Periods from the first one with the fault to the safe state; `None` if it never came.
    pub safe_after: Option<u32>,
    /// Periods from there to a fiftieth of the force: a ramp may have begun by then.
    pub zero_after: Option<u32>,
    /// Periods from the end of the fault to the whole force.
    pub whole_after: Option<u32>,
    /// The force before the fault, N.
    pub before_n: f32,
    /// The largest force, N.
    pub largest_n: f32,
    /// The largest change of the force that the device holds, N in a period.
    pub steepest_n: f32,
    /// Entries into the safe state.
    pub faults: u32,
    /// Fault reports.
    pub reports: u32,
    /// Periods with a fault that was not injected; any invalidates the row.
    pub disturbed: u32,
}

/// The periods from a fault to the safe state, if it comes.
#[must_use]
pub const fn promised(kind: InjectedFault) -> Option<u32> {
    match kind {
        // They look like a hand at rest.
        InjectedFault::Duplicate | InjectedFault::Stuck => None,
        // The jump shows in the period after it.
        InjectedFault::ClockStep => Some(1),
        // The first period still has its sample; the next two are held.
        InjectedFault::WriteFailed => Some(3),
        _ => Some(2),
    }
}

impl FaultResponse {
    /// The head of a Markdown table of [`FaultResponse::line`]s.
    pub const TABLE_HEAD: &str = "| fault | back end | force before, N | to the safe state | from there to 2 % of it | \
         back after the fault | steepest, N a period | safe state | reports |\n|---|---|---|---|---|---|---|---|---|\n";

    /// The row as a line of a Markdown table. A period is 1 ms.
    #[must_use]
    pub fn line(&self, kind: InjectedFault, back_end: &str) -> String {
        let periods =
            |count: Option<u32>| count.map_or("–".into(), |count| format!("{count} ms"));
        format!(
            "| {} | {back_end} | {:.2} | {} | {} | {} | {:.2} | {} | {} |\n",
            kind.name(),
            self.before_n,
            periods(self.safe_after),
            periods(self.zero_after),
            periods(self.whole_after),
            self.steepest_n,
            self.faults,
            self.reports
        )
    }

    /// Returns the first violated promise, in words. `peak_n` and `slew_n` (per period) are the limits.
    #[must_use]
    pub fn broken(&self, kind: InjectedFault, peak_n: f32, slew_n: f32) -> Option<&'static str> {
        let safe = u32::from(self.safe_after.is_some());
        // A clock step is no fault of the device.
        let told = if kind == InjectedFault::ClockStep {
            0
        } else {
            safe
        };
        let steps = (peak_n / slew_n).ceil() as u32;
        if self.safe_after != promised(kind) {
            Some("the safe state comes at another time than promised")
        } else if (self.faults, self.reports) != (safe, told) {
            Some("a fault is entered once and told once")
        // The period after a clock step is sound, so the ramp may begin before the force is gone.
        } else if (kind != InjectedFault::ClockStep && self.zero_after.is_some() != (safe == 1))
            || self.zero_after.is_some_and(|periods| periods > steps)
        {
            Some("the force is gone within the steps that the slew limit asks for")
        } else if self.whole_after.is_none() {
            Some("the force comes back")
        } else if self.steepest_n > slew_n * (1.0 + 1e-5) || self.largest_n > peak_n * (1.0 + 1e-5)
        {
            Some("no force is beyond a limit")
        } else {
            None
        }
    }
}

/// A trial.
#[derive(Debug, Clone, Copy)]
pub struct Trial<'a> {
    /// Texture to render.
    pub texture: &'a HostTexture,
    /// The renderer's configuration.
    pub config: &'a Config,
    /// Periods before the fault.
    pub warm_up: u32,
    /// Seed of the excitation.
    pub seed: u64,
}

impl Trial<'_> {
    /// Runs one fault on a device; `each` is called before each period, counted from 0. At the end
    /// the force is zero.
    ///
    /// # Errors
    /// A configuration that the renderer refuses.
    pub fn run<D: Device>(
        &self,
        device: D,
        kind: InjectedFault,
        mut each: impl FnMut(u32),
    ) -> Result<FaultResponse, ConfigError> {
        let renderer = Renderer::new(self.config)?;
        let mut state = State::new(self.seed);
        let faulty = DeviceFaultInjector::new(device, FaultPlan::default(), 1);
        let mut device = Supervised::new(faulty, self.config, Plausible::default());
        let lasts = if kind == InjectedFault::ClockStep {
            1
        } else {
            LASTS
        };
        let mut row = FaultResponse::default();
        let mut entered = 0;
        let mut held = [0.0; 3];
        for n in 0..self.warm_up + lasts + AFTER {
            each(n);
            if n == self.warm_up {
                device.device_mut().start(kind, LASTS);
                entered = state.counters().faults;
                held = device.held_n();
            }
            // A clock that jumps in this reading shows up in the next period.
            let periods = 1 + device.device_mut().take_clock_step();
            let seen = device.read(periods);
            let output = renderer.tick(self.texture, &mut state, &seen.sample);
            // What failed shows in the next reading.
            let _ = device.write(output.force_n);
            if device.wants_recovery() {
                // A device that is still away is asked again in the next period.
                let _ = device.recover();
            }
            let force_n = norm(output.force_n);
            if n < self.warm_up {
                row.before_n = force_n;
                row.disturbed += u32::from(seen.fault.is_some());
                continue;
            }
            let since = n - self.warm_up;
            // What was written last in the fault fails one reading later.
            row.disturbed += u32::from(seen.fault.is_some() && since > lasts);
            let now = device.held_n();
            if device.device().running() != Some(InjectedFault::Unplugged) {
                let step = norm(std::array::from_fn(|axis| now[axis] - held[axis]));
                row.steepest_n = larger(row.steepest_n, step);
            }
            held = now;
            row.largest_n = larger(row.largest_n, norm(now));
            row.note(output.flags, seen.report, since, lasts, force_n);
        }
        row.faults = state.counters().faults - entered;
        release(&mut device, &renderer, self.texture, &mut state);
        Ok(row)
    }
}

impl FaultResponse {
    fn note(&mut self, flags: Flags, report: Option<Report>, since: u32, lasts: u32, force_n: f32) {
        let safe = flags.contains(Flags::SAFE_STATE);
        if safe && self.safe_after.is_none() {
            self.safe_after = Some(since);
        }
        if let Some(after) = self.safe_after
            && force_n <= 0.02 * self.before_n
            && self.zero_after.is_none()
        {
            self.zero_after = Some(since - after);
        }
        if since >= lasts && !safe && !flags.contains(Flags::RAMPING) && self.whole_after.is_none()
        {
            self.whole_after = Some(since - lasts);
        }
        self.reports += u32::from(matches!(report, Some(Report::Began(_))));
    }
}

/// Takes the force to zero.
fn release<D: Device>(
    device: &mut Supervised<D>,
    renderer: &Renderer,
    texture: &HostTexture,
    state: &mut State,
) {
    // More than any peak takes at any slew limit of a device.
    for _ in 0..1000 {
        let output = renderer.tick(texture, state, &Sample::STALE);
        // A device that takes nothing is not helped by more.
        if device.write(output.force_n).is_err() || output.force_n == [0.0; 3] {
            return;
        }
    }
}

fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// A device whose periods are its own answers, with the surface of the texture above where it was
/// at first.
pub struct Paced<D> {
    device: D,
    /// Added to the z of a position, m.
    shift_m: f32,
    patience: Duration,
}

impl<D: Device> Paced<D> {
    /// Waits for the first position, and has the surface lie `depth_m` above it.
    ///
    /// # Errors
    /// The last fault where no position came within `patience`.
    pub fn begin(mut device: D, depth_m: f32, patience: Duration) -> Result<Self, DeviceError> {
        let begun = Instant::now();
        loop {
            let fault = match device.read() {
                Ok(reading) if reading.fresh => {
                    return Ok(Self {
                        device,
                        shift_m: -depth_m - reading.position_m[2],
                        patience: Duration::from_secs(2),
                    });
                }
                Ok(_) => DeviceError::TimedOut,
                Err(fault) => fault,
            };
            if begun.elapsed() > patience {
                return Err(fault);
            }
            // Some devices answer commands alone.
            let _ = device.write([0.0; 3]);
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

impl<D: Device> Device for Paced<D> {
    fn description(&self) -> &Description {
        self.device.description()
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        let asked = Instant::now();
        loop {
            let reading = self.device.read()?;
            if reading.fresh || asked.elapsed() > self.patience {
                let [x, y, z] = reading.position_m;
                return Ok(Reading {
                    position_m: [x, y, z + self.shift_m],
                    ..reading
                });
            }
            std::thread::sleep(Duration::from_micros(100));
        }
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.device.write(force_n)
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        self.device.recover()
    }
}
