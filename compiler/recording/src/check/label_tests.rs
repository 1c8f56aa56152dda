//! Dead, dying, copied, counted and misnamed channels, at the limits for a report.

use super::*;
use crate::{
    description::Axis,
    signal::noise::white,
    test_recordings::{self, described},
};

fn of(quantity: Quantity, axis: Axis, values: &[f64]) -> Channel {
    test_recordings::channel(quantity, axis, 1000.0, values)
}

#[test]
fn a_channel_of_one_value_is_dead_from_two_numbers_on() {
    let dead = |values: &[f64]| is_dead(&of(Quantity::Force, Axis::Z, values));
    assert!(dead(&[2.0, 2.0]));
    assert!(!dead(&[2.0, 2.5]));
    assert!(!dead(&[2.0]));
    assert!(!dead(&[2.0, f64::NAN]));
    assert!(dead(&[2.0, f64::NAN, 2.0]));
}

#[test]
fn a_dead_axis_is_a_note_where_another_axis_moves_and_a_fault_elsewhere() {
    let moves: Vec<f64> = white(1, 500, 1);
    let still = [0.0; 500];
    let told = |channels: Vec<Channel>| -> Vec<(String, Severity)> {
        let (_, found) = check(&test_recordings::recording(channels));
        found.into_iter().map(|f| (f.channel, f.severity)).collect()
    };
    let (x, y) = (Axis::X, Axis::Y);
    let position = |axis, values: &[f64]| of(Quantity::Position, axis, values);
    assert_eq!(
        told(vec![position(x, &moves), position(y, &still)]),
        [("position y".into(), Severity::Note)]
    );
    assert_eq!(
        told(vec![position(x, &still), position(y, &still)]),
        [
            ("position x".into(), Severity::Fault),
            ("position y".into(), Severity::Fault)
        ]
    );
    assert_eq!(
        told(vec![
            position(x, &moves),
            of(Quantity::Force, Axis::Z, &still)
        ]),
        [("force z".into(), Severity::Fault)]
    );
    assert_eq!(
        told(vec![of(Quantity::Torque, Axis::Z, &still)]),
        [("torque z".into(), Severity::Note)]
    );
    let (dead, _) = check(&test_recordings::recording(vec![
        position(x, &moves),
        position(y, &still),
    ]));
    assert_eq!(dead, [false, true]);
}

/// Noise that rests for some samples and stands still at its end.
fn ends(count: usize, rest: usize, end: usize) -> Vec<f64> {
    let mut values = white(3, count, 1);
    let value = values[100];
    values[100..100 + rest].fill(value);
    values[count - end..].fill(9.0);
    values
}

#[test]
fn a_sensor_died_if_it_stands_still_for_half_a_second_a_twenty_fifth_and_five_rests() {
    let died = |count, rest, end| {
        let channel = of(Quantity::Acceleration, Axis::Z, &ends(count, rest, end));
        let recording = test_recordings::recording(vec![channel.clone()]);
        died(&recording, &[false], &channel)
    };
    let fault = Some(Severity::Fault);
    assert_eq!((died(5000, 1, 500), died(5000, 1, 499)), (fault, None));
    assert_eq!((died(20_000, 1, 800), died(20_000, 1, 799)), (fault, None));
    assert_eq!((died(5000, 120, 600), died(5000, 121, 600)), (fault, None));
}

#[test]
fn a_hand_may_rest_at_the_end_and_a_force_may_not() {
    let quiet = |axis, end| of(Quantity::Position, axis, &ends(4000, 1, end));
    let of_first = |channels: Vec<Channel>, dead: &[bool]| {
        let first = channels[0].clone();
        died(&test_recordings::recording(channels), dead, &first)
    };
    let (x, y) = (Axis::X, Axis::Y);
    // All axes of the motion for a quarter of the recording.
    let warning = Some(Severity::Warning);
    assert_eq!(
        of_first(vec![quiet(x, 1000), quiet(y, 1000)], &[false; 2]),
        warning
    );
    assert_eq!(
        of_first(vec![quiet(x, 999), quiet(y, 1000)], &[false; 2]),
        None
    );
    assert_eq!(
        of_first(vec![quiet(x, 1000), quiet(y, 1)], &[false; 2]),
        None
    );
    assert_eq!(
        of_first(vec![quiet(x, 1000), quiet(y, 1)], &[false, true]),
        warning
    );
    let force = of(Quantity::Force, Axis::Z, &ends(4000, 1, 500));
    assert_eq!(of_first(vec![force, quiet(y, 1)], &[false; 2]), warning);
    let (_, found) = check(&test_recordings::recording(vec![quiet(x, 1000)]));
    assert!(
        found[0].what.contains("from 3.000 s to its end, at 9 m"),
        "{}",
        found[0].what
    );
}

#[test]
fn a_copy_is_the_same_quantity_sample_by_sample_and_not_short() {
    let noise = white(4, 101, 1);
    let accel = |values: &[f64]| of(Quantity::Acceleration, Axis::X, values);
    assert!(is_copy(&accel(&noise), &accel(&noise)));
    assert!(!is_copy(&accel(&noise[..100]), &accel(&noise[..100])));
    assert!(!is_copy(&accel(&[1.0; 200]), &accel(&[1.0; 200])));
    assert!(!is_copy(
        &accel(&noise),
        &of(Quantity::Force, Axis::X, &noise)
    ));
    let mut other = noise.clone();
    other[50] += 0.1;
    assert!(!is_copy(&accel(&noise), &accel(&other)));
    let (_, found) = check(&test_recordings::recording(vec![
        accel(&noise),
        of(Quantity::Acceleration, Axis::Y, &noise),
    ]));
    assert_eq!((found.len(), found[0].kind), (1, FindingKind::Mislabelled));
    assert!(
        found[0].what.contains("the values of acceleration x"),
        "{}",
        found[0].what
    );
    assert_eq!(found[0].channel, "acceleration y");
}

fn ramp(count: usize, step: f64) -> Vec<f64> {
    (0..count).map(|n| 5.0 + step * n as f64).collect()
}

#[test]
fn a_straight_line_is_a_counter_if_its_slope_is_that_of_rows_or_of_a_clock() {
    let told = |values: &[f64], unit: f64| {
        let mut said = described(Quantity::Position, Axis::X);
        said.scale = unit;
        counter(&of(Quantity::Position, Axis::X, values), &said)
    };
    // At 1000 rows a second.
    assert_eq!(told(&ramp(200, 1.0), 1.0), Some("rows"));
    assert_eq!(told(&ramp(200, 0.001), 0.001), Some("rows"));
    assert_eq!(told(&ramp(200, 0.001), 1.0), Some("seconds"));
    assert_eq!(told(&ramp(200, 1000.0), 1.0), Some("microseconds"));
    assert_eq!(told(&ramp(200, 1e6), 1.0), Some("nanoseconds"));
    assert_eq!(told(&ramp(200, 0.001 * 1.009), 1.0), Some("seconds"));
    assert_eq!(told(&ramp(200, 0.001 * 1.011), 1.0), None);
    assert_eq!(told(&ramp(200, 0.001 * 0.989), 1.0), None);
    assert_eq!(told(&ramp(200, -0.001), 1.0), None);
    assert_eq!(told(&ramp(100, 1.0), 1.0), Some("rows"));
    assert_eq!(told(&ramp(99, 1.0), 1.0), None);
    assert_eq!(told(&[5.0; 200], 1.0), None);
    assert_eq!(told(&[], 1.0), None);
    // Steps of a packet: 2 % of the range, 4 of 200.
    let bent = |off: f64| {
        let mut values = ramp(201, 1.0);
        values[100] += off;
        values
    };
    assert_eq!(told(&bent(3.9), 1.0), Some("rows"));
    assert_eq!(told(&bent(-3.9), 1.0), Some("rows"));
    assert_eq!(told(&bent(4.1), 1.0), None);
    assert_eq!(told(&bent(-4.1), 1.0), None);
}

#[test]
fn milliseconds_of_a_slow_clock_are_told_from_rows() {
    let mut channel = of(Quantity::Force, Axis::Z, &ramp(200, 4.0));
    channel.clock.rate_hz = 250.0;
    let said = described(Quantity::Force, Axis::Z);
    assert_eq!(counter(&channel, &said), Some("milliseconds"));
    let (_, found) = check(&test_recordings::recording(vec![channel]));
    assert_eq!(
        (found[0].kind, found[0].severity),
        (FindingKind::Mislabelled, Severity::Fault)
    );
    assert!(
        found[0]
            .what
            .contains("counts milliseconds, which no force does")
    );
}

#[test]
fn the_name_of_a_column_contradicts_another_quantity_or_another_unit() {
    let told = |name: &str, unit: &str, scale: f64| {
        let mut said = described(Quantity::Acceleration, Axis::X);
        said.column = Column::Name(name.into());
        said.unit = Unit::named(unit, Quantity::Acceleration).expect("a unit");
        said.scale = scale;
        contradiction(&said).map(|(kind, _)| kind)
    };
    assert_eq!(told("accel_x (g)", "g", 1.0), None);
    assert_eq!(told("accel_x (g)", "m/s^2", 1.0), Some(FindingKind::Unit));
    assert_eq!(told("accel_x (g)", "m/s^2", 9.81), None);
    assert_eq!(told("accel_x", "m/s^2", 1.0), None);
    assert_eq!(
        told("force_x (N)", "m/s^2", 1.0),
        Some(FindingKind::Mislabelled)
    );
    assert_eq!(told("banana", "m/s^2", 1.0), None);
    assert!(contradiction(&described(Quantity::Force, Axis::Z)).is_none());
}
