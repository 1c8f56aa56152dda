//! Lines of the mains: taken away to the last digit, and told from 15 dB on.

use super::*;
use crate::{description::Axis, signal::noise::white, test_recordings};
use std::f64::consts::TAU;

fn tone(hz: f64, size: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|n| size * libm::sin(TAU * hz * n as f64 / RATE_HZ + 0.7))
        .collect()
}

#[test]
fn every_line_is_taken_away_and_what_lies_between_is_kept() {
    for hz in [50.0, 60.0, 100.0, 120.0, 150.0, 180.0] {
        let rest = without_hum(&tone(hz, 3.0, 2000));
        assert!(rest.iter().all(|x| x.abs() < 1e-9), "{hz}");
    }
    for hz in [3.0, 55.0, 90.0, 240.0] {
        let signal = tone(hz, 3.0, 2000);
        for (x, y) in without_hum(&signal).iter().zip(&signal) {
            test_recordings::near(*x, *y, 1e-9);
        }
    }
    // A piece shorter than a second is left as it is.
    let signal = tone(50.0, 1.0, 1500);
    let rest = without_hum(&signal);
    assert!(rest[..1000].iter().all(|x| x.abs() < 1e-9));
    assert_eq!(rest[1000..], signal[1000..]);
}

/// Findings for a hum of amplitude `size` on noise, in the air except at the `contact` samples.
fn told(quantity: Quantity, hz: f64, size: f64, count: usize, contact: &[usize]) -> Vec<String> {
    let noise = white(8, count, 12);
    let values: Vec<f64> = noise
        .iter()
        .zip(tone(hz, size, count))
        .map(|(n, t)| 9.0 + n + t)
        .collect();
    let recording = test_recordings::recording(vec![test_recordings::channel(
        quantity,
        Axis::Z,
        1000.0,
        &values,
    )]);
    let aligned = Aligned {
        clock: recording.channels[0].clock,
        count,
        channels: vec![values],
    };
    let mut timeline = test_recordings::timeline(count);
    timeline.contact.fill(false);
    contact.iter().for_each(|n| timeline.contact[*n] = true);
    check(&recording, &aligned, &timeline)
        .into_iter()
        .map(|f| f.what)
        .collect()
}

#[test]
fn a_line_is_told_with_its_frequency_and_its_size_in_the_air() {
    let accel = Quantity::Acceleration;
    for hz in [50.0, 60.0] {
        // Noise of 1 has 1 at a frequency; a sine of a size has 1000·size²/6 there: 15 dB at 0.42.
        for quantity in [accel, Quantity::Force] {
            let found = told(quantity, hz, 10.0, 6000, &[]);
            assert_eq!(found.len(), 1, "{hz}");
            assert!(
                found[0].starts_with(&format!("hum at {hz} Hz, some 7.")),
                "{found:?}"
            );
            assert!(found[0].contains("e0 SI RMS"), "{found:?}");
        }
        assert_eq!(told(accel, hz, 0.7, 6000, &[]).len(), 1, "{hz}");
        assert!(told(accel, hz, 0.25, 6000, &[]).is_empty(), "{hz}");
        assert!(told(Quantity::Position, hz, 9.0, 6000, &[]).is_empty());
    }
    assert!(told(accel, 70.0, 3.0, 6000, &[]).is_empty());
    assert!(told(accel, 40.0, 3.0, 6000, &[]).is_empty());
}

#[test]
fn two_stretches_of_a_second_in_the_air_are_needed() {
    let found = |count, contact: &[usize]| told(Quantity::Force, 50.0, 4.0, count, contact).len();
    assert_eq!(found(1500, &[]), 1);
    assert_eq!(found(1499, &[]), 0);
    // From the sample behind a contact on.
    assert_eq!(found(2001, &[1000]), 1);
    assert_eq!(found(2000, &[1000]), 0);
    assert_eq!(found(4000, &[900, 1800, 2700]), 0);
}
