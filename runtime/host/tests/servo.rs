//! The servo loop in virtual time: overruns, faults, shutdown, telemetry.

use crate::support::{Act, Kept, Scripted, length, texture};
use asperity_formats::Library;
use asperity_host::device::DeviceError;
use asperity_host::servo::{
    End, Event, InScene, Observer as _, Overrun, Played, Render as _, Report, ServoLoop, Settings,
    SettingsError, SingleTexture, Stage, Virtual, queues,
};
use asperity_runtime::{Exchange, Flags, HostScene, HostTexture, Sample, SceneState, State};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

const PERIOD_NS: u64 = 1_000_000;
static NEVER: AtomicBool = AtomicBool::new(false);

fn calm(_: u64) -> Act {
    Act::default()
}

/// Fails with a fault in some calls.
fn failing(calls: Range<u64>, fault: DeviceError) -> impl FnMut(u64) -> Act + Send {
    move |call| Act {
        fault: calls.contains(&call).then_some(fault),
        ..Act::default()
    }
}

/// Takes so long in one call.
fn slow(at: u64, takes_ns: u64) -> impl FnMut(u64) -> Act + Send {
    move |call| Act {
        takes_ns: if call == at { takes_ns } else { 0 },
        ..Act::default()
    }
}

struct Run {
    report: Report,
    kept: Kept,
    forces: Vec<[f32; 3]>,
    recoveries: usize,
}

/// 1,000 periods at 1 kHz, or as many as `settings` say.
fn run(
    settings: Settings,
    read: impl FnMut(u64) -> Act + Send,
    write: impl FnMut(u64) -> Act + Send,
    recovery_ns: u64,
) -> Run {
    let clock = Virtual::new();
    let (texture, renderer) = texture(1000.0);
    let mut device = Scripted::new(&clock, read, write);
    device.recovery_ns = recovery_ns;
    let mut kept = Kept::default();
    let render = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(1),
    };
    let report = ServoLoop::new(&mut device, render, clock, &mut kept, settings).run(&NEVER);
    Run {
        report,
        kept,
        forces: device.forces,
        recoveries: device.recoveries.len(),
    }
}

fn periods(periods: u64) -> Settings {
    Settings {
        periods: Some(periods),
        ..Settings::at(1000)
    }
}

/// No force is above the peak, and none steps by more than the slew limit of a tick.
fn assert_within_limits(run: &Run) {
    let mut last = [0.0; 3];
    for force in &run.forces {
        assert!(length(*force) <= 3.3);
        let step = std::array::from_fn(|i| force[i] - last[i]);
        assert!(length(step) <= 2.0 + 1e-6, "{last:?} to {force:?}");
        last = *force;
    }
    assert_eq!(last, [0.0; 3], "a force was left on");
    assert!(run.report.ended_without_force);
}

/// A device whose code sets the thread to round up.
#[cfg(target_arch = "x86_64")]
#[test]
fn a_loop_whose_processor_rounds_otherwise_ends_and_lets_go() {
    /// The control register of SSE: all exceptions masked, rounding as these bits say.
    #[allow(
        unsafe_code,
        reason = "the register belongs to the thread, and is put back"
    )]
    fn round(bits: u32) {
        let value = 0x1f80 | bits;
        // SAFETY: the test puts the default back.
        unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const value, options(nostack)) }
    }
    let read = |call| {
        round(if call == 500 { 2 << 13 } else { 0 });
        Act::default()
    };
    let run = run(periods(1000), read, calm, 0);
    round(2 << 13);
    let refused = Settings::at(1000).check(1000.0);
    round(0);
    assert_eq!(refused, Err(SettingsError::Rounding));
    assert_eq!(run.report.end, End::Rounding);
    assert!((500..700).contains(&run.report.ticks), "{:?}", run.report);
    assert_within_limits(&run);
}

#[test]
fn a_punctual_loop_runs_every_period_once() {
    let run = run(periods(1000), calm, calm, 0);
    assert_eq!((run.report.end, run.report.missed), (End::Over, 0));
    assert!(run.report.ticks >= 1000 && run.kept.events.is_empty());
    for (n, record) in run.kept.records.iter().enumerate().take(1000) {
        assert_eq!(record.period, n as u64);
        assert_eq!(record.times.due_ns, (n as u64 + 1) * PERIOD_NS);
        assert_eq!(record.sample.elapsed_ticks, 1);
        assert_eq!(record.times.of(Stage::WakeUp), Some(0));
    }
    assert!(run.forces.iter().any(|&force| length(force) > 0.5));
    assert_within_limits(&run);
}

#[test]
fn skipped_periods_are_counted_and_the_next_sample_says_so() {
    let run = run(periods(100), slow(10, 7 * PERIOD_NS / 2), calm, 0);
    // Tick 10 takes 3.5 periods: those of ticks 11 and 12 pass, and 13 runs half a period late.
    assert_eq!((run.report.missed, run.report.caught_up), (2, 0));
    let after = &run.kept.records[11];
    assert_eq!((after.period, after.missed), (13, 2));
    assert_eq!(after.sample.elapsed_ticks, 3);
    assert_eq!(after.times.of(Stage::WakeUp), Some(5 * PERIOD_NS / 2));
    let next = &run.kept.records[12];
    assert_eq!(next.times.due_ns, 15 * PERIOD_NS, "it stays in phase");
    assert_eq!(next.times.of(Stage::WakeUp), Some(0));
    assert_eq!(run.report.longest_gap_ns, 7 * PERIOD_NS / 2);
    assert_within_limits(&run);
}

#[test]
fn missed_periods_are_made_up_for_one_after_the_other() {
    let settings = Settings {
        overrun: Overrun::CatchUp,
        ..periods(100)
    };
    let run = run(settings, slow(10, 7 * PERIOD_NS / 2), calm, 0);
    assert_eq!((run.report.missed, run.report.caught_up), (2, 2));
    for (n, record) in run.kept.records.iter().enumerate().take(100) {
        assert_eq!((record.period, record.sample.elapsed_ticks), (n as u64, 1));
    }
    let late = |n: usize| run.kept.records[n].times.of(Stage::WakeUp);
    let half = PERIOD_NS / 2;
    let expected = [5 * half, 3 * half, half, 0].map(Some);
    assert_eq!([11, 12, 13, 14].map(late), expected);
    assert_within_limits(&run);
}

#[test]
fn periods_missed_while_others_are_made_up_for_count_once() {
    let settings = Settings {
        overrun: Overrun::CatchUp,
        ..periods(100)
    };
    let slow_twice = |call| Act {
        takes_ns: match call {
            10 => 7 * PERIOD_NS / 2,
            11 => 2 * PERIOD_NS,
            _ => 0,
        },
        ..Act::default()
    };
    let run = run(settings, slow_twice, calm, 0);
    // Tick 10 misses two periods; the first that is made up for misses two more.
    let missed = |n: usize| run.kept.records[n].missed;
    assert_eq!([11, 12, 13, 14, 15].map(missed), [2, 2, 0, 0, 0]);
    assert_eq!((run.report.missed, run.report.caught_up), (4, 4));
    assert_within_limits(&run);
}

#[test]
fn no_more_is_made_up_for_than_a_tenth_of_a_second() {
    let settings = Settings {
        overrun: Overrun::CatchUp,
        ..periods(2000)
    };
    let run = run(settings, slow(10, 1001 * PERIOD_NS), calm, 0);
    assert_eq!((run.report.missed, run.report.caught_up), (1000, 100));
    assert_within_limits(&run);
}

#[test]
fn a_loop_that_may_miss_nothing_ends_without_force() {
    let settings = Settings {
        overrun: Overrun::Stop,
        ..periods(1000)
    };
    let run = run(settings, slow(400, 5 * PERIOD_NS / 2), calm, 0);
    assert_eq!((run.report.end, run.report.missed), (End::Overrun, 1));
    assert!(run.report.ticks < 420);
    assert_within_limits(&run);
}

#[test]
fn two_lost_readings_are_held_and_the_third_is_safe() {
    for (lost, safe) in [(1, false), (2, false), (3, true), (40, true)] {
        let run = run(
            periods(600),
            failing(300..300 + lost, DeviceError::TimedOut),
            calm,
            0,
        );
        let was_safe = |n: usize| run.kept.records[n].output.flags.contains(Flags::SAFE_STATE);
        assert_eq!((300..599).any(was_safe), safe, "{lost} lost");
        assert_eq!(was_safe(302), safe, "within a tick of what may be held");
        assert_eq!(run.report.read_faults, lost);
        let failed = Event::Failed {
            period: 300,
            fault: DeviceError::TimedOut,
        };
        let back = Event::Back {
            period: 300 + lost,
            faulty_ticks: lost,
        };
        assert_eq!(run.kept.events, [failed, back], "each is reported once");
        let first = &run.kept.records[300 + lost as usize];
        assert_eq!(u64::from(first.sample.elapsed_ticks), lost + 1);
        assert_within_limits(&run);
        assert!(length(run.forces[598]) > 0.5, "the force comes back");
    }
}

#[test]
fn forces_that_do_not_arrive_are_a_fault_as_well() {
    let run = run(
        periods(600),
        calm,
        failing(300..310, DeviceError::Stalled),
        0,
    );
    assert_eq!((run.report.write_faults, run.report.read_faults), (10, 0));
    // The runtime counts what it was given: ten samples behind forces that did not arrive, and those of the end.
    let counters = run.report.counters;
    assert_eq!(u64::from(counters.ticks), run.report.ticks);
    // One safe state: that of the end is none.
    assert_eq!((counters.faults, counters.bad_samples), (1, 13));
    let flags = run.kept.records[303].output.flags;
    assert!(flags.contains(Flags::SAFE_STATE));
    assert_eq!(run.kept.events.len(), 2);
    assert_within_limits(&run);
}

/// While the force of a device that takes nothing fades, the loop tries once more and then ends; the report does not
/// claim what the device never confirmed.
#[test]
fn a_force_that_nobody_could_take_away_is_reported() {
    for (until, taken) in [(603, true), (604, false), (u64::MAX, false)] {
        let run = run(
            periods(600),
            calm,
            failing(599..until, DeviceError::Stalled),
            0,
        );
        assert_eq!(run.report.ended_without_force, taken, "{:?}", run.report);
        // 600 periods, three in which the force fades, and the last try.
        assert_eq!((run.report.ticks, run.forces.len()), (603, 604));
    }
}

/// What the loop checks its rate against is the configuration of whatever renders.
#[test]
fn a_loop_has_the_configuration_of_its_renderer() {
    let (mut playing, renderer) = texture(4000.0);
    let [mut a, mut b] = [(); 2].map(|()| Box::new(HostTexture::new()));
    let mut exchange = Exchange::new();
    let (_, player) = exchange.split(&mut playing, [&mut a, &mut b], 1);
    let single = SingleTexture {
        renderer: &renderer,
        texture: &texture(4000.0).0,
        state: State::new(1),
    };
    assert_eq!(single.config(), renderer.config());
    assert_eq!(Played::new(&renderer, player).config(), renderer.config());
    let library = include_bytes!("../../../formats/tests/data/scene-v2.aspl");
    let library = Library::parse(library).unwrap();
    let mut slots = vec![HostTexture::EMPTY; library.index().len()];
    let scene = HostScene::load(&library, renderer.config(), &mut slots).unwrap();
    let in_scene = InScene {
        renderer: &renderer,
        scene: &scene,
        state: SceneState::new(1),
    };
    assert_eq!(in_scene.config(), renderer.config());
    assert_eq!(renderer.config().servo_rate_hz, 4000.0);
}

#[test]
fn every_exchange_is_counted_once() {
    let (mut playing, renderer) = texture(1000.0);
    let [mut a, mut b] = [(); 2].map(|()| Box::new(HostTexture::new()));
    let mut exchange = Exchange::new();
    let (mut preparer, player) = exchange.split(&mut playing, [&mut a, &mut b], 1);
    let mut played = Played::new(&renderer, player);
    let asset = include_bytes!("../../tests/data/builtin-v1.asp");
    let asset = asperity_formats::Asset::parse(asset).unwrap();
    let mut counted = Vec::new();
    for tick in 0..900 {
        if tick % 300 == 150 {
            preparer.prepare(&asset, 1000.0).unwrap();
        }
        played.tick(&Sample::at([0.0, 0.0, 1e-2]));
        if tick % 300 == 299 {
            counted.push(played.exchanges());
        }
    }
    assert_eq!(counted, [1, 2, 3]);
}

#[test]
fn a_device_that_says_nothing_new_is_silent_after_three_ticks() {
    let read = |call| Act {
        old: (300..320).contains(&call),
        ..Act::default()
    };
    let run = run(periods(600), read, calm, 0);
    assert_eq!((run.report.stale, run.report.read_faults), (20, 0));
    let failed = Event::Failed {
        period: 302,
        fault: DeviceError::TimedOut,
    };
    assert_eq!(run.kept.events[0], failed);
    assert!(
        run.kept.records[302]
            .output
            .flags
            .contains(Flags::SAFE_STATE)
    );
    assert_within_limits(&run);
}

#[test]
fn recovery_is_tried_without_force_and_its_time_is_counted_apart() {
    let run = run(
        periods(1000),
        failing(300..500, DeviceError::Disconnected),
        calm,
        7 * PERIOD_NS + PERIOD_NS / 2,
    );
    assert!(run.recoveries >= 2, "{}", run.recoveries);
    assert_eq!(run.report.recoveries, run.recoveries as u64);
    assert_eq!(run.report.missed, 0);
    // Of 7.5 periods, the first is the one in which recovery began.
    assert_eq!(run.report.paused, 6 * run.report.recoveries);
    // The first try comes after 50 ms of faults; the force is zero by then.
    assert!(run.forces[305..500].iter().all(|force| *force == [0.0; 3]));
    let tries = run.kept.events.iter();
    let tries = tries.filter(|event| matches!(event, Event::NotRecovered { .. }));
    assert_eq!(tries.count(), run.recoveries);
    assert!(length(run.forces[900]) > 0.5, "the force comes back");
    assert_within_limits(&run);
}

#[test]
fn a_loop_that_is_stopped_in_contact_lets_go_at_the_slew_limit() {
    let clock = Virtual::new();
    let (texture, renderer) = texture(1000.0);
    let stop = AtomicBool::new(false);
    let read = |call| {
        stop.store(call >= 200, Relaxed);
        Act::default()
    };
    let mut device = Scripted::new(&clock, read, calm);
    let render = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(1),
    };
    let servo = ServoLoop::new(&mut device, render, clock, (), Settings::at(1000));
    let report = servo.run(&stop);
    let run = Run {
        report,
        kept: Kept::default(),
        forces: device.forces,
        recoveries: 0,
    };
    assert_eq!(run.report.end, End::Asked);
    assert!(length(run.forces[200]) > 0.5);
    // Two samples are held, then 3.3 N at most fall by 2 N a tick.
    assert!(run.forces.len() <= 201 + 2 + 2, "{}", run.forces.len());
    assert_within_limits(&run);
}

#[test]
fn a_slow_reader_loses_records_and_never_a_tick() {
    let clock = Virtual::new();
    let (texture, renderer) = texture(1000.0);
    let mut device = Scripted::new(&clock, calm, calm);
    let render = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(1),
    };
    let (outlet, mut inlet) = queues(8);
    let settings = periods(100);
    let report = ServoLoop::new(&mut device, render, clock, outlet, settings).run(&NEVER);
    assert_eq!(report.missed, 0);
    assert!(report.ticks >= 100 && !inlet.is_over());
    let kept: Vec<u64> = std::iter::from_fn(|| inlet.record().map(|r| r.period)).collect();
    assert_eq!(kept, (0..8).collect::<Vec<_>>());
    assert_eq!(inlet.lost(), report.ticks - 8);
    assert!(inlet.is_over());
}

#[test]
fn a_slow_reader_loses_the_latest_events_and_they_are_counted() {
    let back = |period| Event::Back {
        period,
        faulty_ticks: 1,
    };
    let (mut outlet, mut inlet) = queues(1);
    assert_eq!((inlet.event(), inlet.lost()), (None, 0));
    for period in 0..1000 {
        outlet.event(back(period));
    }
    let kept: Vec<Event> = std::iter::from_fn(|| inlet.event()).collect();
    assert!((1..1000).contains(&kept.len()));
    assert_eq!(kept, (0..kept.len() as u64).map(back).collect::<Vec<_>>());
    assert_eq!(inlet.lost(), 1000 - kept.len() as u64);
}

#[test]
fn a_rate_that_does_not_fit_is_refused() {
    assert_eq!(Settings::at(1000).check(1000.0), Ok(()));
    assert_eq!(
        Settings::at(100).check(100.0),
        Err(SettingsError::Rate(100))
    );
    assert!(matches!(
        Settings::at(1000).check(2000.0),
        Err(SettingsError::OtherRate { .. })
    ));
}
