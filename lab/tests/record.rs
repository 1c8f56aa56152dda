//! A recording of the simulated Touch with the simulated accelerometer, in virtual time: what an
//! import makes of it is held against the texture that was stroked.

use asperity::{
    emit::lower,
    pipeline::Pipeline,
    sources::{builtin, recording},
};
use asperity_experiments::import_accuracy::{Sensors, compare_at};
use asperity_formats::Asset;
use asperity_host::servo::{Event, Observer, Record, ServoLoop, Settings, SingleTexture, Virtual};
use asperity_lab::capture::{
    About, Batch, Coverage, FILES, LineDecoder, NextStep, Plan, Samples, SensorDescription,
    Simulated, Take, part, write,
};
use asperity_recording::check::Severity;
use asperity_recording::signal::quantile::{median, quantile};
use asperity_runtime::{Config, HostTexture, Limits, Renderer, State};
use asperity_sim::device::DeviceConfig;
use asperity_sim::hand::{Grip, GripPreset};
use asperity_sim::host_device::{Hands, Pace, SimDevice};
use std::fs;
use std::sync::atomic::AtomicBool;

/// A port that keeps bytes for 1 ms and up to 15 ms more, as a USB converter does, ns.
const PORT_NS: (u64, u64) = (1_000_000, 15_000_000);

/// Records on the servo thread, which a real one does not: time is virtual here, and waits.
struct Recorder {
    take: Take,
    sensor: Simulated,
    lines: LineDecoder,
    ticks: u64,
    visits: Vec<(f32, f32)>,
}

impl Observer for Recorder {
    fn tick(&mut self, record: &Record) {
        self.ticks += 1;
        self.take.tick(record);
        self.visits
            .push((record.output.speed_mm_s, record.output.normal_force_n));
        let Some(lines) = self.sensor.tick(record) else {
            return;
        };
        let mut samples = Samples::default();
        self.lines
            .feed(lines.as_bytes(), &mut samples)
            .expect("lines");
        if samples.is_empty() {
            return;
        }
        let told = SensorDescription {
            layout: self.lines.layout().expect("a header").clone(),
            stated_scale: Some(1.0),
        };
        // Some number without a pattern.
        let held_ns = self.ticks.wrapping_mul(2_654_435_761) % PORT_NS.1;
        let batch = Batch {
            arrived_ns: record.times.due_ns + PORT_NS.0 + held_ns,
            samples,
        };
        self.take.batch(&told, &batch);
    }

    fn event(&mut self, event: Event) {
        panic!("{event:?}");
    }
}

/// Strokes the built-in texture for some seconds.
fn record(seconds: u64) -> Recorder {
    let device = DeviceConfig::touch().expect("built in");
    let grip = Grip::preset(GripPreset::Firm).expect("built in");
    let lowered = lower::lower(&builtin::texture(), None).expect("built in");
    let asset = Asset::parse(&lowered.bytes).expect("built in");
    let mut texture = Box::new(HostTexture::new());
    texture.load(&asset, 1000.0).expect("it fits");
    let config = Config {
        limits: Limits {
            peak_n: device.actuator.peak_force_n as f32,
            ..Config::default().limits
        },
        mechanics: device.mechanics_config(),
        ..Config::default()
    };
    let renderer = Renderer::new(&config).expect("valid");
    let sensor = Simulated::new(1000.0, f64::from(asset.coupling().effective_mass_kg), 7);
    let plan = Plan {
        coverage: Coverage::new(&[20.0, 40.0, 80.0, 160.0], &[0.3, 0.8, 1.6], 1.0).expect("a grid"),
        taps: 2,
        air_s: 2.0,
        is_sensor: false,
    };
    let mut recorder = Recorder {
        take: Take::new(
            plan,
            1000.0,
            true,
            sensor.delay_s() + 1e-9 * PORT_NS.0 as f64,
        ),
        sensor,
        lines: LineDecoder::new("sim:", None),
        ticks: 0,
        visits: Vec::new(),
    };
    let mut device = SimDevice::with(&device, grip, 5, 1000, Pace::Stepped, Hands::Record);
    let render = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(3),
    };
    let settings = Settings {
        periods: Some(1000 * seconds),
        ..Settings::at(1000)
    };
    let stop = AtomicBool::new(false);
    ServoLoop::new(&mut device, render, Virtual::new(), &mut recorder, settings).run(&stop);
    recorder
}

#[test]
fn the_texture_that_was_stroked_comes_back_from_the_folder() {
    let recorder = record(60);
    let take = &recorder.take;
    let exploration = take.exploration();
    assert!(
        exploration.taps().iter().all(|taps| *taps >= 2),
        "{:?}",
        exploration.taps()
    );
    assert_eq!(
        exploration.next_step(),
        NextStep::Nothing,
        "{:?}",
        exploration.coverage()
    );

    let part = part(take).expect("a recording");
    assert!(part.seconds > 59.0 && (part.rate_hz - 5000.0).abs() < 1.0);
    let about = About {
        name: "grit".into(),
        device: "simulated".into(),
        tool: None,
        mass_kg: None,
        full_acceleration: None,
        full_force: None,
    };
    let folder = tempfile::tempdir().expect("a folder");
    for (which, name) in FILES.iter().enumerate() {
        let mut file = fs::File::create(folder.path().join(name)).expect("a file");
        write(which, &about, take, &part, &mut file).expect("room");
    }

    let (_, checked, _) = recording::check(folder.path()).expect("a recording");
    let faults: Vec<String> = checked
        .at_least(Severity::Fault)
        .map(ToString::to_string)
        .collect();
    assert!(faults.is_empty(), "{faults:?}");

    let analysis =
        recording::analyse(folder.path(), false, &mut Pipeline::default()).expect("a texture");
    let found = compare_at(
        &builtin::texture(),
        recorder.visits,
        Sensors::seeded(1).accel_noise,
        &analysis,
    );
    let levels = || found.cells.iter().map(|cell| cell.level_db.abs());
    let errors = || found.cells.iter().map(|cell| cell.error_db);
    let (spectrum_db, worst_db) = (median(errors()), quantile(errors(), 0.95));
    let (level_db, mu) = (median(levels()), found.mu.expect("friction"));
    println!(
        "{} cells: spectrum {spectrum_db:.2} dB RMS in the median, {worst_db:.2} dB at 95 %; level {level_db:.2} dB; μ {:.1} %; taps {:?} dB",
        found.cells.len(),
        100.0 * mu,
        found.taps_db
    );
    assert!(found.cells.len() >= 15, "{} cells", found.cells.len());
    assert!(spectrum_db < 2.0, "{spectrum_db} dB RMS");
    assert!(level_db < 1.0, "{level_db} dB");
    assert!(mu.abs() < 0.05, "{mu}");
}

#[test]
fn the_sensors_clock_and_its_known_delay_are_taken_away() {
    let recorder = record(20);
    let clock = recorder.take.clock().expect("a clock");
    // Its samples are timed 3.21 s late on a clock that is 40 ppm too slow; the loop begins at 0.
    for own_s in [4.0, 13.0, 22.0] {
        let taken_s = (own_s - 3.21) * (1.0 + 40e-6);
        let late_s =
            clock.host_s(own_s) - recorder.sensor.delay_s() - 1e-9 * PORT_NS.0 as f64 - taken_s;
        assert!(late_s.abs() < 0.003, "{late_s} s at {own_s} s");
    }
}
