//! Speeds of made flights, and where the tip rests.
#![allow(
    clippy::single_range_in_vec_init,
    reason = "a list of spans may have one"
)]

use super::*;
use crate::test_recordings::{near, timeline};

#[test]
fn the_speed_by_height_is_the_steepest_slope_that_the_clock_allows() {
    let of = |height: &dyn Fn(f64) -> f64, at_s: f64| {
        let mut made = timeline(300);
        made.clock.start_s = 2.0;
        made.height_m = Some((0..300).map(|n| height(f64::from(n))).collect());
        by_height(&made, at_s)
    };
    // 0.1 mm a sample, downwards and upwards.
    near(of(&|n| 1.0 - 1e-4 * n, 2.15).expect("a slope"), 0.1, 1e-9);
    near(of(&|n| 1e-4 * n, 2.15).expect("a slope"), -0.1, 1e-9);
    // The slope over twelve samples of a parabola is that at their middle, 6.5 before their end.
    near(
        of(&|n| -1e-6 * n * n, 2.150_5).expect("a slope"),
        2e-3 * (152.0 - 6.5),
        1e-9,
    );
    near(
        of(&|n| 1e-6 * (n - 400.0).powi(2), 2.150_5).expect("a slope"),
        2e-3 * (400.0 - 146.0 + 6.5),
        1e-9,
    );
    // Twelve samples before its end, two behind the onset.
    assert!(of(&|n| n, 2.009_5).is_none());
    assert!(of(&|n| n, 2.010_5).is_some());
    assert!(of(&|n| n, 1.0).is_none());
    assert!(of(&|n| n, 2.304_5).is_some() && of(&|n| n, 2.305_5).is_none());
    assert!(by_height(&timeline(300), 0.1).is_none());
}

/// In contact but for a flight from 200 to 700.
fn flight() -> Vec<bool> {
    (0..1000).map(|n| !(200..700).contains(&n)).collect()
}

#[test]
fn an_acceleration_is_integrated_between_two_rests_whatever_its_bias() {
    let made = timeline(1000);
    for bias in [0.0, 9.81, -0.3] {
        let accel: Vec<f64> = (0..1000)
            .map(|n| {
                bias + match n {
                    300..400 => -1.0,
                    // The surface stops it.
                    705..715 => 10.0,
                    // Outside of both rests nothing counts.
                    0..190 | 742.. => 55.0,
                    _ => 0.0,
                }
            })
            .collect();
        let found = by_acceleration(&accel, &flight(), 700, 0.7, &made);
        near(found.expect("a speed"), 0.1, 1e-9);
    }
    // Only what is left 80 samples before the landing: here a fifth of it.
    let braked: Vec<f64> = (0..1000)
        .map(|n| match n {
            300..400 => -1.0,
            500..580 => 1.0,
            705..707 => 10.0,
            _ => 0.0,
        })
        .collect();
    near(
        by_acceleration(&braked, &flight(), 700, 0.7, &made).expect("a speed"),
        0.02,
        1e-9,
    );
    // Fastest in the middle of these 80.
    let late: Vec<f64> = (0..1000)
        .map(|n| match n {
            630..650 => -2.0,
            660..670 => 1.0,
            705..708 => 10.0,
            _ => 0.0,
        })
        .collect();
    near(
        by_acceleration(&late, &flight(), 700, 0.7, &made).expect("a speed"),
        0.04,
        1e-9,
    );
    // A tool that goes up does not land.
    let up: Vec<f64> = braked.iter().map(|a| -a).collect();
    let found = by_acceleration(&up, &flight(), 700, 0.7, &made);
    assert!(found.is_none_or(|speed| speed < 1e-9), "{found:?}");
}

#[test]
fn the_tip_rests_forty_samples_after_it_landed_or_in_the_middle_of_a_shorter_contact() {
    let after = |spans: &[std::ops::Range<usize>]| {
        let touches: Vec<bool> = (0..400)
            .map(|n| spans.iter().any(|span| span.contains(&n)))
            .collect();
        rest_after(&touches, 100)
    };
    assert_eq!(after(&[100..400]), Some(140));
    assert_eq!(after(&[100..181]), Some(140));
    assert_eq!(after(&[100..161]), Some(130));
    assert_eq!(after(&[100..117]), Some(108));
    assert_eq!(after(&[100..116]), None);
    // A bounce of eight samples belongs to the contact, one of nine ends it.
    assert_eq!(after(&[100..105, 113..161]), Some(130));
    assert_eq!(after(&[100..105, 114..161]), None);
    assert_eq!(after(&[100..121, 130..161]), Some(110));
}

#[test]
fn the_tip_rested_eight_samples_before_it_left_the_surface() {
    let before = |spans: &[std::ops::Range<usize>], landing: usize, still: usize| {
        let touches: Vec<bool> = (0..3000)
            .map(|n| spans.iter().any(|span| span.contains(&n)))
            .collect();
        let accel: Vec<f64> = (0..3000)
            .map(|n| match n {
                n if (still..still + 60).contains(&n) => 3.0,
                n if n % 2 == 0 => 5.0,
                _ => -5.0,
            })
            .collect();
        rest_before(&accel, &touches, landing)
    };
    assert_eq!(before(&[500..900], 2000, 0), Some(891));
    assert_eq!(before(&[884..900], 2000, 0), Some(891));
    // Too short a contact, or one too long ago: the stillest stretch of the last second.
    assert_eq!(before(&[885..900], 2000, 1400), Some(1430));
    assert_eq!(before(&[400..501], 2000, 1400), Some(492));
    assert_eq!(before(&[400..500], 2000, 1400), Some(1430));
    assert_eq!(before(&[], 2000, 1000), Some(1030));
    // 1815 is the last start of a stretch that ends 120 samples before the landing.
    assert_eq!(before(&[], 2000, 1815), Some(1845));
    assert_ne!(before(&[], 2000, 1820), Some(1850));
    assert_ne!(before(&[], 2000, 995), Some(1025));
    assert_eq!(before(&[], 119, 0), None);
    assert_eq!(before(&[], 181, 0), Some(30));
    assert_eq!(before(&[], 180, 0), None);
}
