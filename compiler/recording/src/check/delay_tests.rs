//! Delays of synthetic pairs, just inside and outside the limits for a report.

use super::*;
use crate::{
    signal::noise::white,
    test_recordings::{self, near},
};

/// Noise, and the same noise later by so many samples and under noise of its own.
fn pair(late: usize, noise: f64, count: usize) -> (Vec<f64>, Vec<f64>) {
    let (source, own) = (white(1, count + 200, 12), white(2, count, 12));
    let first = source[100..100 + count].to_vec();
    let second = (0..count)
        .map(|n| source[100 + n - late] + noise * own[n])
        .collect();
    (first, second)
}

#[test]
fn a_delay_is_told_in_seconds_if_the_signals_are_alike() {
    for late in [0, 3, 25, 70] {
        let found = lag(&vec![pair(late, 0.0, 4000)], (30.0, 250.0)).expect("alike");
        near(found, late as f64 / 1000.0, 2e-4);
        let (first, second) = pair(late, 0.0, 4000);
        near(
            lag(&vec![(second, first)], (30.0, 250.0)).expect("alike"),
            -(late as f64) / 1000.0,
            2e-4,
        );
    }
    // A correlation of 1/√(1 + noise²): 0.32 and 0.2.
    assert!(lag(&vec![pair(20, 3.0, 8000)], (30.0, 250.0)).is_some());
    assert!(lag(&vec![pair(20, 5.0, 8000)], (30.0, 250.0)).is_none());
    assert!(lag(&Vec::new(), (30.0, 250.0)).is_none());
    // 80 ms each way need 324 samples.
    assert!(lag(&vec![pair(0, 0.0, 324)], (30.0, 250.0)).is_some());
    assert!(lag(&vec![pair(0, 0.0, 323)], (30.0, 250.0)).is_none());
}

#[test]
fn a_peak_that_has_a_rival_tells_no_delay() {
    // An echo as strong as the signal, 30 ms later.
    let source = white(5, 4200, 12);
    let first = source[100..4100].to_vec();
    let echo = |part: f64| {
        (0..4000)
            .map(|n| source[100 + n] + part * source[70 + n])
            .collect()
    };
    assert!(lag(&vec![(first.clone(), echo(1.0))], (30.0, 250.0)).is_none());
    near(
        lag(&vec![(first, echo(0.8))], (30.0, 250.0)).expect("clear"),
        0.0,
        2e-4,
    );
}

#[test]
fn a_delay_that_is_no_surer_than_its_band_is_not_told() {
    // σ = √((1/ρ² − 1)/(2·B·T))/(π·(low + high)), with 1/ρ² − 1 = 4 and 4 s.
    let at = |late: usize, band: (f64, f64)| lag(&vec![pair(late, 2.0, 4000)], band).is_some();
    // Of 0.5 Hz around 1.25 Hz: 2/√4/7.85 = 127 ms, and nothing beyond 8 ms is sure.
    assert!(!at(20, (1.0, 1.5)) && at(5, (1.0, 1.5)));
    // Of 40 Hz around 22 Hz: 2/√320/138 = 0.8 ms.
    assert!(at(20, (2.0, 42.0)));
    // Of 3 Hz around 3.5 Hz: 2/√24/22 = 18.6 ms, three of which are 56.
    assert!(!at(40, (2.0, 5.0)) && at(75, (2.0, 5.0)));
}

fn with(channels: Vec<crate::channel::Channel>) -> (Vec<FileDelay>, Vec<Finding>) {
    let recording = test_recordings::recording(channels);
    let count = recording.channels.len();
    let aligned = Aligned::new(&recording, &vec![0.0; count]).expect("long");
    check(&recording, &aligned, &vec![false; count])
}

#[test]
fn a_force_that_shows_the_vibration_late_is_corrected_with_a_warning_from_eight_milliseconds_on() {
    let z = Axis::Z;
    let found = |late: usize, rate_hz: f64| {
        let (accel, force) = pair(late, 0.2, 5000);
        let force = test_recordings::channel(Quantity::Force, z, rate_hz, &force);
        with(vec![
            test_recordings::channel(Quantity::Acceleration, z, rate_hz, &accel),
            force,
        ])
    };
    for (late, severity) in [
        (0, Severity::Good),
        (7, Severity::Good),
        (9, Severity::Warning),
    ] {
        let (delays, findings) = found(late, 1000.0);
        assert_eq!(delays.len(), 1);
        near(delays[0].late_s, late as f64 / 1000.0, 2e-4);
        assert_eq!(
            (findings.len(), findings[0].severity),
            (1, severity),
            "{late}"
        );
        let told = format!("it comes {:.1} ms after", late as f64);
        assert!(
            findings[0].what.contains(&told) || late == 0,
            "{}",
            findings[0].what
        );
    }
    // A slow sensor shows no vibration.
    assert_eq!(found(9, 600.0).0.len(), 1);
    let (delays, findings) = found(9, 599.0);
    assert!(delays.is_empty());
    assert_eq!(
        (findings[0].kind, findings[0].severity),
        (FindingKind::Delay, Severity::Note)
    );
    assert!(findings[0].what.contains("shares no vibration"));
}

#[test]
fn the_motion_of_a_position_is_its_second_derivative() {
    let at = |n: usize| n as f64 / RATE_HZ;
    let wave = |t: f64| 0.01 * libm::sin(25.0 * t);
    let position: Vec<f64> = (0..5000).map(|n| wave(at(n))).collect();
    let accel: Vec<f64> = (0..5000).map(|n| -625.0 * wave(at(n))).collect();
    let recording = test_recordings::recording(vec![
        test_recordings::channel(Quantity::Acceleration, Axis::X, 1000.0, &accel),
        test_recordings::channel(Quantity::Position, Axis::X, 1000.0, &position),
        test_recordings::channel(Quantity::Position, Axis::Y, 1000.0, &position),
    ]);
    let aligned = Aligned::new(&recording, &[0.0; 3]).expect("long");
    let pairs = motion(&recording, &aligned, &[false; 3]);
    assert_eq!(pairs.len(), 1, "y has no acceleration");
    for n in 1000..4000 {
        near(pairs[0].0[n], pairs[0].1[n], 0.02);
    }
    assert!(pairs[0].0[1000..4000].iter().any(|a| a.abs() > 5.0));
    assert!(motion(&recording, &aligned, &[false, true, false]).is_empty());
}

#[test]
fn friction_is_the_direction_of_the_motion_and_the_force_against_it() {
    let constant = |quantity, axis, value: f64| {
        test_recordings::channel(quantity, axis, 1000.0, &vec![value; 3000])
    };
    let of = |vx: f64, vy: f64| {
        let recording = test_recordings::recording(vec![
            constant(Quantity::Speed, Axis::X, vx),
            constant(Quantity::Speed, Axis::Y, vy),
            constant(Quantity::Force, Axis::X, 0.25),
        ]);
        let aligned = Aligned::new(&recording, &[0.0; 3]).expect("long");
        friction(&recording, &aligned, &[false; 3])
    };
    let pairs = of(0.06, -0.08);
    assert_eq!(pairs.len(), 1);
    near(pairs[0].0[1500], 0.6, 1e-6);
    near(pairs[0].1[1500], -0.25, 1e-6);
    // Slower than 10 mm/s, the direction fades.
    near(of(0.003, 0.004)[0].0[1500], 0.3, 1e-6);
}
