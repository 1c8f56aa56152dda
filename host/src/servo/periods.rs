//! The servo loop: one tick a period, on absolute times.
//!
//! ```text
//! sleep until due → read → sample → render → write → record
//! ```
//!
//! The device is [`Supervised`]: what it does not give is a stale sample, and a force after ones that
//! did not arrive stays within the slew limit of the one that it holds.
//!
//! Between two sleeps the loop neither allocates, locks nor prints. Only [`Device::recover`] may:
//! it runs while the device is away and the force is zero, and the periods that it takes are
//! counted apart.

use super::{
    clock::Clock,
    deadlines::Schedule,
    event::Event,
    last_reading::LastReading,
    record::{Observer, Record},
    recovery::Recovery,
    render::Render,
    report::{End, Report},
    settings::{Overrun, Settings},
    times::Times,
};
use crate::device::supervised::{Plausible, Supervised};
use crate::device::{Device, DeviceError, Reading};
use asperity_runtime::{Counters, Sample, math::rounds_to_nearest};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Longest time that the force may take to reach zero at the end, s.
const ENDING_S: u64 = 2;

/// A device, what renders its samples, a clock, and who looks on.
pub struct ServoLoop<'d, D: ?Sized, R, C, O> {
    device: Supervised<LastReading<'d, D>>,
    render: R,
    clock: C,
    observer: O,
    settings: Settings,
    schedule: Schedule,
    recovery: Recovery,
    report: Report,
    period: u64,
    /// Periods without a tick since the last one.
    passed: u32,
    /// The force goes to zero for good.
    is_ending: bool,
    woken_before_ns: u64,
    /// Ticks that [`Overrun::CatchUp`] still owes.
    owed: u64,
}

/// Outcome of a tick.
struct Ticked {
    force_is_zero: bool,
    reached: bool,
    overrun: bool,
}

impl<'d, D: Device + ?Sized, R: Render, C: Clock, O: Observer> ServoLoop<'d, D, R, C, O> {
    /// A loop at rest. [`Settings::check`] says whether its rate fits.
    pub fn new(device: &'d mut D, render: R, clock: C, observer: O, settings: Settings) -> Self {
        Self {
            schedule: Schedule::new(settings.rate_hz, 0),
            recovery: Recovery::new(settings.rate_hz),
            device: Supervised::new(
                LastReading::new(device),
                render.config(),
                Plausible::default(),
            ),
            render,
            clock,
            observer,
            settings,
            report: Report::new(),
            period: 0,
            passed: 0,
            is_ending: false,
            woken_before_ns: 0,
            owed: 0,
        }
    }

    /// Runs until `stop` is set, the time is over, or a missed period or another rounding ends it. At
    /// the end the runtime takes the force to zero at the slew limit, and a force of zero is written.
    pub fn run(mut self, stop: &AtomicBool) -> Report {
        let first_ns = self.clock.now_ns() + self.settings.period_ns();
        let start_ns = self.settings.start_ns.unwrap_or(first_ns);
        self.schedule = Schedule::new(self.settings.rate_hz, start_ns);
        let end = loop {
            let ticked = self.tick(None);
            if !rounds_to_nearest() {
                break End::Rounding;
            }
            if ticked.overrun && self.settings.overrun == Overrun::Stop {
                break End::Overrun;
            }
            if stop.load(Relaxed) {
                break End::Asked;
            }
            let over = (self.settings.periods).is_some_and(|periods| self.period >= periods);
            if over || self.settings.pace.is_over(self.report.ticks) {
                break End::Over;
            }
            if ticked.force_is_zero && self.recovery.is_due(self.woken_before_ns) {
                self.recover();
            }
        };
        self.report.end = end;
        // Letting go is no fault: neither a device that falls silent meanwhile, nor the runtime's way
        // to zero force.
        self.report.episodes = self.device.tally().episodes;
        let faults = self.render.counters().faults;
        self.report.ended_without_force = self.fade_out();
        self.report.counters = Counters {
            faults,
            ..self.render.counters()
        };
        let tally = self.device.tally();
        self.report.read_faults = tally.read_faults;
        self.report.write_faults = tally.write_faults;
        self.report.eased = tally.eased;
        self.report
    }

    /// Stale samples: the runtime holds two, then takes the force to zero at the slew limit.
    fn fade_out(&mut self) -> bool {
        self.is_ending = true;
        let longest = ENDING_S * u64::from(self.settings.rate_hz);
        for _ in 0..longest {
            let ticked = self.tick(Some(Sample::STALE));
            // A device that took none of the last forces holds one that is eased to zero here.
            if ticked.force_is_zero && (!ticked.reached || self.device.held_n() == [0.0; 3]) {
                return ticked.reached || self.release();
            }
        }
        self.release()
    }

    /// A last try to take the force away.
    fn release(&mut self) -> bool {
        self.device.write([0.0; 3]).is_ok() && self.device.held_n() == [0.0; 3]
    }

    /// Runs one period. `sample` replaces the device's sample, if given.
    #[inline]
    fn tick(&mut self, sample: Option<Sample>) -> Ticked {
        // Of a tick that comes after missed ones, the time for which the loop slept.
        let due_ns = self.schedule.due_ns();
        let missed = self.wait();
        let woken_ns = self.clock.now_ns();
        let periods =
            (self.settings.pace).periods(self.report.ticks, self.passed.saturating_add(1));
        self.passed = 0;
        let read_faults = self.device.tally().read_faults;
        let seen = self.device.read(periods);
        let read_ns = self.clock.now_ns();
        let sample = sample.unwrap_or(seen.sample);
        let output = self.render.tick(&sample);
        let computed_ns = self.clock.now_ns();
        let written = self.device.write(output.force_n);
        let written_ns = self.clock.now_ns();

        let refused = self.device.tally().read_faults > read_faults;
        let reading = match self.device.device().last() {
            Ok(_) if refused => Err(DeviceError::Garbled),
            heard => heard,
        };
        let record = Record {
            tick: self.report.ticks,
            period: self.period,
            missed,
            times: Times {
                due_ns,
                woken_ns,
                read_ns,
                computed_ns,
                written_ns,
                woken_before_ns: self.woken_before_ns,
            },
            reading,
            sample,
            output,
            exchanges: self.render.exchanges(),
            written,
        };
        self.observer.tick(&record);
        // That a device falls silent while it is let go is nothing to tell.
        if let Some(report) = seen.report.filter(|_| !self.is_ending) {
            self.observer.event(Event::of(report, self.period));
        }
        self.recovery.note(seen.fault.is_some());
        self.count(&record);
        self.woken_before_ns = woken_ns;
        self.schedule.advance(1);
        self.period += 1;
        Ticked {
            force_is_zero: output.force_n == [0.0; 3],
            reached: written.is_ok(),
            overrun: missed > 0,
        }
    }

    /// Sleeps until the next tick is due, applies the overrun policy, and gives the periods that
    /// were missed.
    #[inline]
    fn wait(&mut self) -> u64 {
        self.clock.sleep_until(self.schedule.due_ns());
        let late = self.schedule.missed(self.clock.now_ns());
        if late == 0 && self.owed == 0 {
            return 0;
        }
        self.late(late)
    }

    #[cold]
    fn late(&mut self, late: u64) -> u64 {
        // Periods that are owed were counted when they were missed; this tick is one of them.
        let missed = late.saturating_sub(self.owed.saturating_sub(1));
        self.report.missed += missed;
        let kept = match self.settings.overrun {
            Overrun::Skip | Overrun::Stop => 0,
            Overrun::CatchUp => late.min(u64::from(self.settings.rate_hz) / 10),
        };
        if self.owed > 0 {
            self.report.caught_up += 1;
        }
        self.owed = kept;
        self.skip(late - kept);
        missed
    }

    /// Lets periods pass without a tick.
    fn skip(&mut self, periods: u64) {
        self.schedule.advance(periods);
        let passed = u32::try_from(periods).unwrap_or(u32::MAX);
        self.passed = self.passed.saturating_add(passed);
        self.period += periods;
    }

    /// Counts a tick.
    #[inline]
    fn count(&mut self, record: &Record) {
        self.report.ticks += 1;
        if let Some(gap_ns) = record.times.of(super::times::Stage::Interval) {
            self.report.longest_gap_ns = self.report.longest_gap_ns.max(gap_ns);
        }
        let fresh = matches!(record.reading, Ok(Reading { fresh: true, .. }));
        self.report.stale += u64::from(!fresh);
    }

    /// Lets the device recover, and goes on with the period after.
    #[cold]
    fn recover(&mut self) {
        self.report.recoveries += 1;
        let recovered = self.device.recover();
        let now_ns = self.clock.now_ns();
        match recovered {
            Ok(()) => self.report.recovered += 1,
            Err(fault) => {
                let period = self.period;
                self.observer.event(Event::NotRecovered { period, fault });
            }
        }
        self.recovery.tried(now_ns);
        let passed = self.schedule.missed(now_ns);
        self.report.paused += passed;
        self.owed = 0;
        self.skip(passed);
    }
}
