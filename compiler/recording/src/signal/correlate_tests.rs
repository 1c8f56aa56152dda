//! Delays against the definition of a normalised correlation.

use super::*;
use crate::{signal::noise::white, test_recordings::near};

/// Σ x[n]·y[n + lag] over the inner samples, normalised by both energies there.
fn correlation(pairs: &[(&[f64], &[f64])], reach: usize, lag: i64) -> f64 {
    let (mut sum, mut xx, mut yy) = (0.0, 0.0, 0.0);
    for (x, y) in pairs {
        for n in reach..x.len() - reach {
            sum += x[n] * y[(n as i64 + lag) as usize];
            xx += x[n] * x[n];
            yy += y[n] * y[n];
        }
    }
    sum / (xx * yy).sqrt()
}

#[test]
fn peak_rival_and_vertex_are_those_of_the_definition() {
    for seed in 1..40 {
        let signals: Vec<Vec<f64>> = (0..4).map(|k| white(10 * seed + k, 40, 1)).collect();
        let pairs = [
            (&signals[0][..], &signals[1][..]),
            (&signals[2][..], &signals[3][..]),
        ];
        let reach = 6;
        let at: Vec<f64> = (-6..=6)
            .map(|lag| correlation(&pairs, reach, lag))
            .collect();
        let found = delay(&pairs, reach).expect("long enough");
        let best = (0..13_usize)
            .max_by(|a, b| at[*a].total_cmp(&at[*b]))
            .expect("one");
        near(found.correlation, at[best], 1e-12);
        let rival = (1..12_usize)
            .filter(|n| n.abs_diff(best) > 1 && at[*n] > at[n - 1] && at[*n] > at[n + 1])
            .map(|n| at[n])
            .fold(0.0, f64::max);
        near(found.rival, rival, 1e-12);
        // The parabola through the peak and its neighbours is highest there, and nowhere at the ends.
        let vertex = if best == 0 || best == 12 {
            0.0
        } else {
            let curve = 0.5 * (at[best - 1] + at[best + 1]) - at[best];
            let slope = 0.5 * (at[best + 1] - at[best - 1]);
            -slope / (2.0 * curve)
        };
        near(found.samples, best as f64 - 6.0 + vertex, 1e-9);
    }
}

#[test]
fn a_delay_at_the_end_of_the_reach_is_whole() {
    let noise = white(5, 300, 1);
    for (shift, expected) in [(0, 10.0), (20, -10.0)] {
        let found = delay(&[(&noise[10..210], &noise[shift..shift + 200])], 10).expect("found");
        assert_eq!(found.samples, expected);
    }
}

#[test]
fn a_signal_must_be_four_times_as_long_as_the_reach_and_four_samples() {
    let noise = white(6, 24, 1);
    assert!(delay(&[(&noise, &noise)], 5).is_some());
    assert!(delay(&[(&noise[..23], &noise)], 5).is_none());
    assert!(delay(&[(&noise, &noise), (&noise, &noise[..23])], 5).is_none());
    assert!(delay(&[], 5).is_none());
    assert!(delay(&[(&noise, &[f64::NAN; 24])], 5).is_none());
}
