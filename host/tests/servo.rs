//! The servo loop in virtual time with the runtime in it: faults, shutdown, telemetry. Overruns, recoveries and how a loop
//! ends are in `servo_model`.

use crate::support::{Act, ObserverLog, Scripted, length, texture};
use asperity_formats::Library;
use asperity_host::device::DeviceError;
use asperity_host::servo::{
    End, Event, Observer as _, Render as _, Report, SceneRender, ServoLoop, Settings,
    SettingsError, SingleTexture, SwappableTexture, Virtual, queues,
};
use asperity_runtime::{Exchange, Flags, HostScene, HostTexture, Sample, SceneState, State};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

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

struct Run {
    report: Report,
    kept: ObserverLog,
    forces: Vec<[f32; 3]>,
}

/// 1,000 periods at 1 kHz, or as many as `settings` say.
fn run(
    settings: Settings,
    read: impl FnMut(u64) -> Act + Send,
    write: impl FnMut(u64) -> Act + Send,
) -> Run {
    let clock = Virtual::new();
    let (texture, renderer) = texture(1000.0);
    let mut device = Scripted::new(&clock, read, write);
    let mut kept = ObserverLog::default();
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
    let run = run(periods(1000), read, calm);
    round(2 << 13);
    let refused = Settings::at(1000).check(1000.0);
    round(0);
    assert_eq!(refused, Err(SettingsError::Rounding));
    assert_eq!(run.report.end, End::Rounding);
    assert!((500..700).contains(&run.report.ticks), "{:?}", run.report);
    assert_within_limits(&run);
}

#[test]
fn two_lost_readings_are_held_and_the_third_is_safe() {
    for (lost, safe) in [(1, false), (2, false), (3, true), (40, true)] {
        let run = run(
            periods(600),
            failing(300..300 + lost, DeviceError::TimedOut),
            calm,
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
    let run = run(periods(600), calm, failing(300..310, DeviceError::Stalled));
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

/// The loop checks its rate against the configuration of its renderer, of any type.
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
    assert_eq!(
        SwappableTexture::new(&renderer, player).config(),
        renderer.config()
    );
    let library = include_bytes!("../../formats/tests/data/scene-v2.aspl");
    let library = Library::parse(library).unwrap();
    let mut slots = vec![HostTexture::EMPTY; library.index().len()];
    let scene = HostScene::load(&library, renderer.config(), &mut slots).unwrap();
    let in_scene = SceneRender {
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
    let mut played = SwappableTexture::new(&renderer, player);
    let asset = include_bytes!("../../runtime/tests/data/builtin-v1.asp");
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
    let run = run(periods(600), read, calm);
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
        kept: ObserverLog::default(),
        forces: device.forces,
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
    let (record_writer, mut record_reader) = queues(8);
    let settings = periods(100);
    let report = ServoLoop::new(&mut device, render, clock, record_writer, settings).run(&NEVER);
    assert_eq!(report.missed, 0);
    assert!(report.ticks >= 100 && !record_reader.is_over());
    let kept: Vec<u64> = std::iter::from_fn(|| record_reader.record().map(|r| r.period)).collect();
    assert_eq!(kept, (0..8).collect::<Vec<_>>());
    assert_eq!(record_reader.lost(), report.ticks - 8);
    assert!(record_reader.is_over());
}

#[test]
fn a_slow_reader_loses_the_latest_events_and_they_are_counted() {
    let back = |period| Event::Back {
        period,
        faulty_ticks: 1,
    };
    let (mut record_writer, mut record_reader) = queues(1);
    assert_eq!((record_reader.event(), record_reader.lost()), (None, 0));
    for period in 0..1000 {
        record_writer.event(back(period));
    }
    let kept: Vec<Event> = std::iter::from_fn(|| record_reader.event()).collect();
    assert!((1..1000).contains(&kept.len()));
    assert_eq!(kept, (0..kept.len() as u64).map(back).collect::<Vec<_>>());
    assert_eq!(record_reader.lost(), 1000 - kept.len() as u64);
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
