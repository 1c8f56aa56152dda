//! Round trip: an import reads a written folder back, gaps and missing values included.

use super::*;
use crate::capture::{Batch, Coverage, Layout, Plan, Samples, SensorDescription};
use asperity_host::device::Reading;
use asperity_host::servo::{Record, Times};
use asperity_recording::reader::{self, Recording};
use asperity_runtime::{Flags, Output, Sample};

const TOUCH_HZ: f64 = 1000.0;
const ACCEL_HZ: f64 = 4000.0;

fn take(columns: &str) -> Take {
    let coverage = Coverage::new(&[20.0, 100.0], &[0.2, 1.0], 1.0).expect("a grid");
    let layout = Layout::parse(columns).expect("columns");
    let plan = Plan {
        coverage,
        taps: 0,
        air_s: 0.0,
        is_sensor: layout.load().is_some(),
    };
    Take::new(plan, TOUCH_HZ, false, 0.0)
}

/// A tick: the tool moves at 50 mm/s along x.
fn tick(take: &mut Take, period: u64) {
    let at_ns = 5_000_000_000 + period * 1_000_000;
    take.tick(&Record {
        tick: period,
        period,
        missed: 0,
        times: Times {
            read_ns: at_ns,
            ..Times::default()
        },
        reading: Ok(Reading {
            position_m: [5e-5 * period as f32, 0.0, -0.001],
            fresh: true,
            buttons: 0,
        }),
        sample: Sample::at([0.0; 3]),
        output: Output {
            force_n: [0.0, 0.0, 0.5],
            depth_m: 0.001,
            speed_mm_s: 50.0,
            normal_force_n: 0.5,
            vib_m_s2: 0.0,
            tap_n: 0.0,
            friction_n: 0.0,
            flags: Flags::default(),
        },
        exchanges: 0,
        written: Ok(()),
    });
}

/// A sample of one axis, which holds its number, and a force if there is one.
fn sample(take: &mut Take, columns: &str, n: u64) {
    let layout = Layout::parse(columns).expect("columns");
    let own_s = 100.0 + n as f64 / ACCEL_HZ;
    let width = layout.channels().count();
    let told = SensorDescription {
        layout,
        stated_scale: Some(1.0),
    };
    let mut values = vec![n as f32 / 1000.0];
    values.resize(width, 0.25);
    let batch = Batch {
        // 2.5 s of the loop lie before the sensor's first sample.
        arrived_ns: 7_500_000_000 + (n as f64 * 1e9 / ACCEL_HZ) as u64,
        samples: Samples {
            own: vec![own_s],
            values,
        },
    };
    take.batch(&told, &batch);
}

fn about() -> About {
    About {
        name: "\"oak\"\u{7f}, planed".into(),
        device: "a test".into(),
        tool: Some("a \\ pen".into()),
        mass_kg: Some(0.02),
        full_acceleration: Some(16.0),
        full_force: None,
    }
}

fn written(take: &Take) -> Recording {
    let part = part(take).expect("a recording");
    let folder = tempfile::tempdir().expect("a folder");
    for (which, name) in FILES.iter().enumerate() {
        let mut bytes = Vec::new();
        write(which, &about(), take, &part, &mut bytes).expect("a vector has room");
        std::fs::write(folder.path().join(name), bytes).expect("a file");
    }
    reader::load(folder.path()).expect("a recording that an import reads")
}

#[test]
fn an_import_reads_names_units_limits_and_the_common_time() {
    let mut take = take("t_us,a_g");
    (0..6000).for_each(|period| tick(&mut take, period));
    (0..20_000).for_each(|n| sample(&mut take, "t_us,a_g", n));
    let recording = written(&take);
    assert_eq!(recording.description.name, about().name);
    assert_eq!(recording.description.tool.name, about().tool);
    assert_eq!(recording.description.tool.mass_kg, Some(0.02));
    let x = &recording.channels[0];
    // The sensor begins after 2.5 s of 6.
    assert_eq!((x.samples.len(), x.label.as_str()), (3500, "position x"));
    assert!((f64::from(x.samples[100]) - 5e-5 * 2600.0).abs() < 2e-6);
    let fz = &recording.channels[5];
    assert!((fz.samples[7] - 0.5).abs() < 1e-5, "{}", fz.samples[7]);
    let a = recording.channels.last().expect("acceleration");
    assert!((a.clock.rate_hz - ACCEL_HZ).abs() < 1e-3 && a.clock.start_s.abs() < 1e-3);
    assert!((a.range.expect("limits")[1] - 16.0 * 9.80665).abs() < 1e-9);
    assert_eq!(recording.channels.len(), 7);
}

#[test]
fn missed_periods_and_lost_samples_bend_no_clock() {
    let mut take = take("t_us,a_g,fz_N");
    (0..6000)
        .filter(|n| n % 7 != 3)
        .for_each(|period| tick(&mut take, period));
    let lost = |n: &u64| n % 11 != 5 && !(8000..8100).contains(n);
    (0..12_000)
        .filter(lost)
        .for_each(|n| sample(&mut take, "t_us,a_g,fz_N", n));
    let recording = written(&take);
    for clock in &recording.clocks {
        assert!(
            clock.jitter_s < 1e-5,
            "{}: {} s",
            clock.file,
            clock.jitter_s
        );
    }
    let [touch, accel] = &recording.clocks[..] else {
        panic!("two files")
    };
    assert_eq!((touch.gaps, accel.gaps), (0, 1));
    let x = &recording.channels[0].samples;
    let worst = x
        .iter()
        .zip(0..)
        .map(|(x, n)| (f64::from(*x) - 5e-5 * (2500.0 + f64::from(n))).abs());
    assert!(
        worst.fold(0.0, f64::max) < 2e-6,
        "places between ticks are interpolated"
    );
    // The force is the sensor's alone.
    let forces = recording
        .channels
        .iter()
        .filter(|c| c.label.starts_with("force"));
    assert_eq!(forces.count(), 1);
}

#[test]
fn what_comes_after_a_long_gap_is_left_out_and_less_than_a_second_is_nothing() {
    let mut with_gap = take("t_us,a_g");
    (0..9000)
        .filter(|n| !(5000..6500).contains(n))
        .for_each(|n| tick(&mut with_gap, n));
    (0..26_000).for_each(|n| sample(&mut with_gap, "t_us,a_g", n));
    let found = part(&with_gap).expect("a recording");
    assert!(
        found.is_cut && (found.seconds - 2.5).abs() < 0.01,
        "{} s",
        found.seconds
    );
    assert_eq!(written(&with_gap).clocks[0].gaps, 0);

    let mut short = take("t_us,a_g");
    (0..9000).for_each(|n| tick(&mut short, n));
    assert_eq!(part(&short), None, "no sensor");
    (0..3900).for_each(|n| sample(&mut short, "t_us,a_g", n));
    assert_eq!(part(&short), None, "0.975 s");
    (3900..4100).for_each(|n| sample(&mut short, "t_us,a_g", n));
    assert!(part(&short).is_some());
}

#[test]
fn a_full_disk_is_an_error_of_every_file() {
    struct Full(usize);
    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let taken = bytes.len().min(self.0);
            self.0 -= taken;
            if taken == 0 {
                return Err(io::ErrorKind::StorageFull.into());
            }
            Ok(taken)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mut take = take("t_us,a_g");
    (0..6000).for_each(|period| tick(&mut take, period));
    (0..12_000).for_each(|n| sample(&mut take, "t_us,a_g", n));
    let part = part(&take).expect("a recording");
    for which in 0..FILES.len() {
        for room in [0, 100, 400] {
            let error = write(which, &about(), &take, &part, &mut Full(room)).expect_err("no room");
            assert_eq!(error.kind(), io::ErrorKind::StorageFull);
        }
    }
}
