//! A damped resonance, driven by sampled force.

use std::f64::consts::TAU;

/// Nepers of 60 dB.
const SIXTY_DB: f64 = 3.0 * std::f64::consts::LN_10;

/// Damping ratio of a resonance that falls by 60 dB in `decay_s`.
pub(super) fn damping_of_decay(freq_hz: f64, decay_s: f64) -> f64 {
    (SIXTY_DB / (decay_s * TAU * freq_hz)).min(0.95)
}

/// The second-order section with the impulse response `ω²/ω_d·e^(−ζωt)·sin(ω_d t)`, whose gain at
/// 0 Hz is one. The input is an impulse a sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resonator {
    gain: f64,
    feedback: [f64; 2],
}

impl Resonator {
    pub(super) fn new(freq_hz: f64, damping: f64, sample_rate_hz: f64) -> Self {
        let omega = TAU * freq_hz;
        let damped = omega * (1.0 - damping * damping).sqrt();
        let radius = libm::exp(-damping * omega / sample_rate_hz);
        let angle = damped / sample_rate_hz;
        Self {
            gain: omega * omega / damped / sample_rate_hz * radius * libm::sin(angle),
            feedback: [2.0 * radius * libm::cos(angle), -radius * radius],
        }
    }

    /// y[n] = g·x[n−1] + c₁·y[n−1] + c₂·y[n−2], from rest.
    pub(super) fn response(self, input: &[f64]) -> impl Iterator<Item = f64> + '_ {
        let (mut before, mut last, mut earlier) = (0.0, 0.0, 0.0);
        input.iter().map(move |&x| {
            let y = self.gain * before + self.feedback[0] * last + self.feedback[1] * earlier;
            (before, earlier, last) = (x, last, y);
            y
        })
    }
}
