//! The division of a tone, sample by sample.

use super::*;
use crate::test_recordings::near;
use std::f64::consts::TAU;

#[test]
fn a_resonance_passes_what_is_slow_raises_what_is_at_it_by_q_and_lowers_what_is_fast() {
    let h = |freq_hz: f64| response(freq_hz, 300.0, 8.0);
    near((h(0.0) - Complex::new(1.0, 0.0)).norm(), 0.0, 1e-12);
    // −jQ.
    near((h(300.0) - Complex::new(0.0, -8.0)).norm(), 0.0, 1e-12);
    // 1/(1 − 4 + j/4) at twice its frequency.
    near(
        (h(600.0) - Complex::new(-3.0, -0.25) / 9.0625).norm(),
        0.0,
        1e-12,
    );
}

#[test]
fn a_tone_comes_out_with_the_amplitude_and_the_phase_of_the_bounded_inverse() {
    for freq_hz in [50.0, 290.0, 800.0, 1700.0] {
        let omega = TAU * freq_hz / 5000.0;
        let tone: Vec<f32> = (0..30_000)
            .map(|n| (2.0 + libm::cos(omega * f64::from(n))) as f32)
            .collect();
        let h = response(freq_hz, 300.0, 8.0);
        let epsilon = 0.0125 * 0.0125;
        let g = h.conj() * ((1.0 + epsilon) / (h.norm_sqr() + epsilon));
        let out = divided(&tone, 5000.0, 300.0, 8.0);
        for n in (3000..27_000).step_by(7) {
            let exact = 2.0 + (g * Complex::from_polar(1.0, omega * n as f64)).re;
            near(f64::from(out[n]), exact, 2e-3 * (1.0 + g.norm()));
        }
    }
    assert!(divided(&[], 5000.0, 300.0, 8.0).is_empty());
    for x in divided(&[3.5; 100], 5000.0, 300.0, 8.0) {
        near(f64::from(x), 3.5, 1e-6);
    }
}
