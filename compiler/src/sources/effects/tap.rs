//! Transients as taps: the louder one is, the faster was the impact.

use crate::{
    interchange::playback::Transient,
    model::{TapBank, TapTrace},
};

/// Rate of the traces, Hz.
const RATE_HZ: f64 = 5000.0;
/// Least frequency of a trace, Hz: two periods of it are its length.
const LEAST_HZ: f64 = 50.0;
/// Most traces, and the least part of the loudest that is one.
const TRACES: usize = 13;
const LEAST: f64 = 0.02;
/// Amplitudes nearer than this are one.
const APART: f64 = 0.02;

/// A trace for each loudness; the loudest has an impact speed of `speed_m_s`, and the others are
/// slower as they are quieter.
pub(super) fn bank(transients: &[Transient], speed_m_s: f64, full_scale_m_s2: f64) -> TapBank {
    let mut all: Vec<Transient> = transients
        .iter()
        .map(|t| Transient {
            freq_hz: t.freq_hz.clamp(LEAST_HZ, 0.2 * RATE_HZ),
            ..*t
        })
        .collect();
    all.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let loudest = all.first().map_or(0.0, |t| t.amplitude);
    let mut chosen: Vec<Transient> = Vec::new();
    for transient in all {
        let next = chosen
            .last()
            .is_none_or(|last| last.amplitude - transient.amplitude > APART * loudest);
        if next && transient.amplitude > LEAST * loudest {
            chosen.push(transient);
        }
    }
    let spread = chosen.len().div_ceil(TRACES).max(1);
    let chosen: Vec<Transient> = chosen.into_iter().step_by(spread).collect();
    let longest = chosen.iter().map(|t| 2.0 / t.freq_hz).fold(0.0, f64::max);
    let samples = (longest * RATE_HZ).ceil() as usize + 1;
    TapBank {
        sample_rate_hz: RATE_HZ,
        traces: chosen
            .iter()
            .rev()
            .map(|transient| TapTrace {
                speed_m_s: speed_m_s * transient.amplitude / loudest,
                accel_m_s2: (0..samples)
                    .map(|n| full_scale_m_s2 * transient.value(n as f64 / RATE_HZ))
                    .collect(),
            })
            .collect(),
    }
}
