//! When a tool lands, and how fast it may.
#![allow(
    clippy::single_range_in_vec_init,
    reason = "a list of spans may have one"
)]

use super::*;
use crate::test_recordings::{self, near};

#[test]
fn a_landing_follows_forty_samples_in_the_air_and_is_good() {
    let at = |spans: &[std::ops::Range<usize>], bad: Option<usize>| {
        let mut timeline = test_recordings::timeline(400);
        let touches: Vec<bool> = (0..400)
            .map(|n| spans.iter().any(|span| span.contains(&n)))
            .collect();
        bad.into_iter().for_each(|n| timeline.good[n] = false);
        landings(&timeline, &touches)
    };
    assert_eq!(
        at(&[40..60, 100..120, 159..180, 300..400], None),
        [40, 100, 300]
    );
    assert_eq!(at(&[39..60, 100..120], None), [100]);
    assert_eq!(at(&[50..60, 100..120], Some(50)), [100]);
    assert_eq!(at(&[50..60, 100..120], Some(99)), [50, 100]);
}

#[test]
fn a_load_shows_contact_above_its_noise_and_above_sixty_millinewtons() {
    let shows = |rest: f64, noise: f64, load: f64| {
        let mut timeline = test_recordings::timeline(401);
        for n in 0..400 {
            timeline.contact[n] = false;
            timeline.unsmoothed_load_n[n] = rest + noise * [-1.0, 0.0, 1.0, 0.5][n % 4];
        }
        timeline.unsmoothed_load_n[400] = load;
        touches(&timeline)[400]
    };
    assert!(!shows(0.0, 0.0, 0.059) && shows(0.0, 0.0, 0.061));
    assert!(!shows(0.2, 0.0, 0.259) && shows(0.2, 0.0, 0.261));
    // Medians of 0.5 and of 0.5 around it: 8·1.4826·0.05 N above 0.05 N.
    assert!(!shows(0.0, 0.1, 0.64) && shows(0.0, 0.1, 0.645));
}

#[test]
fn a_speed_says_where_it_comes_from_and_how_far_both_ways_are_apart() {
    let impact = |speed_m_s: f64, integrated_m_s: Option<f64>| Impact {
        at_s: 0.0,
        speed_m_s,
        integrated_m_s,
        accel_m_s2: Vec::new(),
    };
    let impacts = [
        impact(0.1, Some(0.11)),
        impact(0.2, Some(0.18)),
        impact(0.1, Some(0.13)),
        impact(0.1, None),
    ];
    let mut timeline = test_recordings::timeline(10);
    let without = SpeedSource::new(&timeline, &impacts);
    assert_eq!((without.source, without.by_both), ("acceleration", 0));
    assert_eq!(
        (without.integrated_over_position, without.apart),
        (None, None)
    );
    timeline.height_m = Some(vec![0.0; 10]);
    let with = SpeedSource::new(&timeline, &impacts);
    assert_eq!((with.source, with.by_both), ("position", 3));
    near(with.integrated_over_position.expect("some"), 0.1, 1e-9);
    near(with.apart.expect("some"), 0.1, 1e-9);
}
