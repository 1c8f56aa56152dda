//! Units: factors, bounds and what is said of them.

use super::*;
use crate::{signal::noise::white, test_recordings};

fn all(quantity: Quantity, values: [f64; 3]) -> Vec<crate::channel::Channel> {
    [Axis::X, Axis::Y, Axis::Z]
        .into_iter()
        .zip(values)
        .map(|(axis, value)| test_recordings::channel(quantity, axis, 1000.0, &vec![value; 3000]))
        .collect()
}

fn factor_of(channels: Vec<crate::channel::Channel>) -> Option<f64> {
    let recording = test_recordings::recording(channels);
    let aligned = Aligned::new(&recording, &vec![0.0; recording.channels.len()]).expect("long");
    gravity_factor(&recording, &aligned)
}

#[test]
fn gravity_tells_the_unit_of_an_accelerometer_of_three_axes() {
    let accel = |x, y, z| factor_of(all(Quantity::Acceleration, [x, y, z]));
    assert_eq!(accel(0.0, 0.0, 9.81), Some(1.0));
    // 6² + 6² + 5² is 9.85².
    assert_eq!(accel(6.0, -6.0, 5.0), Some(1.0));
    assert_eq!(accel(0.0, 0.0, 12.2), Some(1.0));
    assert_eq!(accel(0.0, 0.0, 7.9), Some(1.0));
    // A unit, or a range, is wrong by whatever factor.
    for steady in [1.0, 7.8, 12.3, 19.6, 255.0, 1000.0, 9806.65, 32_768.0] {
        let found = accel(0.0, 0.6 * steady, 0.8 * steady).expect("gravity");
        test_recordings::near(found, steady / 9.806_65, 1e-6 * steady);
    }
    // The bias of a sensor that shows no gravity.
    for bias in [0.2, 0.5, 2.0, 2.9] {
        assert_eq!(accel(0.0, 0.0, bias), None, "{bias}");
    }
    let mut two = all(Quantity::Acceleration, [0.0, 0.0, 9.81]);
    two.remove(0);
    assert_eq!(factor_of(two), None);
    assert_eq!(factor_of(all(Quantity::Force, [0.0, 0.0, 9.81])), None);
}

#[test]
fn an_accelerometer_that_moves_more_than_it_rests_tells_no_gravity() {
    // In turn up and down by so much around gravity.
    let with = |size: f64| {
        let mut channels = all(Quantity::Acceleration, [0.0, 0.0, 9.81]);
        let values: Vec<f64> = (0..3000)
            .map(|n| if n / 50 % 2 == 0 { size } else { -size })
            .collect();
        channels[0] = test_recordings::channel(Quantity::Acceleration, Axis::X, 1000.0, &values);
        factor_of(channels)
    };
    assert_eq!(with(9.0), Some(1.0));
    assert_eq!(with(11.0), None);
}

#[test]
fn a_value_beyond_what_a_hand_has_is_off_by_a_thousand() {
    let of = |value| beyond(value, (2.0, 3000.0));
    assert_eq!(of(3000.0), None);
    assert_eq!(of(3000.1), Some(1000.0));
    assert_eq!(of(2.0), None);
    assert_eq!(of(1.9), Some(1e-3));
    assert_eq!(of(0.0), None);
    assert_eq!(of(-1.0), None);
}

#[test]
fn a_factor_lies_between_the_slopes_or_within_the_tolerance() {
    assert_eq!(factor([0.81; 2], 1.25), Some(1.0));
    assert_eq!(factor([0.79; 2], 1.25), None);
    assert_eq!(factor([1.24; 2], 1.25), Some(1.0));
    assert_eq!(factor([1.26; 2], 1.25), None);
    // In whichever order.
    assert_eq!(factor([0.3, 4.0], 1.25), Some(1.0));
    assert_eq!(factor([4.0, 0.3], 1.25), Some(1.0));
    assert_eq!(factor([5.0, 2000.0], 1.25), Some(9.806_65));
    assert_eq!(factor([2000.0, 5.0], 1.25), Some(1000.0));
    for wrong in [9806.65, 1000.0, 9.806_65, 1e-3, 1.0 / 9806.65] {
        assert_eq!(factor([wrong * 1.1; 2], 1.25), Some(wrong));
    }
}

#[test]
fn the_ratio_is_that_of_the_surest_axis() {
    let noise = |seed| white(seed, 2000, 1);
    let times = |x: &[f64], k: f64| x.iter().map(|x| k * x).collect::<Vec<f64>>();
    let (a, b, c) = (noise(1), noise(2), noise(3));
    // Twice as large, exactly.
    let [first, second] = ratio(&[(times(&a, 2.0), a.clone())]).expect("alike");
    test_recordings::near(first, 2.0, 0.05);
    test_recordings::near(second, 2.0, 0.05);
    let noisy: Vec<f64> = b.iter().zip(&c).map(|(b, c)| b + c).collect();
    let pairs = |swap: bool| {
        let mut pairs = vec![
            (times(&noisy, 70.0), b.clone()),
            (times(&a, 2.0), a.clone()),
        ];
        if swap {
            pairs.reverse();
        }
        pairs
    };
    for swap in [false, true] {
        test_recordings::near(ratio(&pairs(swap)).expect("alike")[0], 2.0, 0.05);
    }
    // Slopes of x = 70·(b + c) on b: 70 by its noise, and twice that by the other way.
    let [low, high] = ratio(&pairs(false)[..1]).expect("alike");
    test_recordings::near(low, 70.0, 5.0);
    test_recordings::near(high, 140.0, 10.0);
    assert_eq!(ratio(&[(a, c)]), None);
    assert_eq!(ratio(&[]), None);
}

#[test]
fn a_factor_between_no_units_is_a_wrong_range() {
    let recording = test_recordings::recording(all(Quantity::Acceleration, [0.0, 0.0, 1.0]));
    for (factor, kind, remedy) in [
        (1.0 / 9.806_65, "wrong unit", "unit"),
        (1000.0, "wrong unit", "unit"),
        (
            8.0,
            "wrong range",
            "`scale` of acceleration in recording.toml by 0.1250",
        ),
        (2.0, "wrong range", "by 0.5000"),
    ] {
        let found = finding(&recording, Quantity::Acceleration, factor, "gravity");
        assert!(found.what.starts_with(kind), "{factor}: {}", found.what);
        assert!(found.remedy.contains(remedy), "{factor}: {}", found.remedy);
    }
}

#[test]
fn a_wrong_unit_is_told_with_its_factor_and_the_file() {
    let recording = test_recordings::recording(all(Quantity::Force, [0.0; 3]));
    let large = finding(&recording, Quantity::Force, 1000.0, "x");
    assert!(
        large.what.contains("1000.0000 times too large, by x"),
        "{}",
        large.what
    );
    let small = finding(&recording, Quantity::Force, 1e-3, "x");
    assert!(
        small.what.contains("1000.0000 times too small"),
        "{}",
        small.what
    );
    assert_eq!(
        (&*large.file, large.severity),
        ("force.csv", Severity::Fault)
    );
    assert_eq!(finding(&recording, Quantity::Speed, 2.0, "x").file, "");
}

/// Unit faults for a hand's speed and load, without gravity: the channel, and true if it is too large.
fn told(speed_mm_s: f64, load_n: f64, dead: [bool; 3]) -> Vec<(String, bool)> {
    let channels = vec![
        test_recordings::channel(Quantity::Acceleration, Axis::Z, 1000.0, &vec![0.0; 3000]),
        test_recordings::channel(Quantity::Force, Axis::Z, 1000.0, &vec![load_n; 3000]),
        test_recordings::channel(
            Quantity::Speed,
            Axis::Along,
            1000.0,
            &vec![speed_mm_s; 3000],
        ),
    ];
    let recording = test_recordings::recording(channels);
    let aligned = Aligned::new(&recording, &[0.0; 3]).expect("long");
    let mut timeline = test_recordings::timeline(aligned.count);
    timeline.speed_mm_s.fill(speed_mm_s);
    timeline.load_n.fill(load_n);
    let found = check(&recording, &aligned, &timeline, &dead);
    let notes = found.iter().filter(|f| f.severity == Severity::Note);
    assert_eq!(notes.count(), 1, "one axis without gravity tells no scale");
    found
        .into_iter()
        .filter(|f| f.severity == Severity::Fault)
        .map(|f| (f.channel, f.what.contains("too large")))
        .collect()
}

#[test]
fn speeds_and_loads_that_no_hand_has_are_a_wrong_unit_unless_the_channel_is_dead() {
    let alive = [false; 3];
    let none: [(String, bool); 0] = [];
    assert_eq!(told(100.0, 1.0, alive), none);
    assert_eq!(told(2.1, 0.021, alive), none);
    assert_eq!(told(2990.0, 99.0, alive), none);
    assert_eq!(told(1.9, 1.0, alive), [("speed".into(), false)]);
    assert_eq!(told(3010.0, 1.0, alive), [("speed".into(), true)]);
    assert_eq!(told(100.0, 0.019, alive), [("force".into(), false)]);
    assert_eq!(told(100.0, 101.0, alive), [("force".into(), true)]);
    assert_eq!(told(1.9, 101.0, [false, true, true]), none);
    assert_eq!(told(1.9, 101.0, [true, false, false]).len(), 2);
}

#[test]
fn a_dead_axis_may_be_the_one_that_shows_gravity() {
    // In g.
    let recording = test_recordings::recording(all(Quantity::Acceleration, [0.0, 0.6, 0.8]));
    let aligned = Aligned::new(&recording, &[0.0; 3]).expect("long");
    let timeline = test_recordings::timeline(aligned.count);
    let faults = |dead: [bool; 3]| -> Vec<String> {
        let found = check(&recording, &aligned, &timeline, &dead).into_iter();
        found
            .filter(|f| f.severity == Severity::Fault)
            .map(|f| f.channel)
            .collect()
    };
    assert_eq!(faults([false; 3]), ["acceleration"]);
    for axis in 0..3 {
        let dead = [0, 1, 2].map(|n| n == axis);
        assert!(faults(dead).is_empty(), "{dead:?}");
    }
}
