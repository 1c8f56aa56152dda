//! The transient of an impact: a contact that closes and a surface that rings.
//!
//! The amplitude is linear in impact speed, and the spectral centroid is constant within a
//! material (Okamura, Cutkosky and Dennerlein, 2001). Harder materials ring faster. That also puts
//! rate-hardness in the right order, the initial rate of force over impact speed (Lawrence et al.,
//! 2000). We know of no openly licensed recordings of taps, so none was used.

use super::Physical;
use crate::{TAP_RATE_HZ, TAP_SAMPLES};
use std::f64::consts::{PI, TAU};

/// Frequency of the ringing at 0.01 MPa, Hz, and its growth: tenfold over seven decades of modulus.
const SOFTEST_HZ: f64 = 60.0;
const FREQ_EXPONENT: f64 = 1.0 / 7.0;
const FREQ_RANGE_HZ: (f64, f64) = (45.0, 800.0);
/// Damping ratio of a lossless material, and the part that losses add.
const DAMPING: f64 = 0.10;
const DAMPING_PER_LOSS: f64 = 0.35;
/// ∫a dt per impact speed: one twenty-fifth of the momentum. The wall returns the rest.
const IMPULSE_PER_SPEED: f64 = 0.04;
/// Strongest acceleration of the fastest tap, m/s²: 90 % of 3.3 N on 0.05 kg.
const PEAK_M_S2: f64 = 59.0;
/// Samples over which the end of a trace is faded to zero.
const FADE_SAMPLES: usize = 20;

/// Frequency of the ringing, Hz.
#[must_use]
pub fn frequency_hz(physical: &Physical) -> f64 {
    let (low, high) = FREQ_RANGE_HZ;
    (SOFTEST_HZ * libm::pow(physical.modulus_mpa / 0.01, FREQ_EXPONENT)).clamp(low, high)
}

/// Acceleration per impact speed, 1/s, at 10 kHz: `A·e^(−ζωt)·sin(ωt)`. The first half period is
/// also the closing contact.
#[must_use]
pub fn per_speed(physical: &Physical) -> [f64; TAP_SAMPLES] {
    let omega = TAU * frequency_hz(physical);
    let damping = DAMPING + DAMPING_PER_LOSS * physical.loss_factor;
    let mut trace: [f64; TAP_SAMPLES] = std::array::from_fn(|n| {
        let t_s = n as f64 / TAP_RATE_HZ;
        let left = (TAP_SAMPLES - n) as f64 / FADE_SAMPLES as f64;
        let fade = if left < 1.0 {
            0.5 - 0.5 * libm::cos(PI * left)
        } else {
            1.0
        };
        libm::exp(-damping * omega * t_s) * libm::sin(omega * t_s) * fade
    });
    // Truncated ringing has a little less impulse than 1/ω, so it is scaled by its own impulse.
    let impulse: f64 = trace.iter().sum::<f64>() / TAP_RATE_HZ;
    let peak = trace.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
    let fastest = super::tap_speeds_m_s()[crate::TAPS - 1];
    let scale = (IMPULSE_PER_SPEED / impulse).min(PEAK_M_S2 / (peak * fastest));
    for a in &mut trace {
        *a *= scale;
    }
    trace
}
