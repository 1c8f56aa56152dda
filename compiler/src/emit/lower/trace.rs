//! Tap samples in the codes of the format.

use crate::model::TapTrace;

/// Largest code of a tap sample.
const TAP_FULL_SCALE: f64 = 2047.0;

/// The trace rounded to its codes, with its impulse kept to half a step. Samples are rounded first;
/// then those that were nearest to being rounded the other way are, until the sum fits.
pub(super) fn quantise_trace(trace: &TapTrace) -> Vec<f32> {
    let accel = &trace.accel_m_s2;
    let peak = accel.iter().fold(0.0_f64, |peak, a| peak.max(a.abs())) as f32;
    // The encoder decides on traces that are silent, NaN or infinite.
    if !(peak > 0.0 && peak.is_finite()) {
        return accel.iter().map(|&a| a as f32).collect();
    }
    let scale = TAP_FULL_SCALE / f64::from(peak);
    let scaled: Vec<f64> = accel.iter().map(|a| a * scale).collect();
    let mut codes: Vec<f64> = scaled
        .iter()
        .map(|s| s.round().clamp(-TAP_FULL_SCALE, TAP_FULL_SCALE))
        .collect();
    let missing = (scaled.iter().sum::<f64>() - codes.iter().sum::<f64>()).round();
    let direction = missing.signum();
    let mut order: Vec<usize> = (0..codes.len()).collect();
    order.sort_by(|&i, &j| {
        let residue = |k: usize| (scaled[k] - codes[k]) * direction;
        residue(j).total_cmp(&residue(i)).then(i.cmp(&j))
    });
    // The code of the peak sets the scale, so it stays.
    let movable = order
        .into_iter()
        .filter(|&k| codes[k].abs() < TAP_FULL_SCALE)
        .take(missing.abs() as usize)
        .collect::<Vec<_>>();
    for k in movable {
        codes[k] += direction;
    }
    codes
        .iter()
        .map(|code| (*code as f32) / (TAP_FULL_SCALE as f32) * peak)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantised_trace_keeps_its_impulse_to_half_a_step() {
        for seed in 0..50 {
            let accel: Vec<f64> = (0..100)
                .map(|n| {
                    let t = f64::from(n) * 0.1;
                    (-t * 0.4).exp() * (t * (1.0 + f64::from(seed) * 0.07)).sin() * 21.3
                })
                .collect();
            let trace = TapTrace {
                speed_m_s: 0.1,
                accel_m_s2: accel.clone(),
            };
            let stored = quantise_trace(&trace);
            let peak = accel.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
            let step = peak / TAP_FULL_SCALE;
            let difference =
                stored.iter().map(|&a| f64::from(a)).sum::<f64>() - accel.iter().sum::<f64>();
            assert!(difference.abs() <= 0.501 * step, "{difference} of {step}");
            for (found, expected) in stored.iter().zip(&accel) {
                assert!((f64::from(*found) - expected).abs() <= 1.001 * step);
            }
        }
    }
}
