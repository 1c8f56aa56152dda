//! Findings about clocks, gravity and contact.

use super::*;
use crate::{reader::FileClock, test_recordings};

fn touching(samples: usize) -> Option<Severity> {
    let mut timeline = test_recordings::timeline(1000);
    timeline.contact[samples..].fill(false);
    contact(&timeline).map(|finding| finding.severity)
}

#[test]
fn contact_of_less_than_a_twentieth_is_a_fault_and_no_time_in_the_air_a_warning() {
    assert_eq!(touching(0), Some(Severity::Fault));
    assert_eq!(touching(49), Some(Severity::Fault));
    assert_eq!(touching(51), None);
    assert_eq!(touching(994), None);
    assert_eq!(touching(996), Some(Severity::Warning));
}

#[test]
fn gravity_is_the_size_of_the_mean_acceleration_from_half_a_metre_on() {
    let told = |x: f64, y: f64| {
        let of = |quantity, axis, value: f64| {
            test_recordings::channel(quantity, axis, 1000.0, &vec![value; 2500])
        };
        let recording = test_recordings::recording(vec![
            of(Quantity::Acceleration, Axis::X, x),
            of(Quantity::Acceleration, Axis::Y, y),
            of(Quantity::Force, Axis::Z, 7.0),
        ]);
        let aligned = Aligned::new(&recording, &[0.0; 3]).expect("long");
        gravity(&recording, &aligned).map(|finding| finding.what)
    };
    assert!(told(3.0, -4.0).expect("told").contains("of 5.00 m/s²"));
    assert_eq!(told(0.3, 0.39), None);
    assert!(told(0.3, -0.41).is_some());
}

#[test]
fn no_gravity_is_told_of_an_accelerometer_with_a_dead_axis() {
    let around = |seed, level: f64| -> Vec<f64> {
        let noise = crate::signal::noise::white(seed, 3000, 1);
        noise.iter().map(|x| level + 0.1 * x).collect()
    };
    let tells = |y: &[f64]| {
        let of = |quantity, axis, values: &[f64]| {
            test_recordings::channel(quantity, axis, 1000.0, values)
        };
        let recording = test_recordings::recording(vec![
            of(Quantity::Acceleration, Axis::X, &around(1, 5.0)),
            of(Quantity::Acceleration, Axis::Y, y),
            of(Quantity::Force, Axis::Z, &around(3, 1.0)),
            of(Quantity::Speed, Axis::Along, &around(4, 0.5)),
        ]);
        let (checked, _) = check(&recording).expect("every quantity");
        checked
            .findings
            .iter()
            .any(|f| f.kind == FindingKind::Gravity && f.severity == Severity::Good)
    };
    assert!(tells(&around(2, 0.0)));
    assert!(!tells(&[0.0; 3000]));
}

fn said(change: impl Fn(&mut FileClock)) -> Vec<(FindingKind, Severity, String)> {
    let mut recording = test_recordings::recording(vec![test_recordings::channel(
        Quantity::Force,
        Axis::Z,
        1000.0,
        &[0.0, 1.0],
    )]);
    let mut clock = FileClock {
        file: "force.csv".into(),
        stated_hz: Some(1000.0),
        clock_hz: Some(1000.0),
        jitter_s: 0.0,
        gaps: 0,
        first_gap: None,
        gap_s: 0.0,
        rows: 2,
        shortened: false,
        remarks: Vec::new(),
    };
    change(&mut clock);
    recording.clocks = vec![clock];
    let found = clocks(&recording);
    assert!(found.iter().all(|f| f.file == "force.csv"));
    found
        .into_iter()
        .map(|f| (f.kind, f.severity, f.what))
        .collect()
}

#[test]
fn drift_is_noted_beyond_five_hundred_parts_in_a_million() {
    assert_eq!(said(|_| ()), []);
    for sign in [1.0, -1.0] {
        let off = |ppm: f64| said(|c| c.clock_hz = Some(1000.0 * (1.0 + 1e-6 * sign * ppm)));
        assert_eq!(off(499.0), []);
        let found = off(501.0);
        assert_eq!(
            (found[0].0, found[0].1),
            (FindingKind::Drift, Severity::Note)
        );
        let told = if sign > 0.0 { "+501 ppm" } else { "-501 ppm" };
        assert!(found[0].2.contains(told), "{found:?}");
    }
    assert_eq!(
        said(|c| {
            c.clock_hz = Some(900.0);
            c.stated_hz = None;
        }),
        []
    );
    assert_eq!(said(|c| c.clock_hz = None), []);
}

#[test]
fn jitter_is_a_warning_beyond_three_periods_of_the_clock() {
    assert_eq!(said(|c| c.jitter_s = 0.0029), []);
    let found = said(|c| c.jitter_s = 0.0031);
    assert_eq!(
        (found[0].0, found[0].1),
        (FindingKind::Drift, Severity::Warning)
    );
    assert!(found[0].2.contains("by 3.1 ms"), "{found:?}");
    assert_eq!(
        said(|c| {
            c.clock_hz = None;
            c.jitter_s = 9.0;
        }),
        []
    );
}

#[test]
fn gaps_and_files_that_were_shortened_are_told() {
    let found = said(|c| {
        (c.gaps, c.gap_s, c.first_gap) = (2, 0.25, Some(77));
        c.shortened = true;
    });
    assert_eq!(found.len(), 2);
    assert_eq!(
        (found[0].0, found[0].1),
        (FindingKind::DropOut, Severity::Fault)
    );
    assert!(
        found[0]
            .2
            .contains("2 gaps, 0.250 s in all, the first before line 77"),
        "{found:?}"
    );
    assert_eq!(
        (found[1].0, found[1].1),
        (FindingKind::Short, Severity::Note)
    );
    assert_eq!(said(|c| c.gaps = 1).len(), 1);
}
