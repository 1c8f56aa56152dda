//! A session of a servo loop, recorded and played in another loop: the same forces, bit for bit,
//! however late either of them was.

use crate::support::{Act, ObserverLog, Scripted, texture};
use asperity_host::device::DeviceError;
use asperity_host::device::replay::{AtEnd, Replay};
use asperity_host::servo::{
    End, Event, Overrun, Pace, Record, Render, ServoLoop, Settings, SingleTexture, Virtual,
};
use asperity_host::session_log::{
    Conditions, Encoder, FromServo, SessionLog, TextureInfo, pace, render_again,
};
use asperity_runtime::{Config, State};
use std::sync::atomic::AtomicBool;

const PERIOD_NS: u64 = 1_000_000;
const SEED: u64 = 9;
const BUILTIN: &[u8] = include_bytes!("../../runtime/tests/data/builtin-v1.asp");
static NEVER: AtomicBool = AtomicBool::new(false);

fn settings(overrun: Overrun, pace: Pace) -> Settings {
    Settings {
        periods: Some(3000),
        overrun,
        pace,
        ..Settings::at(1000)
    }
}

/// Faults, silence, forces that do not arrive, late readings, and a recovery.
fn session(overrun: Overrun) -> ObserverLog {
    let clock = Virtual::new();
    let (texture, renderer) = texture(1000.0);
    let read = |call: u64| Act {
        takes_ns: match call % 701 {
            600 => 7 * PERIOD_NS / 2,
            650 => PERIOD_NS,
            _ => 0,
        },
        fault: match call % 997 {
            200..207 => Some(DeviceError::TimedOut),
            400..480 => Some(DeviceError::Disconnected),
            _ => None,
        },
        old: matches!(call % 389, 100 | 200..205),
    };
    let write = |call: u64| Act {
        fault: (call % 443 == 300).then_some(DeviceError::Stalled),
        ..Act::default()
    };
    let mut device = Scripted::new(&clock, read, write);
    device.recovers = true;
    device.recovery_ns = 9 * PERIOD_NS;
    let render = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(SEED),
    };
    let mut kept = ObserverLog::default();
    let settings = settings(overrun, Pace::Clock);
    let report = ServoLoop::new(&mut device, render, clock, &mut kept, settings).run(&NEVER);
    assert!(report.missed > 5 && report.read_faults > 50 && report.write_faults > 3);
    assert!(report.recovered > 0 && report.paused > 0 && report.episodes > 10);
    kept
}

fn recording(records: &[Record]) -> SessionLog {
    let conditions = Conditions {
        program: "test".into(),
        device: "scripted".into(),
        texture: Some(TextureInfo::of("built in", BUILTIN)),
        scene: None,
        seed: SEED,
        config: Config::default(),
    };
    let mut encoder = Encoder::new(Vec::new(), &conditions).expect("a vector takes all");
    let mut entries = FromServo::default();
    for record in records {
        encoder
            .push(&entries.entry(record))
            .expect("a vector takes all");
    }
    let (bytes, _) = encoder.finish(entries.lost()).expect("a vector takes all");
    SessionLog::read(&mut &bytes[..]).expect("a recording")
}

/// Plays a recording in a loop that is late in other ticks.
fn played(recording: &SessionLog, seed: u64) -> (ObserverLog, End, (u64, u64)) {
    let clock = Virtual::new();
    let (texture, renderer) = texture(1000.0);
    let mut replay = Replay::new(recording.clone(), AtEnd::Leave, "test").expect("a replay");
    /// A renderer that is late now and then.
    struct Late<R>(R, Virtual, u64);
    impl<R: Render> Render for Late<R> {
        fn tick(&mut self, sample: &asperity_runtime::Sample) -> asperity_runtime::Output {
            self.2 += 1;
            self.1.pass(if self.2.is_multiple_of(331) {
                5 * PERIOD_NS
            } else {
                0
            });
            self.0.tick(sample)
        }
        fn config(&self) -> &Config {
            self.0.config()
        }
        fn counters(&self) -> asperity_runtime::Counters {
            self.0.counters()
        }
    }
    let fixed = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(seed),
    };
    let render = Late(fixed, clock.clone(), 0);
    let mut kept = ObserverLog::default();
    let settings = Settings {
        periods: None,
        ..settings(Overrun::Skip, pace(recording, false))
    };
    let report = ServoLoop::new(&mut replay, render, clock, &mut kept, settings).run(&NEVER);
    assert!(report.missed > 10, "it was late: {}", report.missed);
    (kept, report.end, replay.compared())
}

fn bits(records: &[Record]) -> Vec<[u32; 3]> {
    let forces = records.iter().map(|record| record.output.force_n);
    forces.map(|force| force.map(f32::to_bits)).collect()
}

#[test]
fn a_session_with_faults_and_missed_periods_repeats_to_the_bit() {
    for overrun in [Overrun::Skip, Overrun::CatchUp] {
        let recorded = session(overrun);
        let recording = recording(&recorded.records);
        assert!(
            recording
                .entries
                .iter()
                .any(|entry| entry.sample.elapsed_ticks > 3)
        );
        let again = render_again(&recording, |_| Some(BUILTIN.to_vec())).expect("rendered");
        assert!(again.is_same() && again.compared > 2500, "{again:?}");

        let (kept, end, (forces, different)) = played(&recording, SEED);
        assert_eq!(end, End::Over, "the loop ends with the recording");
        let count = recorded.records.len().min(kept.records.len());
        assert!(count > 2500);
        assert_eq!(
            bits(&kept.records[..count]),
            bits(&recorded.records[..count])
        );
        assert_eq!(different, 0, "of {forces}");
        // The end of a recording is no fault of the device. Forces that did not arrive are none in
        // a replay.
        let failed = |kept: &ObserverLog| {
            let events = kept.events.iter();
            events
                .filter(|event| matches!(event, Event::Failed { .. }))
                .count()
        };
        assert!(failed(&kept) > 5 && failed(&kept) <= failed(&recorded));

        // The comparison can fail: another seed gives another texture.
        let (_, _, (forces, different)) = played(&recording, SEED + 1);
        assert!(different > forces / 4, "{different} of {forces}");
    }
}

#[test]
fn records_that_are_lost_on_the_way_are_told_by_the_next_entry() {
    let recorded = session(Overrun::Skip);
    let mut records = recorded.records.clone();
    records.drain(1000..1017);
    let recording = recording(&records);
    assert_eq!(recording.entries[1000].lost_before, 17);
    assert_eq!(recording.lost(), 17);
    let again = render_again(&recording, |_| Some(BUILTIN.to_vec())).expect("rendered");
    assert_eq!((again.compared, again.different), (1000, 0));
}
