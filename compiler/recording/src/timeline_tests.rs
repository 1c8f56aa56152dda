//! Timelines of channels whose motion and load are known.

use super::*;
use crate::test_recordings::{channel, near, recording};

const SECONDS: usize = 4;

fn along(quantity: Quantity, axis: Axis, value: impl Fn(f64) -> f64) -> crate::channel::Channel {
    let values: Vec<f64> = (0..SECONDS * 1000)
        .map(|n| value(n as f64 / RATE_HZ))
        .collect();
    channel(quantity, axis, RATE_HZ, &values)
}

/// Off the surface for a second, and then on it.
fn pressed(t_s: f64) -> f64 {
    if (1.0..2.5).contains(&t_s) { 1.0 } else { 0.0 }
}

fn made(mut rest: Vec<crate::channel::Channel>) -> Result<Timeline, Fault> {
    rest.push(along(Quantity::Acceleration, Axis::Z, |t| {
        9.81 + libm::sin(300.0 * t)
    }));
    rest.push(along(Quantity::Force, Axis::Z, |t| 0.1 + 1.5 * pressed(t)));
    let recording = recording(rest);
    let aligned = Aligned::new(&recording, &vec![0.0; recording.channels.len()])?;
    Timeline::new(&recording, &aligned, &[100..200, 150..300])
}

#[test]
fn channels_share_the_time_that_all_cover_less_what_they_are_late() {
    let ramp = |rate_hz: f64, count: usize, start_s: f64| {
        let values: Vec<f64> = (0..count).map(|n| start_s + n as f64 / rate_hz).collect();
        let mut made = channel(Quantity::Position, Axis::X, rate_hz, &values);
        made.clock.start_s = start_s;
        made
    };
    let recording = recording(vec![ramp(1000.0, 5001, 0.0), ramp(500.0, 2001, 0.5)]);
    let aligned = Aligned::new(&recording, &[0.0, 0.0]).expect("enough");
    near(aligned.clock.start_s, 0.5, 1e-12);
    assert_eq!(aligned.count, 4000);
    // The second is late by 0.25 s: it was taken from 0.25 to 4.25 s.
    let late = Aligned::new(&recording, &[0.0, 0.25]).expect("enough");
    near(late.clock.start_s, 0.25, 1e-12);
    assert_eq!(late.count, 4000);
    for n in [500, 2000, 3500] {
        let t_s = n as f64 / RATE_HZ;
        near(aligned.channels[0][n], 0.5 + t_s, 1e-4);
        near(aligned.channels[1][n], 0.5 + t_s, 1e-4);
        near(late.channels[0][n], 0.25 + t_s, 1e-4);
        near(late.channels[1][n], 0.5 + t_s, 1e-4);
    }
    // A stretch of a channel, with 20 samples around it, within the timeline.
    assert_eq!(aligned.span(&recording, 0, &(625..750)), 105..270);
    assert_eq!(aligned.span(&recording, 1, &(125..250)), 230..520);
    assert_eq!(aligned.span(&recording, 0, &(0..625)), 0..145);
    assert_eq!(aligned.span(&recording, 0, &(4375..9000)), 3855..4000);
}

#[test]
fn two_seconds_are_enough_and_files_that_do_not_meet_are_told() {
    let fault = |count: usize, start_s: f64| {
        let values = vec![0.0; count];
        let mut second = channel(Quantity::Force, Axis::Z, 1000.0, &values);
        second.clock.start_s = start_s;
        let first = channel(Quantity::Position, Axis::X, 1000.0, &values);
        Aligned::new(&recording(vec![first, second]), &[0.0, 0.0])
            .err()
            .map(|error| error.to_string())
    };
    assert_eq!(fault(2001, 0.0), None);
    assert!(fault(2000, 0.0).expect("short").contains("cover 2.00 s"));
    assert!(fault(2001, 0.5).expect("short").contains("cover 1.50 s"));
    assert!(fault(2001, 2.5).expect("apart").contains("do not overlap"));
}

#[test]
fn speeds_are_those_of_the_plane_however_they_are_told() {
    let middle = |channels| made(channels).expect("a timeline").speed_mm_s[2000];
    let (x, y, z) = (Axis::X, Axis::Y, Axis::Z);
    let position = |axis, slope: f64| along(Quantity::Position, axis, move |t| slope * t);
    let speed = |axis, value: f64| along(Quantity::Speed, axis, move |_| value);
    near(
        middle(vec![
            position(x, 0.03),
            position(y, -0.04),
            position(z, 9.0),
        ]),
        50.0,
        0.01,
    );
    near(middle(vec![position(x, -0.07)]), 70.0, 0.01);
    near(middle(vec![position(y, 0.02)]), 20.0, 0.01);
    near(middle(vec![position(Axis::Along, -0.06)]), 60.0, 0.01);
    near(middle(vec![speed(x, 0.05), speed(y, -0.12)]), 130.0, 0.01);
    near(middle(vec![speed(y, -0.12)]), 120.0, 0.01);
    near(
        middle(vec![speed(Axis::Along, -0.11), position(x, 0.03)]),
        110.0,
        0.01,
    );
    let error = made(vec![position(z, 1.0)])
        .expect_err("no motion")
        .to_string();
    assert!(error.contains("position in the plane"), "{error}");
}

#[test]
fn a_heading_is_that_of_the_plane_or_the_sign_along_an_axis() {
    let middle = |channels| {
        let [x, y] = made(channels).expect("a timeline").heading[2000];
        near(libm::hypot(x, y), 1.0, 1e-9);
        libm::atan2(y, x).to_degrees()
    };
    let position = |axis, slope: f64| along(Quantity::Position, axis, move |t| slope * t);
    let speed = |axis, value: f64| along(Quantity::Speed, axis, move |_| value);
    near(
        middle(vec![position(Axis::X, 0.03), position(Axis::Y, -0.03)]),
        -45.0,
        0.01,
    );
    near(middle(vec![position(Axis::Y, 0.03)]), 90.0, 0.01);
    near(middle(vec![position(Axis::Along, 0.03)]), 0.0, 0.01);
    near(middle(vec![position(Axis::Along, -0.03)]), 180.0, 0.01);
    near(middle(vec![speed(Axis::Along, -0.11)]), 180.0, 0.01);
    // A speed that has no sign beside a position that has one.
    near(
        middle(vec![speed(Axis::Along, 0.11), position(Axis::X, -0.03)]),
        180.0,
        0.01,
    );
}

#[test]
fn a_timeline_is_free_of_gravity_and_of_the_bias_of_the_load() {
    let height = along(Quantity::Position, Axis::Z, |t| 0.25 * t);
    let found = made(vec![
        along(Quantity::Position, Axis::X, |t| 0.05 * t),
        height,
    ])
    .expect("made");
    assert!(!found.is_empty());
    assert_eq!(found.len(), 3999);
    near(found.steady_m_s2[0], 9.81, 0.01);
    near(mean(&found.accel_m_s2[0]), 0.0, 1e-9);
    near(found.bias_n, 0.1, 1e-6);
    near(found.load_n[1700], 1.5, 0.01);
    near(found.load_n[500], 0.0, 0.01);
    near(found.unsmoothed_load_n[1700], 1.5, 1e-3);
    near(found.unsmoothed_load_n[500], 0.0, 1e-3);
    near(found.height_m.as_ref().expect("a height")[2000], 0.5, 1e-3);
    near(found.contact_s(), 1.5, 0.06);
    assert!(found.drag_n.is_none());
    let bad: Vec<usize> = (0..found.len()).filter(|n| !found.good[*n]).collect();
    assert_eq!(bad, (100..300).collect::<Vec<_>>());
}

#[test]
fn a_timeline_wants_one_to_three_axes_of_acceleration_and_the_normal_force() {
    let x = || along(Quantity::Position, Axis::X, |t| t);
    let with = |channels: Vec<crate::channel::Channel>| {
        let recording = recording(channels);
        let aligned = Aligned::new(&recording, &vec![0.0; recording.channels.len()])?;
        Timeline::new(&recording, &aligned, &[])
    };
    let accel = |axis| along(Quantity::Acceleration, axis, |_| 1.0);
    let force = || along(Quantity::Force, Axis::Z, pressed);
    let three = || vec![x(), force(), accel(Axis::X), accel(Axis::Y), accel(Axis::Z)];
    assert!(with(three()).is_ok());
    let mut four = three();
    four.push(accel(Axis::Along));
    for channels in [four, vec![x(), force()]] {
        let error = with(channels).expect_err("axes").to_string();
        assert!(error.contains("one to three axes"), "{error}");
    }
    let error = with(vec![x(), accel(Axis::Z)])
        .expect_err("no force")
        .to_string();
    assert!(error.contains("force along the normal"), "{error}");
}

#[test]
fn pressing_is_positive_and_a_small_load_in_the_air_is_bias() {
    // In the air for two thirds.
    let load = |air: f64, press: f64| -> Vec<f64> {
        (0..3000)
            .map(|n| if n < 2000 { air } else { press })
            .collect()
    };
    for (air, press, bias, sign) in [
        (0.1, 1.1, 0.1, 1.0),
        (-0.2, 0.8, -0.2, 1.0),
        (-0.1, -1.1, -0.1, -1.0),
        (0.2, -0.8, 0.2, -1.0),
        (0.49, 1.49, 0.49, 1.0),
        (0.51, 1.51, 0.0, 1.0),
        (-0.51, -1.51, 0.0, -1.0),
    ] {
        let (found, of_bias, of_sign) = pressing(&load(air, press));
        near(of_bias, bias, 1e-9);
        assert_eq!(of_sign, sign, "{air} {press}");
        near(found[2900], sign * press - sign * bias, 1e-9);
        near(found[100], sign * air - sign * bias, 1e-9);
    }
    // Mostly pressed: what it presses with is no rest.
    let mostly: Vec<f64> = (0..3000).map(|n| if n < 400 { 0.0 } else { 2.0 }).collect();
    let (found, bias, sign) = pressing(&mostly);
    assert_eq!((sign, bias.abs() < 1e-9), (1.0, true));
    near(found[2000], 2.0, 1e-9);
}

#[test]
fn contact_begins_above_its_threshold_and_ends_below_half_of_it() {
    let loads = [0.0, 0.05, 0.06, 0.061, 0.04, 0.031, 0.03, 0.05, 0.07, 0.029];
    let expected = [0, 0, 0, 1, 1, 1, 0, 0, 1, 0].map(|x| x == 1);
    assert_eq!(contact(&loads), expected);
    // 2 % of 10 N.
    let mut strong = vec![10.0; 100];
    strong[..6].copy_from_slice(&[0.1, 0.19, 0.21, 0.11, 0.09, 0.15]);
    assert_eq!(contact(&strong)[..7], [0, 0, 1, 1, 0, 0, 1].map(|x| x == 1));
}

#[test]
fn drag_is_the_force_against_the_motion_free_of_its_bias() {
    let stroke = |axis, slope: f64| along(Quantity::Speed, axis, move |_| slope);
    let force =
        |axis, air: f64, drag: f64| along(Quantity::Force, axis, move |t| air + drag * pressed(t));
    let at = |channels, n: usize| made(channels).expect("made").drag_n.expect("a drag")[n];
    let (x, y) = (Axis::X, Axis::Y);
    // Along (0.6, 0.8): 0.5 N against it, and the same from a sensor under the surface.
    for sign in [1.0, -1.0] {
        let channels = || {
            vec![
                stroke(x, 0.06),
                stroke(y, 0.08),
                force(x, 0.2, -0.3 * sign),
                force(y, -0.1, -0.4 * sign),
            ]
        };
        near(at(channels(), 1800), 0.5, 1e-3);
        near(at(channels(), 500), 0.0, 1e-3);
    }
    // Across the motion nothing; one axis alone.
    near(
        at(vec![stroke(x, 0.06), force(y, 0.0, 0.4)], 1800),
        0.0,
        1e-3,
    );
    near(
        at(vec![stroke(x, -0.06), force(x, 0.0, 0.4)], 1800),
        0.4,
        1e-3,
    );
    // A friction force is a size.
    near(
        at(vec![stroke(x, 0.06), force(Axis::Along, 0.0, -0.4)], 1800),
        0.4,
        1e-3,
    );
    // Without a direction there is none.
    let none = made(vec![stroke(Axis::Along, 0.06), force(x, 0.0, 0.4)]).expect("made");
    assert!(none.drag_n.is_none());
}
