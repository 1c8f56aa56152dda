//! The servo loop against a model of its life: drawn delays, faults of reading and writing, recoveries and stops. The
//! model says what the loop must report, tick by tick, and what may be left on the device. Forces are whole steps of the
//! slew limit.

use crate::support::{Act, ObserverLog, Scripted};
use asperity_host::device::DeviceError;
use asperity_host::servo::{End, Event, Overrun, Render, Report, ServoLoop, Settings, Virtual};
use asperity_runtime::{Config, Counters, Flags, Output, Sample};
use asperity_tests::draw::Draw;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

const PERIOD_NS: u64 = 1_000_000;
/// A step of the slew limit a period, N.
const STEP_N: f32 = 0.5;
/// Inputs and faults of a loop; times count calls.
#[derive(Debug)]
struct Script {
    overrun: Overrun,
    periods: u64,
    /// The force in contact, in steps; a large one takes longer to fall than a recovery waits.
    top: i32,
    /// The reading in which the stop is asked for; it is taken back in the next one.
    stop_at: u64,
    /// Readings that take longer, ns.
    delays: Vec<(u64, u64)>,
    /// Readings with a fault; `None` gives nothing new.
    reads: Vec<(Range<u64>, Option<DeviceError>)>,
    writes: Vec<(Range<u64>, DeviceError)>,
    recovers: bool,
    recovery_ns: u64,
}

impl Script {
    fn drawn(draw: &mut Draw) -> Self {
        use DeviceError::{Disconnected, Stalled, TimedOut};
        let periods = 50 + draw.below(600) as u64;
        let some = |draw: &mut Draw| {
            let from = draw.below(periods as usize + 20) as u64;
            from..from + [1, 2, 3, 4, 9, 60, 300][draw.below(7)]
        };
        let count = |draw: &mut Draw| 0..[0, 1, 2, 6][draw.below(4)];
        Self {
            overrun: Overrun::ALL[[0, 0, 1, 1, 2][draw.below(5)]],
            periods,
            top: [2, 6, 100][draw.below(3)],
            stop_at: draw.below(2 * periods as usize) as u64,
            delays: count(draw)
                .map(|_| {
                    let halves = [1, 3, 5, 8, 21, 1, 300][draw.below(7)];
                    (some(draw).start, halves * PERIOD_NS / 2)
                })
                .collect(),
            reads: count(draw)
                .map(|_| {
                    let fault = [None, Some(TimedOut), Some(Disconnected)][draw.below(3)];
                    (some(draw), fault)
                })
                .collect(),
            writes: count(draw)
                .map(|_| (some(draw), [Stalled, Disconnected][draw.below(2)]))
                .collect(),
            recovers: draw.below(2) == 0,
            recovery_ns: draw.below(8) as u64 * PERIOD_NS / 2,
        }
    }

    fn read(&self, call: u64) -> Act {
        let takes = self.delays.iter().filter(|(at, _)| *at == call);
        let fault = self.reads.iter().find(|(calls, _)| calls.contains(&call));
        Act {
            takes_ns: takes.map(|(_, ns)| ns).sum(),
            fault: fault.and_then(|(_, fault)| *fault),
            old: fault.is_some(),
        }
    }

    fn write(&self, call: u64) -> Option<DeviceError> {
        let fault = self.writes.iter().find(|(calls, _)| calls.contains(&call));
        fault.map(|(_, fault)| *fault)
    }
}

/// Renders whole steps: one up with a good sample; down after two bad ones.
struct Steps {
    config: Config,
    top: i32,
    force: i32,
    bad: u32,
}

impl Steps {
    fn step(&mut self, is_good: bool) -> i32 {
        self.bad = if is_good { 0 } else { self.bad + 1 };
        self.force = match self.bad {
            0 => self.top.min(self.force + 1),
            1 | 2 => self.force,
            _ => 0.max(self.force - 1),
        };
        self.force
    }
}

impl Render for Steps {
    fn tick(&mut self, sample: &Sample) -> Output {
        let force = self.step(sample.elapsed_ticks > 0);
        Output {
            force_n: [0.0, 0.0, STEP_N * force as f32],
            depth_m: 0.0,
            speed_mm_s: 0.0,
            normal_force_n: 0.0,
            vib_m_s2: 0.0,
            tap_n: 0.0,
            friction_n: 0.0,
            flags: Flags::default(),
        }
    }

    fn config(&self) -> &Config {
        &self.config
    }

    fn counters(&self) -> Counters {
        Counters::default()
    }
}

fn steps(top: i32) -> Steps {
    let mut config = Config::default();
    config.limits.slew_n_s = STEP_N * config.servo_rate_hz;
    Steps {
        config,
        top,
        force: 0,
        bad: 0,
    }
}

/// A tick: its period, the periods that were missed before it, when it was due and when it ran, the elapsed ticks of its
/// sample, and the force that the device holds after it, in steps.
type Tick = (u64, u64, [u64; 2], u32, i32);

/// Reference model of a loop and its report.
struct Model<'s> {
    script: &'s Script,
    now_ns: u64,
    woken_ns: u64,
    period: u64,
    /// Periods before this one were counted as missed and are made up for; 0 where none are.
    owed_to: u64,
    /// Periods since the last good sample, and readings in a row that were not fresh.
    since: u32,
    quiet: u32,
    write_fault: Option<DeviceError>,
    /// Periods of the fault that lasts.
    episode: Option<u64>,
    faulty_ticks: u32,
    next_try_ns: u64,
    pause_ns: u64,
    held: i32,
    writes: u64,
    steps: Steps,
    ticks: Vec<Tick>,
    events: Vec<Event>,
    report: Report,
}

impl Model<'_> {
    fn run(&mut self) {
        self.report.end = loop {
            let (is_zero, _, missed) = self.tick(false);
            if missed > 0 && self.script.overrun == Overrun::Stop {
                break End::Overrun;
            } else if self.report.ticks == self.script.stop_at + 1 {
                break End::Asked;
            } else if self.period >= self.script.periods {
                break End::Over;
            } else if is_zero && self.faulty_ticks > 50 && self.woken_ns >= self.next_try_ns {
                self.recover();
            }
        };
        // The force goes to zero, and is zero only once the device holds none, or takes nothing.
        let ended = (0..2000).find_map(|_| {
            let (is_zero, arrived, _) = self.tick(true);
            (is_zero && (!arrived || self.held == 0)).then_some(arrived)
        });
        self.report.ended_without_force = ended == Some(true) || self.write(0) && self.held == 0;
    }

    /// Runs a tick; returns whether the rendered force is zero, whether a force arrived, and the
    /// periods missed before it.
    fn tick(&mut self, is_ending: bool) -> (bool, bool, u64) {
        let due_ns = (self.period + 1) * PERIOD_NS;
        self.now_ns = self.now_ns.max(due_ns);
        let late = (self.now_ns - due_ns) / PERIOD_NS;
        let missed = late.saturating_sub(self.owed_to.saturating_sub(self.period));
        self.report.missed += missed;
        self.report.caught_up += u64::from(self.owed_to > 0);
        let kept = match self.script.overrun {
            Overrun::CatchUp => late.min(100),
            Overrun::Skip | Overrun::Stop => 0,
        };
        self.pass(late - kept);
        self.owed_to = if kept > 0 { self.period + kept } else { 0 };
        let gap_ns = self.now_ns - std::mem::replace(&mut self.woken_ns, self.now_ns);
        if self.report.ticks > 0 {
            self.report.longest_gap_ns = self.report.longest_gap_ns.max(gap_ns);
        }
        let act = self.script.read(self.report.ticks);
        self.now_ns += act.takes_ns;
        let fault = self.fault(act, is_ending);
        self.since += 1;
        let is_good = fault.is_none() && !act.old;
        let since = if is_good {
            std::mem::take(&mut self.since)
        } else {
            0
        };
        let elapsed = if is_ending { 0 } else { since };
        let force = self.steps.step(elapsed > 0);
        let arrived = self.write(force);
        let times_ns = [due_ns, self.woken_ns];
        self.ticks
            .push((self.period, missed, times_ns, elapsed, self.held));
        self.report.ticks += 1;
        self.period += 1;
        (force == 0, arrived, missed)
    }

    fn pass(&mut self, periods: u64) {
        self.period += periods;
        self.since += periods as u32;
    }

    /// The fault of a period, reported when it begins and when it is over.
    fn fault(&mut self, act: Act, is_ending: bool) -> Option<DeviceError> {
        self.quiet = if act.old { self.quiet + 1 } else { 0 };
        self.report.read_faults += u64::from(act.fault.is_some());
        self.report.stale += u64::from(act.old);
        let silence = (self.quiet > 2).then_some(DeviceError::TimedOut);
        let fault = self.write_fault.or(act.fault).or(silence);
        let period = self.period;
        let told = match (self.episode, fault) {
            (None, Some(fault)) => Some(Event::Failed { period, fault }),
            (Some(faulty_ticks), None) if !act.old => Some(Event::Back {
                period,
                faulty_ticks,
            }),
            _ => None,
        };
        match told {
            Some(Event::Back { .. }) => self.episode = None,
            Some(_) => self.episode = Some(1),
            None => self.episode = self.episode.map(|ticks| ticks + 1),
        }
        if !is_ending {
            self.report.episodes += u64::from(matches!(told, Some(Event::Failed { .. })));
            self.events.extend(told);
        }
        self.faulty_ticks = fault.map_or(0, |_| self.faulty_ticks + 1);
        if fault.is_none() {
            self.pause_ns = 100 * PERIOD_NS;
        }
        fault
    }

    /// Writes a force, at most a step from the one that is held.
    fn write(&mut self, force: i32) -> bool {
        let eased = self.held + (force - self.held).signum();
        self.report.eased += u64::from(eased != force);
        self.write_fault = self.script.write(self.writes);
        self.writes += 1;
        self.report.write_faults += u64::from(self.write_fault.is_some());
        self.held = match self.write_fault {
            None => eased,
            Some(DeviceError::Disconnected) => 0,
            Some(_) => self.held,
        };
        self.write_fault.is_none()
    }

    fn recover(&mut self) {
        self.report.recoveries += 1;
        self.now_ns += self.script.recovery_ns;
        if self.script.recovers {
            self.report.recovered += 1;
        } else {
            self.events.push(Event::NotRecovered {
                period: self.period,
                fault: DeviceError::Disconnected,
            });
        }
        self.next_try_ns = self.now_ns + self.pause_ns;
        self.pause_ns = (2 * self.pause_ns).min(1600 * PERIOD_NS);
        let due_ns = (self.period + 1) * PERIOD_NS;
        let passed = self.now_ns.saturating_sub(due_ns) / PERIOD_NS;
        self.report.paused += passed;
        self.owed_to = 0;
        self.pass(passed);
    }
}

fn model(script: &Script) -> Model<'_> {
    let mut model = Model {
        script,
        now_ns: 0,
        woken_ns: 0,
        period: 0,
        owed_to: 0,
        since: 0,
        quiet: 0,
        write_fault: None,
        episode: None,
        faulty_ticks: 0,
        next_try_ns: 0,
        pause_ns: 100 * PERIOD_NS,
        held: 0,
        writes: 0,
        steps: steps(script.top),
        ticks: Vec::new(),
        events: Vec::new(),
        report: Report {
            end: End::Asked,
            ticks: 0,
            missed: 0,
            caught_up: 0,
            paused: 0,
            stale: 0,
            read_faults: 0,
            write_faults: 0,
            recoveries: 0,
            recovered: 0,
            episodes: 0,
            eased: 0,
            longest_gap_ns: 0,
            ended_without_force: false,
            counters: Counters::default(),
        },
    };
    model.run();
    model
}

/// Runs a script. A failure prints it, and what the model says.
fn check(seed: u64) -> Report {
    let script = Script::drawn(&mut Draw::new(seed));
    let model = model(&script);
    let stop = AtomicBool::new(false);
    let clock = Virtual::new();
    let read = |call| {
        stop.store(call == script.stop_at, Relaxed);
        script.read(call)
    };
    let write = |call| Act {
        fault: script.write(call),
        ..Act::default()
    };
    let mut device = Scripted::new(&clock, read, write);
    (device.recovers, device.recovery_ns) = (script.recovers, script.recovery_ns);
    let mut kept = ObserverLog::default();
    let settings = Settings {
        overrun: script.overrun,
        periods: Some(script.periods),
        ..Settings::at(1000)
    };
    let servo = ServoLoop::new(&mut device, steps(script.top), clock, &mut kept, settings);
    let report = servo.run(&stop);

    let mut held_n = 0.0;
    let mut largest_n = 0.0_f32;
    let held: Vec<f32> = device
        .forces
        .iter()
        .zip(0..)
        .map(|(force_n, call)| {
            match script.write(call) {
                None => {
                    largest_n = libm::fmaxf(largest_n, (force_n[2] - held_n).abs());
                    held_n = force_n[2];
                }
                Some(DeviceError::Disconnected) => held_n = 0.0,
                Some(_) => {}
            }
            held_n
        })
        .collect();
    let ticks: Vec<Tick> = kept
        .records
        .iter()
        .zip(&held)
        .map(|(record, held_n)| {
            let held = (held_n / STEP_N).round() as i32;
            let times_ns = [record.times.due_ns, record.times.woken_ns];
            (
                record.period,
                record.missed,
                times_ns,
                record.sample.elapsed_ticks,
                held,
            )
        })
        .collect();
    let differs = ticks
        .iter()
        .zip(&model.ticks)
        .position(|(found, wanted)| found != wanted);
    let near = differs.map(|n| (&ticks[n.saturating_sub(2)..=n], &model.ticks[n]));
    assert_eq!(
        near, None,
        "seed {seed}: {script:#?}: the ticks, and what the model says"
    );
    assert_eq!(report, model.report, "seed {seed}: {script:#?}");
    assert_eq!(kept.events, model.events, "seed {seed}: {script:#?}");
    // Whatever the model says: no step beyond the limit, and no force behind a report that there is none.
    assert!(
        largest_n <= STEP_N * 1.001,
        "seed {seed}: {script:#?}: {largest_n} N at once"
    );
    assert!(
        held_n == 0.0 || !report.ended_without_force,
        "seed {seed}: {script:#?}: {held_n} N"
    );
    report
}

#[test]
fn a_loop_does_and_reports_what_its_model_says() {
    let reports: Vec<Report> = (0..3000).map(check).collect();
    // The sequences reach every part of the life.
    let some = |is: fn(&Report) -> bool| reports.iter().filter(|report| is(report)).count() > 20;
    for end in [End::Asked, End::Over, End::Overrun] {
        assert!(
            reports.iter().filter(|report| report.end == end).count() > 20,
            "{end:?}"
        );
    }
    assert!(some(|r| !r.ended_without_force) && some(|r| r.ended_without_force && r.eased > 0));
    assert!(some(|r| r.caught_up > 0) && some(|r| r.paused > 0) && some(|r| r.episodes > 1));
    assert!(some(|r| r.recovered > 0) && some(|r| r.recoveries > r.recovered));
}
