//! A device as the tick sees it: readings become samples, and faults become the safe state.
//!
//! A period is [`Supervised::read`], the tick, [`Supervised::write`]. What the device could not
//! give is a stale sample, so that the runtime's gate holds the last good one twice and then lets
//! the force go. A force that did not arrive makes the next samples stale too: the device holds an
//! old force, and what is rendered would build on one that nobody felt. When forces arrive again,
//! the first ones stay within the slew limit of the one that the device really held.
//!
//! Nothing here reads a clock, allocates or waits, apart from [`Supervised::recover`].

use asperity_runtime::{Config, Sample, math::norm};

use super::{Device, DeviceError, Reading};

/// Positions that a hand on a desk can have. Others are damage, and count as
/// [`DeviceError::Garbled`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plausible {
    /// The farthest coordinate, m.
    pub reach_m: f32,
    /// The fastest hand, m/s.
    pub fastest_m_s: f32,
}

impl Default for Plausible {
    fn default() -> Self {
        Self {
            reach_m: 1.0,
            fastest_m_s: 10.0,
        }
    }
}

/// Outcome of the read at the start of a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadOutcome {
    /// Sample for the tick.
    pub sample: Sample,
    /// Pressed buttons.
    pub buttons: u32,
    /// Fault in this period.
    pub fault: Option<DeviceError>,
    /// Report to the user, once per fault however long it lasts.
    pub report: Option<Report>,
}

/// Start or end of a device fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Report {
    /// A fault began.
    Began(DeviceError),
    /// The fault ended.
    Ended {
        /// First error of the fault.
        fault: DeviceError,
        /// Duration, periods.
        periods: u32,
    },
}

/// Statistics so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DeviceStats {
    /// Periods.
    pub periods: u64,
    /// Missed periods.
    pub missed: u64,
    /// Readings that failed, implausible ones included.
    pub read_faults: u64,
    /// Readings that were not fresh.
    pub stale: u64,
    /// Forces that did not arrive.
    pub write_faults: u64,
    /// Forces that were brought closer to what the device held.
    pub eased: u64,
    /// Faults, each counted once however long it lasts.
    pub episodes: u64,
    /// Successful recoveries by [`Device::recover`].
    pub recoveries: u64,
}

/// Readings in a row that are not fresh, and no fault yet.
const MAX_STALE_READS: u32 = 2;

/// A device with its faults under control.
#[derive(Debug)]
pub struct Supervised<D> {
    device: D,
    plausible: Plausible,
    period_s: f32,
    /// The largest change of force in a period, N.
    slew_n: f32,
    /// Periods since the last sample that was good.
    since: u32,
    last: Option<Reading>,
    /// Faults of the last reading and of the last write.
    read_fault: Option<DeviceError>,
    write_fault: Option<DeviceError>,
    quiet: u32,
    /// First error of the current fault, and its duration so far, periods.
    episode: Option<(DeviceError, u32)>,
    /// Last force requested, and last force accepted by the device, N.
    wanted_n: [f32; 3],
    held_n: [f32; 3],
    tally: DeviceStats,
}

impl<D: Device> Supervised<D> {
    /// Takes a device; rate and slew limit are those of the renderer.
    pub fn new(device: D, config: &Config, plausible: Plausible) -> Self {
        let period_s = 1.0 / config.servo_rate_hz;
        Self {
            device,
            plausible,
            period_s,
            slew_n: config.limits.slew_n_s * period_s,
            since: 0,
            last: None,
            read_fault: None,
            write_fault: None,
            quiet: 0,
            episode: None,
            wanted_n: [0.0; 3],
            held_n: [0.0; 3],
            tally: DeviceStats::default(),
        }
    }

    /// The device.
    pub fn device(&self) -> &D {
        &self.device
    }

    /// The device.
    pub fn device_mut(&mut self) -> &mut D {
        &mut self.device
    }

    /// Returns the statistics so far.
    pub fn tally(&self) -> DeviceStats {
        self.tally
    }

    /// The force that the device took last, N.
    pub fn held_n(&self) -> [f32; 3] {
        self.held_n
    }

    /// Begins a period. `periods` passed since the last call by the loop's clock: 1 in a healthy
    /// loop.
    pub fn read(&mut self, periods: u32) -> ReadOutcome {
        self.tally.periods += 1;
        self.tally.missed += u64::from(periods.saturating_sub(1));
        self.since = self.since.saturating_add(periods);
        let read = self
            .device
            .read()
            .and_then(|reading| self.plausible(reading));
        self.read_fault = read.err();
        self.tally.read_faults += u64::from(read.is_err());
        let fresh = read.ok().filter(|reading| reading.fresh);
        self.quiet = if fresh.is_some() {
            0
        } else {
            self.quiet.saturating_add(1)
        };
        self.tally.stale += u64::from(read.is_ok_and(|reading| !reading.fresh));
        let silence = (self.quiet > MAX_STALE_READS).then_some(DeviceError::TimedOut);
        let fault = self.write_fault.or(self.read_fault).or(silence);
        let sample = match fresh.filter(|_| fault.is_none()) {
            Some(reading) => {
                let elapsed_ticks = std::mem::take(&mut self.since);
                Sample {
                    position_m: reading.position_m,
                    elapsed_ticks,
                }
            }
            None => Sample::STALE,
        };
        if let Some(reading) = fresh {
            self.last = Some(reading);
        }
        ReadOutcome {
            sample,
            buttons: self.last.map_or(0, |reading| reading.buttons),
            fault,
            report: self.report(fault, fresh.is_some()),
        }
    }

    /// Rejects a reading that no hand can produce.
    fn plausible(&self, reading: Reading) -> Result<Reading, DeviceError> {
        let Plausible {
            reach_m,
            fastest_m_s,
        } = self.plausible;
        // The longer nothing good came, the farther the hand may be.
        let way_m = fastest_m_s * self.period_s * self.since.max(1) as f32;
        let near = |axis: usize| {
            self.last.is_none_or(|last| {
                (reading.position_m[axis] - last.position_m[axis]).abs() <= way_m
            })
        };
        let good = (0..3).all(|axis| reading.position_m[axis].abs() <= reach_m && near(axis));
        if good {
            Ok(reading)
        } else {
            Err(DeviceError::Garbled)
        }
    }

    /// The first and the last period of a fault are news.
    fn report(&mut self, fault: Option<DeviceError>, fresh: bool) -> Option<Report> {
        match (self.episode, fault) {
            (None, Some(fault)) => {
                self.episode = Some((fault, 1));
                self.tally.episodes += 1;
                Some(Report::Began(fault))
            }
            (Some((first, periods)), None) if fresh => {
                self.episode = None;
                Some(Report::Ended {
                    fault: first,
                    periods,
                })
            }
            (Some((first, periods)), _) => {
                self.episode = Some((first, periods.saturating_add(1)));
                None
            }
            (None, None) => None,
        }
    }

    /// Ends a period with a force, N.
    ///
    /// # Errors
    /// [`DeviceError`]: the force did not arrive. The next period begins with a stale sample.
    pub fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.wanted_n = force_n;
        let eased = self.eased(force_n);
        self.tally.eased += u64::from(eased != force_n);
        let wrote = self.device.write(eased);
        self.write_fault = wrote.err();
        match wrote {
            Ok(()) => self.held_n = eased,
            Err(fault) => {
                self.tally.write_faults += 1;
                if fault == DeviceError::Disconnected {
                    // It has no power, so it holds no force.
                    self.held_n = [0.0; 3];
                }
            }
        }
        wrote
    }

    /// A force no farther from the one that the device holds than the slew limit allows.
    fn eased(&self, force_n: [f32; 3]) -> [f32; 3] {
        let way: [f32; 3] = std::array::from_fn(|axis| force_n[axis] - self.held_n[axis]);
        let length = norm(way);
        // The runtime keeps the limit itself, but for rounding, so its forces pass as they are.
        if length <= self.slew_n * (1.0 + 1e-5) {
            return force_n;
        }
        if !length.is_finite() {
            return self.eased([0.0; 3]);
        }
        let part = self.slew_n / length;
        std::array::from_fn(|axis| self.held_n[axis] + part * way[axis])
    }

    /// Returns true if the device should be recovered now: its last call failed and zero force is
    /// requested.
    pub fn wants_recovery(&self) -> bool {
        let failed = self.read_fault.or(self.write_fault).is_some();
        failed && self.wanted_n == [0.0; 3]
    }

    /// Tries to bring the device back. It may take its time; call it between periods.
    ///
    /// # Errors
    /// [`DeviceError`] while the device is still away.
    pub fn recover(&mut self) -> Result<(), DeviceError> {
        self.device.recover()?;
        self.tally.recoveries += 1;
        Ok(())
    }
}
