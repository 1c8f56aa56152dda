//! Measured times match the injected ones: delays, omitted ticks, files, comparisons.

use crate::support::{Act, Scripted, texture};
use asperity_host::latency::{
    Collector, Conditions, Delayed, Injection, LogError, Machine, Run, Wakeups, compare,
    percentile_distribution, read_log, write_log,
};
use asperity_host::servo::{
    Observer, Overrun, Record, Render, ServoLoop, Settings, SingleTexture, Stage, Virtual,
};
use asperity_runtime::{Config, Counters, Output, Sample, State};
use hdrhistogram::Histogram;
use std::sync::atomic::AtomicBool;

/// Duration of each stage, ns.
const WAKE_NS: u64 = 5_000;
const READ_NS: u64 = 20_000;
const COMPUTE_NS: u64 = 1_000;
const WRITE_NS: u64 = 10_000;

static NEVER: AtomicBool = AtomicBool::new(false);

/// Collects on the thread of the loop, which only a test may do.
struct Collecting(Collector);

impl Observer for Collecting {
    fn tick(&mut self, record: &Record) {
        self.0.record(record);
    }

    fn event(&mut self, _: asperity_host::servo::Event) {}
}

/// A renderer whose tick takes some time.
struct Taking<R>(R, Virtual);

impl<R: Render> Render for Taking<R> {
    fn tick(&mut self, sample: &Sample) -> Output {
        self.1.pass(COMPUTE_NS);
        self.0.tick(sample)
    }

    fn config(&self) -> &Config {
        self.0.config()
    }

    fn counters(&self) -> Counters {
        self.0.counters()
    }
}

fn conditions() -> Conditions {
    Conditions {
        machine: Machine::now(None),
        rate_hz: 1000,
        overrun: "skip".into(),
        spin_us: 0,
        granted: Vec::new(),
        refused: Vec::new(),
        device: "null:".into(),
        texture: "built in".into(),
        injected: None,
        version: "0".into(),
    }
}

/// A run in virtual time; `stall` is a reading that takes so long.
fn run(periods: u64, overrun: Overrun, injection: Option<&str>, stall: Option<(u64, u64)>) -> Run {
    let clock = Virtual::new();
    clock.wake_late_by(WAKE_NS);
    let injection: Option<Injection> = injection.map(|text| text.parse().expect(text));
    let act = |takes_ns| Act {
        takes_ns,
        ..Act::default()
    };
    let read = move |call| match stall {
        Some((at, takes_ns)) if call == at => act(takes_ns),
        // Some variation, so that intervals differ.
        _ => act(READ_NS + 16 * (call * call % 97)),
    };
    let device = Scripted::new(&clock, read, |_| act(WRITE_NS));
    let mut device = Delayed::new(device, Punctual(clock.clone()), injection);
    let (texture, renderer) = texture(1000.0);
    let render = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(1),
    };
    let render = Taking(render, clock.clone());
    let render = Delayed::new(render, Punctual(clock.clone()), injection);
    let settings = Settings {
        overrun,
        periods: Some(periods),
        ..Settings::at(1000)
    };
    let collector = Collector::new(&settings, conditions(), 1e9, 1_000_000_000);
    let mut collecting = Collecting(collector);
    ServoLoop::new(&mut device, render, clock, &mut collecting, settings).run(&NEVER);
    collecting.0.finish(0)
}

/// A clock whose waits end on time, unlike the loop's own sleeps.
#[derive(Clone)]
struct Punctual(Virtual);

impl asperity_host::servo::Clock for Punctual {
    fn now_ns(&self) -> u64 {
        self.0.now_ns()
    }

    fn sleep_until(&self, until_ns: u64) {
        self.0.pass(until_ns - self.0.now_ns());
    }
}

/// Counts the values above a bound, ns.
fn above(histogram: &Histogram<u64>, bound_ns: u64) -> u64 {
    let counts = histogram.iter_recorded();
    let counts = counts.filter(|step| step.value_iterated_to() > bound_ns);
    counts.map(|step| step.count_since_last_iteration()).sum()
}

/// Values with three significant digits agree to a thousandth.
fn close(value: u64, expected: u64) -> bool {
    value.abs_diff(expected) <= expected / 1000 + 1
}

#[test]
fn a_delay_in_one_of_a_thousand_ticks_is_found_in_its_stage_and_nowhere_else() {
    for (text, delayed) in [
        ("read:300:1000", Stage::Read),
        ("compute:300:1000", Stage::Compute),
        ("write:300:1000", Stage::Write),
    ] {
        let calm = run(100_000, Overrun::Skip, None, None);
        let run = run(100_000, Overrun::Skip, Some(text), None);
        assert_eq!(run.facts.missed, 0, "300 µs fit into a period");
        for stage in Stage::PARTS {
            let (with, without) = (run.raw(stage), calm.raw(stage));
            let longer = above(&with, 250_000);
            if stage != delayed {
                assert_eq!(run.percentiles(stage), calm.percentiles(stage), "{text}");
                assert_eq!(longer, 0);
                continue;
            }
            assert_eq!(longer, 100, "{text}: one tick of a thousand");
            let base = without.max();
            let at = |quantile| with.value_at_quantile(quantile);
            assert!(at(0.9989) <= base && at(0.999_1) >= 300_000);
            // As long as the delay and the stage together; a cell of the histogram is 256 ns wide.
            assert!(with.max() < 300_000 + base + 256);
        }
        let total = above(&run.raw(Stage::Total), 300_000);
        assert_eq!(total, 100, "the sum has it as well");
        for worst in &run.facts.worst {
            assert_eq!(worst.stage, delayed.name());
            assert_eq!((worst.period + 1) % 1000, 0, "the very ticks");
        }
        assert_eq!(run.facts.worst.len(), 10);
    }
}

#[test]
fn ticks_that_were_not_recorded_are_put_back_by_the_correction() {
    // A reading takes 10.5 periods, 36 µs of which would have passed anyway.
    let stall = Some((500, 10_500_000));
    let skipped = run(2000, Overrun::Skip, None, stall);
    assert_eq!(skipped.facts.missed, 9);
    let (raw, corrected) = (skipped.raw(Stage::WakeUp), skipped.corrected(Stage::WakeUp));
    let late = |histogram: &Histogram<u64>| above(histogram, 1_000_000);
    assert_eq!((late(&raw), late(&corrected)), (1, 9));
    let made_up = run(2000, Overrun::CatchUp, None, stall);
    assert_eq!(made_up.facts.missed, 9);
    // Those that were made up for were recorded as late as they were.
    assert_eq!(late(&made_up.raw(Stage::WakeUp)), 9);
    assert_eq!(made_up.corrected(Stage::WakeUp), made_up.raw(Stage::WakeUp));
    let worst = &skipped.facts.worst;
    assert_eq!((worst[0].stage.as_str(), worst[0].period), ("read", 500));
    assert_eq!((worst[1].stage.as_str(), worst[1].period), ("wakeup", 510));
    assert!(close(skipped.facts.longest_gap_ns, 10_505_000 + 11_000));
}

#[test]
fn a_log_reads_back_and_runs_add_up() {
    let a = run(3000, Overrun::Skip, None, None);
    let bytes = write_log(&a).expect("a log");
    let back = read_log(&bytes).expect("a log");
    assert_eq!(back, a);
    let mut b = run(2000, Overrun::Skip, Some("compute:300:1000"), None);
    b.facts.began_s += 60.0;
    // The load of the last minute, which is one of them, may have changed in between.
    b.facts.conditions.clone_from(&a.facts.conditions);
    let mut both = a.clone();
    both.merge(b.clone());
    assert_eq!(both.facts.ticks, a.facts.ticks + b.facts.ticks);
    assert_eq!(both.facts.conditions.len(), 1, "the same conditions");
    for stage in Stage::ALL {
        let count = |run: &Run| run.raw(stage).len();
        assert_eq!(count(&both), count(&a) + count(&b));
    }
    assert!(both.intervals[both.intervals.len() - 1].start_s >= 60.0);
    assert_eq!(
        read_log(&write_log(&both).expect("a log")).expect("a log"),
        both
    );
}

#[test]
fn a_damaged_log_is_refused() {
    let bytes = write_log(&run(1500, Overrun::Skip, None, None)).expect("a log");
    let text = String::from_utf8(bytes.clone()).expect("text");
    let refused = |text: &str| read_log(text.as_bytes()).expect_err("damaged");
    assert!(matches!(refused("a,b\n"), LogError::NoFacts));
    assert!(matches!(
        refused(&text.replacen("\"ticks\"", "\"tocks\"", 1)),
        LogError::Facts(_)
    ));
    assert!(matches!(
        refused(&text.replacen("Tag=read", "Tag=reed", 1)),
        LogError::Tag { .. }
    ));
    let cut = &text[..text.len() - 20];
    assert!(matches!(refused(cut), LogError::Line(_)));
    for at in (0..bytes.len()).step_by(37) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 0x15;
        // Whatever comes out, nothing panics.
        let _ = read_log(&damaged);
    }
}

#[test]
fn a_distribution_ends_with_all_values() {
    let run = run(5000, Overrun::Skip, Some("read:300:1000"), None);
    let histogram = run.raw(Stage::Read);
    let text = percentile_distribution(&histogram);
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(2)
        .take_while(|line| !line.starts_with('#'))
        .map(|line| line.split_whitespace().flat_map(str::parse).collect())
        .collect();
    let last = &rows[rows.len() - 1];
    assert_eq!(last[1..], [1.0, histogram.len() as f64]);
    assert!((last[0] - 1e-3 * histogram.max() as f64).abs() < 0.001);
    assert!(
        rows.windows(2)
            .all(|two| two[0][0] <= two[1][0] && two[0][2] <= two[1][2])
    );
    assert!(text.contains("#[Mean    =") && text.contains("#[Buckets ="));
}

#[test]
fn a_shift_is_told_apart_from_none_and_the_tail_only_with_enough_values() {
    let calm = run(20_000, Overrun::Skip, None, None);
    let delayed = run(20_000, Overrun::Skip, Some("write:300:10"), None);
    let find = |shifts: &[asperity_host::latency::Shift], stage: Stage, percentile| {
        let same = |s: &&asperity_host::latency::Shift| {
            s.stage == stage.name() && s.percentile == percentile
        };
        shifts.iter().find(same).expect("a shift").clone()
    };
    let none = compare(&calm, &calm, 1);
    assert!(
        none.iter()
            .all(|shift| shift.shift_ns == 0 && !shift.is_clear())
    );
    let shifts = compare(&calm, &delayed, 1);
    assert_eq!(shifts, compare(&calm, &delayed, 1), "the same seed");
    for percentile in ["99", "99.9"] {
        let shift = find(&shifts, Stage::Write, percentile);
        assert!(shift.is_clear() && close(shift.shift_ns.unsigned_abs(), 300_000));
    }
    assert!(!find(&shifts, Stage::Write, "50").is_clear());
    assert!(!find(&shifts, Stage::Read, "99").is_clear());
    let far = find(&shifts, Stage::Write, "99.99");
    assert_eq!(far.confidence_ns, None, "20,000 ticks do not tell it");
    let beyond = |shift: &asperity_host::latency::Shift| shift.percentile == "99.999";
    assert!(!shifts.iter().any(beyond), "20,000 ticks do not carry it");
}

#[test]
fn what_cyclictest_writes_is_read() {
    let text = r#"{"file_version": 1, "cmdline:": "cyclictest -q", "rt_test_version:": "2.40",
        "return_code": 0, "num_threads": 1, "resolution_in_ns": 0, "thread": {"0": {
        "histogram": {"21": 2, "40": 7}, "cycles": 10, "min": 21, "max": 6758, "avg": 55.60,
        "cpu": 0, "node": 0}}}"#;
    let wakeups = Wakeups::parse(text.as_bytes()).expect("its format");
    assert_eq!(wakeups.counts.0, [(21_000, 2), (40_000, 7)]);
    assert_eq!((wakeups.beyond, wakeups.max_ns), (1, 6_758_000));
    assert_eq!(wakeups.version, "2.40");
    assert!(Wakeups::parse(b"{}").is_err());
}

#[test]
fn delays_are_read_and_what_is_none_is_refused() {
    let read = |text: &str| text.parse::<Injection>();
    assert_eq!(
        read("compute:300:1000").map(|i| i.to_string()),
        Ok("compute:300:1000".into())
    );
    for bad in [
        "",
        "compute",
        "wakeup:300:1000",
        "read:0:10",
        "read:1:1",
        "read:1:2:3",
        "read:-1:9",
    ] {
        assert!(read(bad).is_err(), "{bad}");
    }
}
