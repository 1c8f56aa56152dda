//! Tap transients for a source that has none: decaying sinusoids with a given impulse.
//!
//! At the impact speed v a transient is `a(t) = A·v·e^(−t/τ)·sin(2πft)`. Its amplitude is linear
//! in v, as Okamura, Cutkosky and Dennerlein measured ("Reality-based models for vibration
//! feedback in virtual environments", 2001). Its frequency follows the texture: a surface that
//! vibrates at higher frequencies taps harder. Both are guesses at the material, so such a bank
//! is marked synthetic.

use crate::model::{Gains, ModelGrid, TapBank, TapTrace, VertexKind};
use crate::signal::spectrum::ArmaModel;
use std::f64::consts::{PI, TAU};

/// Impact speeds of the bank.
pub const SPEEDS: usize = 13;
/// Samples of a trace.
pub const SAMPLES: usize = 100;
/// Rate of a trace, Hz: 100 samples last 10 ms.
pub const SAMPLE_RATE_HZ: f64 = 10_000.0;
/// Step of impact speed, m/s: the bank reaches from 0.025 to 0.325 m/s.
pub const SPEED_STEP_M_S: f64 = 0.025;
/// ∫a dt per impact speed, so that J = m_eff·∫a dt is 5 % of the momentum m_eff·v.
/// The wall returns the rest.
pub const IMPULSE_PER_SPEED: f64 = 0.05;
/// Decay time τ, s: e⁻⁵ of the amplitude is left where the trace ends.
pub const DECAY_S: f64 = 0.002;
/// Range of the frequency, Hz: perceived hardness peaks near 300 Hz.
pub const FREQ_RANGE_HZ: (f64, f64) = (80.0, 350.0);
/// Samples over which the end of a trace is faded to zero.
const FADE_SAMPLES: usize = 20;
/// Fraction of the device's force that the strongest tap may take.
const PEAK_SHARE: f64 = 0.9;

/// Frequency of the synthesised taps, Hz: 1.5 times the mean spectral centroid above
/// 40 Hz over the interior vertices, within [`FREQ_RANGE_HZ`].
#[must_use]
pub fn frequency_hz(grid: &ModelGrid) -> f64 {
    let centroids: Vec<f64> = grid
        .vertices
        .iter()
        .filter(|vertex| vertex.kind == VertexKind::Interior)
        .filter_map(|vertex| ArmaModel::at_vertex(grid, vertex).vibration())
        .map(|vibration| vibration.centroid_hz)
        .collect();
    let (low, high) = FREQ_RANGE_HZ;
    if centroids.is_empty() {
        return low;
    }
    let mean = centroids.iter().sum::<f64>() / centroids.len() as f64;
    (1.5 * mean).clamp(low, high)
}

/// A bank of [`SPEEDS`] traces of [`SAMPLES`] samples whose impulse is
/// [`IMPULSE_PER_SPEED`]·v after truncation, or less where `m_eff·a` would exceed
/// nine tenths of `f_max`.
#[must_use]
pub fn bank(freq_hz: f64, gains: &Gains) -> TapBank {
    let unit = unit_trace(freq_hz);
    let top_speed = SPEED_STEP_M_S * SPEEDS as f64;
    let peak = unit.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
    let limit = PEAK_SHARE * gains.f_max_n / (gains.effective_mass_kg * peak * top_speed);
    let per_speed = if gains.effective_mass_kg > 0.0 {
        IMPULSE_PER_SPEED.min(limit)
    } else {
        IMPULSE_PER_SPEED
    };
    TapBank {
        sample_rate_hz: SAMPLE_RATE_HZ,
        traces: (1..=SPEEDS)
            .map(|step| {
                let speed_m_s = SPEED_STEP_M_S * step as f64;
                TapTrace {
                    speed_m_s,
                    accel_m_s2: unit.iter().map(|a| a * per_speed * speed_m_s).collect(),
                }
            })
            .collect(),
    }
}

/// A decaying sinusoid with ∫a dt = 1, faded to zero at its end.
fn unit_trace(freq_hz: f64) -> Vec<f64> {
    let mut trace: Vec<f64> = (0..SAMPLES)
        .map(|n| {
            let t_s = n as f64 / SAMPLE_RATE_HZ;
            let left = (SAMPLES - n) as f64 / FADE_SAMPLES as f64;
            let fade = if left < 1.0 {
                0.5 - 0.5 * libm::cos(PI * left)
            } else {
                1.0
            };
            libm::exp(-t_s / DECAY_S) * libm::sin(TAU * freq_hz * t_s) * fade
        })
        .collect();
    let impulse = impulse_m_s(&trace, SAMPLE_RATE_HZ);
    for a in &mut trace {
        *a /= impulse;
    }
    trace
}

/// ∫a dt of a trace, m/s.
#[must_use]
pub fn impulse_m_s(accel_m_s2: &[f64], sample_rate_hz: f64) -> f64 {
    accel_m_s2.iter().sum::<f64>() / sample_rate_hz
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gains() -> Gains {
        Gains {
            vib_s2_m: 0.05 / 3.3,
            effective_mass_kg: 0.05,
            f_max_n: 3.3,
        }
    }

    #[test]
    fn the_impulse_is_as_stated_after_truncation() {
        for freq_hz in [80.0, 150.0, 350.0] {
            for trace in bank(freq_hz, &gains()).traces {
                let expected = IMPULSE_PER_SPEED * trace.speed_m_s;
                let found = impulse_m_s(&trace.accel_m_s2, SAMPLE_RATE_HZ);
                assert!((found / expected - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn no_tap_exceeds_the_device_and_a_weak_device_gets_weaker_taps() {
        for f_max_n in [0.1, 3.3] {
            let gains = Gains { f_max_n, ..gains() };
            let peak = bank(350.0, &gains)
                .traces
                .iter()
                .flat_map(|trace| trace.accel_m_s2.iter())
                .fold(0.0_f64, |peak, a| peak.max(a.abs()));
            assert!(gains.effective_mass_kg * peak <= PEAK_SHARE * f_max_n * (1.0 + 1e-12));
        }
    }

    #[test]
    fn a_brighter_bank_has_a_higher_centroid() {
        let centroid = |freq_hz| {
            let bank = bank(freq_hz, &gains());
            crate::signal::spectrum::trace_centroid_hz(&bank.traces[12].accel_m_s2, SAMPLE_RATE_HZ)
                .unwrap()
        };
        assert!(centroid(100.0) < centroid(200.0) && centroid(200.0) < centroid(350.0));
    }
}
