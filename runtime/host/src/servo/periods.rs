//! The servo loop: one tick a period, on absolute times.
//!
//! ```text
//! sleep until due → read → sample → render → write → record
//! ```
//!
//! Between two sleeps the loop neither allocates, locks nor prints. Only [`Device::recover`] may:
//! it runs while the device is away and the force is zero, and the periods that it takes are
//! counted apart.

use super::{
    clock::Clock,
    faults::{Event, Faults},
    record::{Observer, Record},
    render::Render,
    report::{End, Report},
    sampler::Sampler,
    schedule::Schedule,
    settings::{Overrun, Settings},
    times::Times,
};
use crate::device::{Device, Fault, Reading};
use asperity_runtime::Sample;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Longest time that the force may take to reach zero at the end, s.
const ENDING_S: u64 = 2;

/// A device, what renders its samples, a clock, and who looks on.
pub struct ServoLoop<'d, D: ?Sized, R, C, O> {
    device: &'d mut D,
    render: R,
    clock: C,
    observer: O,
    settings: Settings,
    schedule: Schedule,
    sampler: Sampler,
    faults: Faults,
    report: Report,
    period: u64,
    woken_before_ns: u64,
    /// Ticks that [`Overrun::CatchUp`] still owes.
    owed: u64,
}

/// How a tick ended.
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
            faults: Faults::new(settings.rate_hz),
            device,
            render,
            clock,
            observer,
            settings,
            sampler: Sampler::default(),
            report: Report::new(),
            period: 0,
            woken_before_ns: 0,
            owed: 0,
        }
    }

    /// Runs until `stop` is set, the time is over, or a missed period ends it. At the end the
    /// runtime takes the force to zero at the slew limit, and a force of zero is written.
    pub fn run(mut self, stop: &AtomicBool) -> Report {
        let first_ns = self.clock.now_ns() + self.settings.period_ns();
        let start_ns = self.settings.start_ns.unwrap_or(first_ns);
        self.schedule = Schedule::new(self.settings.rate_hz, start_ns);
        let end = loop {
            let ticked = self.tick(None);
            if ticked.overrun && self.settings.overrun == Overrun::Stop {
                break End::Overrun;
            }
            if stop.load(Relaxed) {
                break End::Asked;
            }
            if (self.settings.periods).is_some_and(|periods| self.period >= periods) {
                break End::Over;
            }
            if ticked.force_is_zero && self.faults.wants_recovery(self.woken_before_ns) {
                self.recover();
            }
        };
        self.report.end = end;
        self.report.ended_without_force = self.fade_out();
        self.report.counters = self.render.counters();
        self.report
    }

    /// Stale samples: the runtime holds two, then takes the force to zero at the slew limit.
    fn fade_out(&mut self) -> bool {
        let longest = ENDING_S * u64::from(self.settings.rate_hz);
        for _ in 0..longest {
            let ticked = self.tick(Some(Sample::STALE));
            if ticked.force_is_zero {
                return ticked.reached || self.device.write([0.0; 3]).is_ok();
            }
        }
        self.device.write([0.0; 3]).is_ok()
    }

    /// One period. `sample` is given in place of what the device says.
    #[inline]
    fn tick(&mut self, sample: Option<Sample>) -> Ticked {
        // Of a tick that comes after missed ones, the time for which the loop slept.
        let due_ns = self.schedule.due_ns();
        let missed = self.wait();
        let woken_ns = self.clock.now_ns();
        let reading = self.device.read();
        let read_ns = self.clock.now_ns();
        let measured = self.sampler.sample(&reading);
        let sample = sample.unwrap_or(measured);
        let output = self.render.tick(&sample);
        let computed_ns = self.clock.now_ns();
        let written = self.device.write(output.force_n);
        let written_ns = self.clock.now_ns();

        self.sampler.written(written.is_ok());
        let record = Record {
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
            written,
        };
        self.observer.tick(&record);
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
        self.sampler.pass(periods);
        self.period += periods;
    }

    /// Counts a tick, and reports the beginning and the end of a run of faults.
    #[inline]
    fn count(&mut self, record: &Record) {
        self.report.ticks += 1;
        if let Some(gap_ns) = record.times.of(super::times::Stage::Interval) {
            self.report.longest_gap_ns = self.report.longest_gap_ns.max(gap_ns);
        }
        let fresh = matches!(record.reading, Ok(Reading { fresh: true, .. }));
        let silent = self.faults.freshness(fresh);
        self.report.stale += u64::from(!fresh);
        self.report.read_faults += u64::from(record.reading.is_err());
        self.report.write_faults += u64::from(record.written.is_err());
        let fault: Option<Fault> = record.reading.err().or(record.written.err()).or(silent);
        if let Some(event) = self.faults.note(self.period, fault) {
            self.observer.event(event);
        }
    }

    /// Lets the device recover, and goes on with the period after.
    #[cold]
    fn recover(&mut self) {
        self.report.recoveries += 1;
        let recovered = self.device.recover();
        let now_ns = self.clock.now_ns();
        if let Err(fault) = recovered {
            let period = self.period;
            self.observer.event(Event::NotRecovered { period, fault });
        }
        self.faults.tried(now_ns);
        let passed = self.schedule.missed(now_ns);
        self.report.paused += passed;
        self.owed = 0;
        self.skip(passed);
    }
}
