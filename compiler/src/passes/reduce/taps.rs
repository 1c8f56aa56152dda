//! Cuts tap traces where a hand no longer feels them.
//!
//! A tail is left out if none of its samples reaches 3 % of the trace's peak. People tell forces
//! apart at 6 to 10 %, and the project allows half of that. The impulse ∫a dt stays exact: what the
//! tail held is put back in proportion, which must not change the rest by more than the same 3 %.

use asperity_texture::model::{TapBank, TapTrace};

/// Fraction of a force that is not felt: half of 6 %, the smallest just noticeable difference of
/// a texture's force.
pub const UNFELT: f64 = 0.03;

/// The bank without its tails. All traces keep one length.
#[must_use]
pub fn audible(bank: &TapBank) -> TapBank {
    let samples = bank.traces.iter().map(|t| t.accel_m_s2.len()).max();
    let length = bank
        .traces
        .iter()
        .map(|trace| felt(&trace.accel_m_s2))
        .max();
    let (Some(samples), Some(length)) = (samples, length) else {
        return bank.clone();
    };
    // The trace that is felt longest decides, and the others must be fit to be cut there.
    let Some(length) = (length..=samples).find(|&n| {
        bank.traces
            .iter()
            .all(|t| scale(&t.accel_m_s2, n).is_some())
    }) else {
        return bank.clone();
    };
    let traces = bank
        .traces
        .iter()
        .map(|trace| {
            let scale = scale(&trace.accel_m_s2, length).unwrap_or(1.0);
            TapTrace {
                speed_m_s: trace.speed_m_s,
                accel_m_s2: trace.accel_m_s2[..length]
                    .iter()
                    .map(|a| scale * a)
                    .collect(),
            }
        })
        .collect();
    TapBank {
        sample_rate_hz: bank.sample_rate_hz,
        traces,
    }
}

/// Number of samples up to the last one that is felt, at least one.
fn felt(accel_m_s2: &[f64]) -> usize {
    let peak = accel_m_s2.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
    accel_m_s2
        .iter()
        .rposition(|a| a.abs() > UNFELT * peak)
        .map_or(1, |last| last + 1)
}

/// Returns the factor that preserves the impulse in the first `length` samples; `None` if it would be felt.
fn scale(accel_m_s2: &[f64], length: usize) -> Option<f64> {
    let kept: f64 = accel_m_s2.get(..length)?.iter().sum();
    let all: f64 = accel_m_s2.iter().sum();
    if kept == all {
        return Some(1.0);
    }
    let scale = all / kept;
    ((scale - 1.0).abs() <= UNFELT).then_some(scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sources::builtin;

    #[test]
    fn the_tail_goes_and_the_impulse_stays() {
        let bank = builtin::texture().taps;
        let cut = audible(&bank);
        assert!(cut.traces[0].accel_m_s2.len() < bank.traces[0].accel_m_s2.len());
        for (before, after) in bank.traces.iter().zip(&cut.traces) {
            let sum = |trace: &TapTrace| trace.accel_m_s2.iter().sum::<f64>();
            assert!((sum(after) / sum(before) - 1.0).abs() < 1e-12);
            let peak = before
                .accel_m_s2
                .iter()
                .fold(0.0_f64, |p, a| p.max(a.abs()));
            for (n, a) in before.accel_m_s2.iter().enumerate() {
                let kept = after.accel_m_s2.get(n).copied().unwrap_or(0.0);
                assert!((kept - a).abs() <= UNFELT * peak);
            }
        }
    }

    #[test]
    fn a_trace_that_does_not_decay_and_silence_stay_as_they_are() {
        let bank = |accel_m_s2: Vec<f64>| TapBank {
            sample_rate_hz: 1000.0,
            traces: vec![TapTrace {
                speed_m_s: 0.1,
                accel_m_s2,
            }],
        };
        let steady = bank(vec![1.0; 50]);
        assert_eq!(audible(&steady), steady);
        // The samples alternate, so that the impulse is all in the tail.
        let mut odd = vec![1.0, -1.0, 1.0, -1.0];
        odd.extend([0.02; 20]);
        assert_eq!(audible(&bank(odd.clone())), bank(odd));
        assert_eq!(audible(&TapBank::default()), TapBank::default());
        assert_eq!(audible(&bank(vec![0.0; 9])).traces[0].accel_m_s2.len(), 1);
    }
}
