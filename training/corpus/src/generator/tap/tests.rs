use super::*;
use crate::{TAP_RATE_HZ, TAP_SAMPLES, generator::transfer};
use asperity::spectrum::trace_centroid_hz;

/// Every material of the committed families.
fn materials() -> Vec<(String, Physical)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../corpora");
    let mut found = Vec::new();
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !name.ends_with(".toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        // Files of other forms hold no materials.
        if let Ok(family) = crate::reference::schema::parse(&name, &text) {
            let materials = family.material.iter();
            found.extend(materials.map(|m| (m.name.clone(), m.physical.values())));
        }
    }
    found
}

fn fastest(physical: &Physical) -> Vec<f64> {
    bank(physical)[TAPS - 1].map(f64::from).into()
}

#[test]
fn a_material_that_is_much_harder_has_a_higher_centroid_and_rises_faster() {
    let mut by_modulus: Vec<(f64, f64, f64, String)> = materials()
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
fn the_hand_behind_a_tap_is_the_hand_behind_a_stroke() {
    for (name, physical) in materials() {
        let tap_hz = impact(&physical).hand_hz;
        assert!(
            (tap_hz / transfer::resonance_hz(&physical, 1.0) - 1.0).abs() < 1e-12,
            "{name}"
        );
    }
}

#[test]
fn no_bank_exceeds_the_device_and_every_impulse_is_proportional_to_the_speed() {
    for (name, physical) in materials() {
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
