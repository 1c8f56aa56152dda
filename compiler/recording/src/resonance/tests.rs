//! Agreement required between taps, and the parts of a fit.

use super::*;
use crate::test_recordings::near;

fn rings(hz: &[f64]) -> Vec<Ring> {
    hz.iter()
        .enumerate()
        .map(|(n, hz)| Ring {
            freq_hz: *hz,
            q: 5.0 + n as f64,
            amplitude_m_s2: 1.0,
        })
        .collect()
}

#[test]
fn half_of_the_taps_must_ring_within_four_percent_of_one_frequency() {
    let found = |hz: &[f64], taps| resonance("acceleration z", &rings(hz), taps);
    assert_eq!(found(&[], 0), None);
    assert_eq!(found(&[300.0, 300.0], 5), None);
    let half = found(&[300.0, 300.0], 4).expect("half");
    assert_eq!((half.taps, half.freq_hz), (2, 300.0));
    let three = found(&[288.1, 300.0, 311.9], 6).expect("half");
    assert_eq!((three.taps, three.freq_hz, three.q), (3, 300.0, 6.0));
    near(three.freq_spread_hz, 11.9, 1e-9);
    near(three.q_spread, 1.0, 1e-9);
    assert_eq!(three.axis, "acceleration z");
    // Beyond that they are others, and do not count.
    let one = found(&[287.9, 300.0, 312.1], 2).expect("half");
    assert_eq!(
        (one.taps, one.freq_spread_hz, one.q_spread, one.q),
        (1, 0.0, 0.0, 6.0)
    );
    assert_eq!(found(&[287.9, 300.0, 312.1], 3), None);
}
