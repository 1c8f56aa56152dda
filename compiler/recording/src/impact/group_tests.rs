//! Groups of made impacts.

use super::*;
use crate::test_recordings::near;

/// A pulse at a sample, proportional to the speed.
fn impact(speed_m_s: f64, at: f64, size: f64) -> Impact {
    let pulse = |n: usize| size * speed_m_s * libm::exp(-((n as f64 - at) / 4.0).powi(2));
    Impact {
        at_s: 0.0,
        speed_m_s,
        integrated_m_s: None,
        accel_m_s2: (0..TAP_SAMPLES).map(pulse).collect(),
    }
}

fn groups(speeds: &[f64]) -> Vec<(f64, usize)> {
    let impacts: Vec<Impact> = speeds.iter().map(|v| impact(*v, 30.0, 100.0)).collect();
    let found = transients(&impacts);
    found.iter().map(|t| (t.speed_m_s, t.impacts)).collect()
}

#[test]
fn speeds_within_a_third_of_the_slowest_are_one_group_of_at_least_three() {
    let one = groups(&[0.134, 0.1, 0.11, 0.12]);
    assert_eq!((one.len(), one[0].1), (1, 4));
    near(one[0].0, 0.116, 1e-12);
    let two = groups(&[0.1, 0.15, 0.11, 0.136, 0.12, 0.14]);
    assert_eq!((two.len(), two[0].1, two[1].1), (2, 3, 3));
    near(two[0].0, 0.11, 1e-12);
    near(two[1].0, 0.142, 1e-12);
    assert_eq!(groups(&[0.1, 0.11, 0.3, 0.31]), []);
}

#[test]
fn of_more_than_eight_speeds_the_rarest_are_left_out() {
    let mut speeds = Vec::new();
    let mut speed = 0.01;
    for n in 0..10 {
        speeds.extend(vec![speed; if n == 4 || n == 7 { 3 } else { 5 }]);
        speed *= 1.5;
    }
    let found = groups(&speeds);
    assert_eq!(found.iter().map(|g| g.1).collect::<Vec<_>>(), [5; 8]);
    assert_eq!(groups(&speeds[..36]).len(), 8);
}

#[test]
fn a_trace_is_moved_where_it_matches_up_to_five_samples() {
    assert_eq!(moved(&[1.0, 2.0, 3.0], 1), [2.0, 3.0, 0.0]);
    assert_eq!(moved(&[1.0, 2.0, 3.0], -1), [0.0, 1.0, 2.0]);
    assert_eq!(moved(&[1.0, 2.0, 3.0], -4), [0.0; 3]);
    let at = |place: f64| impact(0.1, place, 1.0).accel_m_s2;
    for (place, shift) in [
        (30.0, 0),
        (33.0, 3),
        (27.0, -3),
        (35.0, 5),
        (25.0, -5),
        (38.0, 5),
    ] {
        assert_eq!(best_shift(&at(30.0), &at(place)), shift);
    }
}

#[test]
fn the_mean_of_a_group_is_scaled_aligned_and_faded_at_its_end() {
    let impacts = [
        impact(0.1, 40.0, 100.0),
        impact(0.12, 42.0, 100.0),
        impact(0.11, 39.0, 100.0),
    ];
    let found = &transients(&impacts)[0];
    near(found.speed_m_s, 0.11, 1e-12);
    for n in 0..70 {
        near(
            found.accel_m_s2[n],
            impact(0.11, 40.0, 100.0).accel_m_s2[n],
            1e-9,
        );
    }
    assert!(found.spread < 1e-9);
    let constant = || Impact {
        accel_m_s2: vec![2.0; TAP_SAMPLES],
        ..impact(0.1, 0.0, 0.0)
    };
    let faded = average(vec![&constant(), &constant(), &constant()]).accel_m_s2;
    faded[..80].iter().for_each(|a| near(*a, 2.0, 1e-12));
    for n in 0..20 {
        let half = libm::sin(std::f64::consts::PI * f64::from(n) / 40.0);
        near(faded[99 - n as usize], 2.0 * half * half, 1e-12);
    }
}

#[test]
fn the_spread_is_the_rms_distance_over_the_size_of_the_mean() {
    // 0.9, 1 and 1.1 of one pulse at one speed: √(0.02/3).
    let impacts = [0.9, 1.0, 1.1].map(|size| impact(0.1, 40.0, size));
    near(
        transients(&impacts)[0].spread,
        (0.02_f64 / 3.0).sqrt(),
        1e-9,
    );
    let traces = [vec![3.0, 0.0], vec![0.0, 4.0]];
    let apart = distances(&traces, &[0.0, 0.0]);
    assert_eq!(apart, [3.0, 4.0]);
    near(energy(&[1.0, -2.0, 3.0]), 14.0, 1e-12);
}

#[test]
fn an_impact_more_than_two_and_a_half_times_as_far_as_the_middle_one_is_left_out() {
    // Sizes 0.9, 1, 1, 1.1 and another: distances from 1 of 0.1 in the middle.
    let of = |other: f64| {
        let impacts = [0.9, 1.0, 1.1, 0.9, other].map(|size| impact(0.1, 40.0, size));
        let found = transients(&impacts);
        (
            found[0].impacts,
            found[0].accel_m_s2[40] / impact(0.1, 40.0, 1.0).accel_m_s2[40],
        )
    };
    assert_eq!(of(1.24).0, 5);
    let (impacts, size) = of(1.26);
    assert_eq!(impacts, 4);
    near(size, 0.975, 1e-9);
}
