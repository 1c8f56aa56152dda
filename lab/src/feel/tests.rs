//! A session on the built-in texture, and what its reports say.

use super::*;
use asperity_formats::Asset;
use asperity_runtime::{Config, Flags, HostTexture, Renderer};

use asperity_sim::device::{DeviceConfig, norm};
use asperity_sim::fault::{FaultInjector, FaultPlan, SampleFault};
use asperity_sim::hand::{Grip, GripPreset, Motion, Script};
use asperity_sim::servo::RenderedTexture;
use asperity_sim::session::Session;

fn built_in() -> Vec<u8> {
    asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
        .expect("built in")
        .bytes
}

fn options(seed: u64) -> FeelOptions {
    FeelOptions {
        device: DeviceConfig::touch().expect("built-in file"),
        grip: Grip::preset(GripPreset::Light).expect("built-in file"),
        seed,
        seconds: None,
    }
}

fn felt(options: &FeelOptions) -> Recording {
    let bytes = built_in();
    let asset = Asset::parse(&bytes).expect("a valid asset");
    record(&asset, "built in", options).expect("a recording")
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_does_not() {
    let [first, again, other] = [1, 1, 2].map(|seed| felt(&options(seed)));
    let bytes = |r: &Recording| {
        (
            csv::encode(r).expect("CSV"),
            wav::encode(r).expect("WAV").bytes,
            sheet::draw(r).expect("PNG"),
            Summary::new(r).to_string(),
        )
    };
    assert!(bytes(&first) == bytes(&again));
    let (a, b) = (bytes(&first), bytes(&other));
    assert!(a.0 != b.0 && a.1 != b.1 && a.2 != b.2 && a.3 != b.3);
}

#[test]
fn every_scripted_tap_is_rendered_within_two_milliseconds_and_no_other() {
    for seed in 1..=5 {
        for preset in [GripPreset::Light, GripPreset::Firm] {
            let grip = Grip::preset(preset).expect("built-in file");
            let recording = felt(&FeelOptions {
                grip,
                ..options(seed)
            });
            let taps = super::taps(&recording);
            assert_eq!(taps.scripted.len(), 4);
            for tap in &taps.scripted {
                let delay_s = tap.delay_s.expect("a transient");
                assert!(delay_s <= 2e-3, "seed {seed}: {delay_s} s");
                assert!((tap.true_m_s / tap.scripted_m_s - 1.0).abs() < 0.03);
            }
            assert_eq!(taps.others_s, [0.0; 0], "seed {seed}");
        }
    }
}

#[test]
fn friction_over_a_steady_stroke_is_coulomb_and_speed_and_force_are_met() {
    let recording = felt(&options(3));
    let strokes = super::strokes(&recording);
    assert_eq!(strokes.len(), 4);
    for stroke in strokes {
        let coulomb_n = recording.texture.mu * stroke.normal_n;
        assert!(
            (stroke.friction_n / coulomb_n - 1.0).abs() < 0.01,
            "{stroke:?}"
        );
        assert!(
            (stroke.true_mm_s / stroke.scripted_mm_s - 1.0).abs() < 0.05,
            "{stroke:?}"
        );
        assert!(
            (stroke.estimated_mm_s / stroke.true_mm_s - 1.0).abs() < 0.03,
            "{stroke:?}"
        );
        assert!(
            (stroke.normal_n / stroke.wanted_n - 1.0).abs() < 0.1,
            "{stroke:?}"
        );
    }
}

#[test]
fn forces_stay_within_peak_and_slew_and_the_stylus_in_its_workspace() {
    for seed in 1..=3 {
        let recording = felt(&FeelOptions {
            seconds: Some(30.0),
            ..options(seed)
        });
        assert_eq!(recording.records.len(), 30_000);
        let summary = Summary::new(&recording);
        assert!(summary.peak_n <= 3.3 * (1.0 + 1e-6));
        assert!(summary.slew_n_s <= recording.slew_limit_n_s * (1.0 + 1e-3));
        assert_eq!(recording.device_counts.at_stop, 0);
        assert_eq!(recording.device_counts.clipped, 0);
        assert_eq!(recording.counters.faults, 0);
    }
}

#[test]
fn a_burst_of_nan_lets_the_force_fall_to_zero_within_the_slew_and_come_back() {
    let bytes = built_in();
    let asset = Asset::parse(&bytes).expect("a valid asset");
    let mut texture = Box::new(HostTexture::new());
    texture.load(&asset, 1000.0).expect("it fits");
    let config = Config::default();
    let renderer = Renderer::new(&config).expect("the default");
    let servo = RenderedTexture::new(renderer, &texture, 1);
    let servo = FaultInjector::new(servo, FaultPlan::default(), 1);
    let FeelOptions { device, grip, .. } = options(1);
    let script = Script::new(vec![Motion::Rest {
        force_n: 2.0,
        duration_s: 2.0,
    }]);
    let mut session = Session::new(&device, grip, script, servo);

    for _ in 0..1200 {
        session.tick().expect("the script runs on");
    }
    session.servo_mut().start(SampleFault::NotFinite, 100);
    let slew_n = f64::from(config.limits.slew_n_s) / 1000.0;
    let during: Vec<f64> = (0..100)
        .map(|_| {
            norm(
                session
                    .tick()
                    .expect("a record")
                    .output
                    .force_n
                    .map(f64::from),
            )
        })
        .collect();
    assert!(during[0] > 1.5, "two bad samples hold the last good one");
    // The force is held for two ticks, then falls to 0 within |F| / slew ticks.
    let falls = 2 + (during[0] / slew_n).ceil() as usize;
    assert!(during[falls..].iter().all(|&f| f == 0.0), "{during:?}");
    for pair in during.windows(2) {
        assert!((pair[1] - pair[0]).abs() <= slew_n * (1.0 + 1e-5));
    }
    let after: Vec<_> = (0..600)
        .map(|_| session.tick().expect("a record"))
        .collect();
    assert!(after[0].output.flags.contains(Flags::RAMPING));
    let back_n = norm(after[599].output.force_n.map(f64::from));
    assert!((back_n - 2.0).abs() < 0.3, "{back_n}");
}

#[test]
fn whatever_faults_come_the_force_is_finite_within_its_limits_and_felt_again() {
    let bytes = built_in();
    let asset = Asset::parse(&bytes).expect("a valid asset");
    let mut texture = Box::new(HostTexture::new());
    texture.load(&asset, 1000.0).expect("it fits");
    for seed in 1..=5 {
        let plan = FaultPlan::all(&SampleFault::ALL, 0.02, 6);
        let renderer = Renderer::new(&Config::default()).expect("the default");
        let servo = RenderedTexture::new(renderer, &texture, seed);
        let servo = FaultInjector::new(servo, plan, seed);
        let FeelOptions { device, grip, .. } = options(seed);
        let script = Script::exploration(seed, 1, device.half_extents_m());
        let mut session = Session::new(&device, grip, script, servo);
        let records = session.run(30_000);
        assert!(session.servo().counts().values().sum::<u64>() > 200);
        let force = |i: usize| records[i].output.force_n.map(f64::from);
        for i in 1..records.len() {
            assert!(norm(force(i)) <= 3.3 * (1.0 + 1e-6));
            let (now, before) = (force(i), force(i - 1));
            let step_n = norm(std::array::from_fn(|k| now[k] - before[k]));
            assert!(
                step_n <= 2.0 * (1.0 + 1e-5),
                "seed {seed}, tick {i}: {step_n}"
            );
        }
        assert_eq!(session.device_counts().not_finite, 0);
        let full = records
            .iter()
            .filter(|r| r.output.normal_force_n > 1.0)
            .count();
        assert!(full > 500, "the texture is still felt: {full}");
    }
}

#[test]
fn a_device_with_another_rate_is_refused_with_the_remedy() {
    use asperity_io::diagnostic::Diagnostic as _;
    let mut wrong = options(1);
    wrong.device.timing.servo_rate_hz = 1500.0;
    let bytes = built_in();
    let asset = Asset::parse(&bytes).expect("a valid asset");
    let error = record(&asset, "built in", &wrong).expect_err("another rate");
    assert!(
        error.remedy().contains("servo_rate_hz = 1000"),
        "{}",
        error.remedy()
    );
}

#[test]
fn a_faster_device_feels_the_same_texture() {
    let level = |rate_hz: f64| {
        let mut options = options(1);
        options.device.timing.servo_rate_hz = rate_hz;
        let recording = felt(&options);
        let sounds = recording.records.iter().map(|r| &r.output);
        let powers: Vec<f64> = sounds
            .filter(|output| output.normal_force_n > 0.5)
            .map(|output| f64::from(output.vib_m_s2).powi(2))
            .collect();
        (powers.iter().sum::<f64>() / powers.len() as f64).sqrt()
    };
    let (slow, fast) = (level(1000.0), level(5000.0));
    assert!((fast / slow - 1.0).abs() < 0.15, "{slow} {fast} m/s²");
}

#[test]
fn the_table_reads_back_to_the_same_bits() {
    let recording = felt(&FeelOptions {
        seconds: Some(1.0),
        ..options(1)
    });
    let table = csv::encode(&recording).expect("CSV");
    let mut reader = ::csv::Reader::from_reader(table.as_slice());
    assert_eq!(reader.headers().expect("a header"), csv::COLUMNS.as_slice());
    for (row, record) in reader.records().zip(&recording.records) {
        let row = row.expect("a row");
        let column = |name: &str| {
            let index = csv::COLUMNS
                .iter()
                .position(|c| *c == name)
                .expect("a column");
            row[index].to_owned()
        };
        assert_eq!(column("vib_m_s2").parse(), Ok(record.output.vib_m_s2));
        assert_eq!(column("fz_n").parse(), Ok(record.output.force_n[2]));
        assert_eq!(column("x_mm").parse(), Ok(record.true_m[0] * 1e3));
        assert_eq!(column("flags").parse(), Ok(record.output.flags.bits()));
    }
}

#[test]
fn the_sound_is_the_vibration_at_the_stated_scale() {
    let recording = felt(&FeelOptions {
        seconds: Some(9.0),
        ..options(1)
    });
    let sound = wav::encode(&recording).expect("WAV");
    let reader = hound::WavReader::new(sound.bytes.as_slice()).expect("a WAV file");
    assert_eq!(
        (reader.spec().sample_rate, reader.spec().bits_per_sample),
        (48_000, 16)
    );
    let samples: Vec<i16> = reader
        .into_samples()
        .map(|s| s.expect("a sample"))
        .collect();
    assert_eq!(samples.len(), recording.records.len() * 48);
    let full_scale = f64::from(i16::MAX);
    let loudest = samples
        .iter()
        .map(|s| f64::from(*s).abs())
        .fold(0.0, f64::max);
    assert!((loudest / full_scale - 0.891).abs() < 1e-4);
    // The sound has the power of the vibration, apart from frequencies above 430 Hz.
    let power = |x: &mut dyn Iterator<Item = f64>| x.map(|v| v * v).sum::<f64>();
    let scale = sound.gain_per_m_s2 * full_scale;
    let heard = power(&mut samples.iter().map(|s| f64::from(*s) / scale)) / 48.0;
    let felt = power(&mut recording.vibration_m_s2().into_iter());
    assert!((10.0 * (heard / felt).log10()).abs() < 0.1);
}
