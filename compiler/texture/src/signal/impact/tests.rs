use super::*;
use crate::signal::spectrum::trace_centroid_hz;

/// Modulus in MPa and loss factor of jelly, foam, leather, paper, wood, stone and steel.
const MATERIALS: [(f64, f64); 7] = [
    (0.013, 0.2),
    (0.03, 0.45),
    (9.5, 0.15),
    (40.0, 0.08),
    (900.0, 0.03),
    (62_000.0, 0.008),
    (115_000.0, 0.002),
];
/// Those above which a material counts as hard, MPa.
const HARD_MPA: f64 = 500.0;

fn trace(modulus_mpa: f64, loss_factor: f64, speed_m_s: f64) -> [f64; SAMPLES] {
    Impact::of_material(modulus_mpa, loss_factor)
        .unit_trace(speed_m_s)
        .map(|a| a * speed_m_s)
}

fn cosine(x: &[f64], y: &[f64]) -> f64 {
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(a, b)| a * b).sum::<f64>();
    product(x, y) / (product(x, x) * product(y, y)).sqrt()
}

fn peak(trace: &[f64]) -> f64 {
    trace.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()))
}

/// Time from the touch to where the first pulse is below a tenth of its peak, over the part of a
/// Hertzian pulse that comes before that.
fn measured_contact_s(trace: &[f64]) -> f64 {
    let top = (0..SAMPLES)
        .max_by(|&i, &j| trace[i].total_cmp(&trace[j]))
        .unwrap();
    let level = 0.1 * trace[top];
    let after = (top..SAMPLES).find(|&n| trace[n] < level).unwrap();
    let fraction = (trace[after - 1] - level) / (trace[after - 1] - trace[after]);
    let crossing_s = (after as f64 - 1.0 + fraction) / SAMPLE_RATE_HZ;
    let before = 1.0 - libm::asin(libm::pow(0.1, 2.0 / 3.0)) / PI;
    crossing_s / before
}

#[test]
fn the_contact_of_a_hard_thing_lasts_as_hertz_says() {
    for (modulus_mpa, loss_factor) in MATERIALS {
        if modulus_mpa < HARD_MPA {
            continue;
        }
        let impact = Impact::of_material(modulus_mpa, loss_factor);
        for speed_m_s in speeds_m_s() {
            let found = measured_contact_s(&impact.unit_trace(speed_m_s));
            let theory = impact.contact_s * (speed_m_s / REFERENCE_SPEED_M_S).powf(-0.2);
            let ratio = found / theory;
            assert!(
                (ratio - 1.0).abs() < 0.2,
                "{modulus_mpa} MPa, {speed_m_s} m/s: {ratio}"
            );
        }
    }
}

#[test]
fn the_peak_force_grows_with_the_six_fifths_of_the_speed() {
    for (modulus_mpa, loss_factor) in MATERIALS {
        let ratio = peak(&trace(modulus_mpa, loss_factor, 0.325))
            / peak(&trace(modulus_mpa, loss_factor, 0.025));
        let exponent = ratio.ln() / 13.0_f64.ln();
        assert!(
            (exponent - 1.2).abs() < 0.08,
            "{modulus_mpa} MPa: {exponent}"
        );
    }
}

#[test]
fn the_slowest_and_the_fastest_trace_of_a_bank_are_not_alike() {
    for (modulus_mpa, loss_factor) in MATERIALS {
        let bank = bank(&Impact::of_material(modulus_mpa, loss_factor), 0.04, 59.0);
        let alike = cosine(&bank[0], &bank[SPEEDS - 1]);
        assert!(alike <= 0.8, "{modulus_mpa} MPa: {alike}");
    }
}

#[test]
fn a_trace_between_two_others_is_nearer_to_their_mean_than_to_either() {
    for (modulus_mpa, loss_factor) in MATERIALS {
        let bank = bank(
            &Impact::of_material(modulus_mpa, loss_factor),
            1.0,
            f64::INFINITY,
        );
        for n in 0..SPEEDS - 1 {
            let between = (speeds_m_s()[n] + speeds_m_s()[n + 1]) * 0.5;
            let truth = trace(modulus_mpa, loss_factor, between);
            let distance = |of: &dyn Fn(usize) -> f64| -> f64 {
                truth
                    .iter()
                    .enumerate()
                    .map(|(i, a)| (a - of(i)).powi(2))
                    .sum()
            };
            let mixed = distance(&|i| 0.5 * (bank[n][i] + bank[n + 1][i]));
            let nearest = distance(&|i| bank[n][i]).min(distance(&|i| bank[n + 1][i]));
            assert!(
                mixed < 0.5 * nearest,
                "{modulus_mpa} MPa, {between} m/s: {mixed} {nearest}"
            );
        }
    }
}

#[test]
fn a_faster_or_harder_tap_is_brighter() {
    let centroid = |modulus_mpa: f64, speed_m_s: f64| {
        trace_centroid_hz(&trace(modulus_mpa, 0.05, speed_m_s), SAMPLE_RATE_HZ).unwrap()
    };
    let moduli = || (-8..=20).map(|step| libm::exp10(f64::from(step) / 4.0));
    for modulus_mpa in moduli() {
        let by_speed: Vec<f64> = speeds_m_s().map(|v| centroid(modulus_mpa, v)).into();
        assert!(
            by_speed.is_sorted_by(|a, b| a < b),
            "{modulus_mpa} MPa: {by_speed:?}"
        );
    }
    let by_modulus: Vec<f64> = moduli()
        .map(|modulus_mpa| centroid(modulus_mpa, 0.325))
        .collect();
    assert!(by_modulus.is_sorted_by(|a, b| a < b), "{by_modulus:?}");
}

#[test]
fn a_trace_starts_from_nothing_has_its_impulse_and_ends_faded() {
    for (modulus_mpa, loss_factor) in MATERIALS {
        let impact = Impact::of_material(modulus_mpa, loss_factor);
        for speed_m_s in speeds_m_s() {
            let trace = impact.unit_trace(speed_m_s);
            assert!(trace[0] == 0.0 && trace.iter().all(|a| a.is_finite()));
            assert!((trace.iter().sum::<f64>() / SAMPLE_RATE_HZ - 1.0).abs() < 1e-12);
            assert!(trace[SAMPLES - 1].abs() < 0.01 * peak(&trace));
        }
    }
}

/// Transients to be learned must have no step: a thousandth of a decade or of a loss factor moves a trace by 3 % of its
/// size at most.
#[test]
fn a_trace_changes_smoothly_with_the_material_and_the_speed() {
    let far = |x: &[f64; SAMPLES], y: &[f64; SAMPLES]| {
        let size: f64 = x.iter().map(|a| a * a).sum();
        let step: f64 = x.iter().zip(y).map(|(a, b)| (a - b) * (a - b)).sum();
        (step / size).sqrt()
    };
    for step in 0..7300 {
        let decades = -2.0 + f64::from(step) * 1e-3;
        let of = |decades: f64, loss_factor: f64, speed: f64| {
            trace(libm::exp10(decades), loss_factor, speed)
        };
        let loss_factor = 0.002 + 0.498 * f64::from(step % 100) / 100.0;
        let base = of(decades, loss_factor, 0.3);
        assert!(
            far(&base, &of(decades + 1e-3, loss_factor, 0.3)) < 0.03,
            "{decades}"
        );
        assert!(
            far(&base, &of(decades, loss_factor * 1.001, 0.3)) < 0.03,
            "{decades}"
        );
        assert!(
            far(&base, &of(decades, loss_factor, 0.3003)) < 0.03,
            "{decades}"
        );
    }
}

#[test]
fn losses_lean_the_pulse_forward_and_a_dent_shortens_the_contact() {
    let centre = |pulse: Pulse| {
        let (mut sum, mut moment) = (0.0, 0.0);
        for n in 0..1000 {
            let t_s = f64::from(n) * 1e-5;
            sum += pulse.at(t_s);
            moment += t_s * pulse.at(t_s);
        }
        moment / sum
    };
    let pulse = |restitution, set| Pulse {
        time_s: 5e-3,
        restitution,
        set,
    };
    assert!((centre(pulse(1.0, 0.0)) - 2.5e-3).abs() < 1e-6);
    assert!(centre(pulse(0.5, 0.0)) < centre(pulse(1.0, 0.0)));
    assert!(pulse(1.0, 0.0).at(4.5e-3) > 0.0 && pulse(1.0, 0.5).at(4.5e-3) == 0.0);
}

#[test]
fn a_mode_falls_by_60_db_in_its_decay_time() {
    let damping = resonator::damping_of_decay(500.0, 0.02);
    let mut input = vec![0.0; 1000];
    input[0] = 1.0;
    let response: Vec<f64> = Resonator::new(500.0, damping, SAMPLE_RATE_HZ)
        .response(&input)
        .collect();
    let level = |from: usize| peak(&response[from..from + 20]);
    let fallen_db = 20.0 * (level(20) / level(220)).log10();
    assert!((fallen_db - 60.0).abs() < 0.5, "{fallen_db}");
    // The gain at 0 Hz is one within the error of sampling.
    assert!((response.iter().sum::<f64>() - 1.0).abs() < 0.02);
}

#[test]
fn a_modulus_comes_back_from_its_contact_time() {
    for modulus_mpa in [0.02, 1.0, 900.0, 60_000.0] {
        let contact_s = Impact::of_material(modulus_mpa, 0.1).contact_s;
        assert!((Impact::modulus_mpa(contact_s) / modulus_mpa - 1.0).abs() < 1e-9);
    }
}
