//! Made taps in made air.

use super::*;
use crate::test_recordings;

/// In the air but for the last 300 of 2000 samples. A tap of a size at a sample.
fn taps(change: impl Fn(&mut Timeline)) -> Vec<usize> {
    let mut timeline = test_recordings::timeline(2000);
    timeline.contact[..1700].fill(false);
    timeline.unsmoothed_load_n[..1700].fill(0.0);
    change(&mut timeline);
    find(&timeline)
        .into_iter()
        .map(|at_s| (at_s * 1000.0).round() as usize)
        .collect()
}

fn tap(timeline: &mut Timeline, at: usize, size: f64) {
    // A step would have one change; what rings on changes less.
    timeline.accel_m_s2[0][at] += size;
    timeline.accel_m_s2[0][at + 1] += 0.5 * size;
}

#[test]
fn a_tap_changes_the_acceleration_by_a_metre_within_a_sample() {
    assert_eq!(taps(|t| tap(t, 500, 1.01)), [500]);
    assert_eq!(taps(|t| tap(t, 500, -1.01)), [500]);
    assert!(taps(|t| tap(t, 500, 0.99)).is_empty());
    // All axes count together.
    let two = taps(|t| {
        t.accel_m_s2.push(t.accel_m_s2[0].clone());
        t.accel_m_s2[0][500..].fill(0.8);
        t.accel_m_s2[1][500..].fill(-0.8);
    });
    assert_eq!(two, [500]);
    // And by twenty times what it does in the air.
    let noisy = |size: f64| {
        taps(|t| {
            for (n, a) in t.accel_m_s2[0].iter_mut().enumerate() {
                *a = if n % 2 == 0 { 0.1 } else { -0.1 };
            }
            t.accel_m_s2[0][500..].iter_mut().for_each(|a| *a += size);
        })
    };
    assert_eq!(noisy(3.9), [500]);
    assert!(noisy(3.7).is_empty());
}

#[test]
fn of_taps_within_sixty_samples_the_largest_counts() {
    let both = |apart: usize, second: f64| {
        taps(|t| {
            tap(t, 500, 5.0);
            tap(t, 500 + apart, second);
        })
    };
    assert_eq!(both(61, 4.0), [500, 561]);
    assert_eq!(both(60, 4.0), [500]);
    assert_eq!(both(40, 4.0), [500]);
    assert_eq!(both(100, 9.0), [500, 600]);
}

#[test]
fn before_a_tap_the_tool_rests() {
    // The mean square change of 44 samples up to 6 before it is at most a hundredth of the tap's.
    let with = |before: f64| {
        taps(|t| {
            for n in 440..480 {
                t.accel_m_s2[0][n] = if n % 2 == 0 { before } else { 0.0 };
            }
            tap(t, 500, 5.0);
        })
    };
    assert!(with(0.59).contains(&500));
    assert!(!with(0.62).contains(&500));
    // What comes less than six samples before it belongs to the tap.
    assert_eq!(
        taps(|t| {
            tap(t, 500, 5.0);
            t.accel_m_s2[0][495] += 3.0;
        }),
        [500]
    );
    assert!(taps(|t| tap(t, 0, 5.0)).is_empty());
}

#[test]
fn a_tap_is_fifty_samples_away_from_contact_and_from_what_is_bad() {
    assert_eq!(taps(|t| tap(t, 1649, 5.0)), [1649]);
    assert!(taps(|t| tap(t, 1650, 5.0)).is_empty());
    for (bad, found) in [(449, 1), (450, 0), (550, 0), (551, 1)] {
        let count = taps(|t| {
            t.good[bad] = false;
            tap(t, 500, 5.0);
        });
        assert_eq!(count.len(), found, "{bad}");
        let shown = taps(|t| {
            t.unsmoothed_load_n[bad] = 0.07;
            tap(t, 500, 5.0);
        });
        assert_eq!(shown.len(), found, "{bad}");
    }
}

#[test]
fn with_a_height_the_tool_must_be_a_millimetre_above_the_surface() {
    let at = |height_m: f64| {
        taps(|t| {
            let mut height = vec![height_m; 2000];
            height[1700..].fill(0.02);
            t.height_m = Some(height);
            tap(t, 500, 5.0);
        })
    };
    assert_eq!(at(0.0211), [500]);
    assert!(at(0.0209).is_empty());
}

#[test]
fn the_sixteen_strongest_are_looked_at_in_order_of_time() {
    let found = taps(|t| {
        for n in 0..20 {
            tap(t, 100 + 70 * n, 5.0 + (n as f64 - 9.4).abs());
        }
    });
    let expected: Vec<usize> = (0..20)
        .filter(|n| !(8..12).contains(n))
        .map(|n| 100 + 70 * n)
        .collect();
    assert_eq!(found, expected);
}
