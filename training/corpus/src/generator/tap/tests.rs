use super::*;
use crate::{TAP_RATE_HZ, TAP_SAMPLES, reference};
use asperity::signal::spectrum::trace_centroid_hz;

fn fastest(physical: &Physical) -> Vec<f64> {
    bank(physical)[TAPS - 1].map(f64::from).into()
}

#[test]
fn a_material_that_is_much_harder_has_a_higher_centroid_and_rises_faster() {
    let mut by_modulus: Vec<(f64, f64, f64, String)> = reference::physical()
        .unwrap()
        .into_iter()
        .map(|(name, physical)| {
            let trace = fastest(&physical);
            let centroid_hz = trace_centroid_hz(&trace, TAP_RATE_HZ).unwrap();
            (physical.modulus_mpa, centroid_hz, trace[3], name)
        })
        .collect();
    by_modulus.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (index, soft) in by_modulus.iter().enumerate() {
        for hard in &by_modulus[index..] {
            if hard.0 > 3.0 * soft.0 {
                assert!(
                    hard.1 > soft.1,
                    "{} {} Hz, {} {} Hz",
                    soft.3,
                    soft.1,
                    hard.3,
                    hard.1
                );
                assert!(
                    hard.2 > soft.2,
                    "{} {} m/s², {} {}",
                    soft.3,
                    soft.2,
                    hard.3,
                    hard.2
                );
            }
        }
    }
}

#[test]
fn no_bank_exceeds_the_device_and_every_impulse_is_proportional_to_the_speed() {
    for (name, physical) in reference::physical().unwrap() {
        let bank = bank(&physical);
        let impulse = |trace: &[f32; TAP_SAMPLES]| trace.iter().map(|&a| f64::from(a)).sum::<f64>();
        for (trace, speed) in bank.iter().zip(impact::speeds_m_s()) {
            assert!(
                trace.iter().all(|a| a.is_finite() && a.abs() <= 59.001),
                "{name}"
            );
            let ratio = impulse(trace) / impulse(&bank[TAPS - 1]) * 0.325 / speed;
            assert!((ratio - 1.0).abs() < 1e-4, "{name}: {ratio}");
        }
    }
}
