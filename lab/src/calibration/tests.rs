//! Three simulated devices, their tables, and what is wrong with some.

use super::*;
use asperity_io::diagnostic::Diagnostic as _;

/// Simulated devices whose masses differ by four either way: ±12 dB of acceleration.
fn devices() -> [DeviceConfig; 3] {
    let touch = DeviceConfig::touch().expect("built-in file");
    [0.25, 1.0, 4.0].map(|factor| {
        let mut device = touch.clone();
        device.mechanics.mass_kg = touch.mechanics.mass_kg.map(|kg| factor * kg);
        device.mechanics.coulomb_n = [0.02; 3];
        device.timing.transport_delay_ticks = if factor < 1.0 { 2 } else { 0 };
        device
    })
}

fn sweep() -> Sweep {
    Sweep::standard(1000.0, 1.0)
}

#[test]
fn three_simulated_devices_that_differ_by_12_db_agree_within_3_db() {
    for device in devices() {
        let measured = simulate(&device, &sweep());
        let (response, design) = measured.fit("simulated").expect("a fit");
        let mass_kg = device.mechanics.mass_kg[0];
        println!(
            "{mass_kg} kg: {:.1} dB before, {:.2} dB after",
            design.before_db, design.after_db
        );
        assert!(design.after_db < 3.0, "{design:?}");
        if (mass_kg - 0.045).abs() > 1e-6 {
            assert!(design.before_db > 10.0, "{design:?}");
        }
        let delay_s = 1e-3 * device.timing.transport_delay_ticks as f64;
        assert!(
            (response.delay_s - delay_s).abs() < 0.5e-3,
            "{}",
            response.delay_s
        );

        // Played through the filter, the simulated device has the reference's spectrum.
        let taps: Vec<f64> = design
            .filter
            .taps
            .iter()
            .map(|&tap| f64::from(tap))
            .collect();
        let force = sweep().force_n();
        let filtered: Vec<f64> = (0..force.len())
            .map(|n| {
                (0..taps.len().min(n + 1))
                    .map(|k| taps[k] * force[n - k])
                    .sum()
            })
            .collect();
        let mut machine = Device::new(&device, 0.0, [0.0; 3]);
        let accel: Vec<f64> = filtered
            .iter()
            .map(|&force_n| {
                let before = machine.velocity_m_s()[0];
                machine.command([force_n, 0.0, 0.0]);
                machine.advance(1e-3, |_, _| {
                    [Pull {
                        stiffness_n_m: 20.0,
                        damping_n_s_m: 0.2,
                        ..Pull::default()
                    }; 3]
                });
                (machine.velocity_m_s()[0] - before) * 1e3
            })
            .collect();
        let again = response::estimate(&force, &accel, 1000.0).expect("a response");
        for point in again
            .points
            .iter()
            .filter(|point| (40.0..=400.0).contains(&point.freq_hz))
        {
            let off_db = 20.0 * libm::log10(point.gain_m_s2_n / compensation::REFERENCE_M_S2_N);
            assert!(
                off_db.abs() < 3.0,
                "{mass_kg} kg: {off_db:.2} dB at {:.0} Hz",
                point.freq_hz
            );
        }
    }
}

#[test]
fn a_table_reads_back_and_bad_ones_are_named() {
    let short = Sweep {
        seconds: 0.2,
        ..sweep()
    };
    let measured = simulate(&devices()[1], &short);
    let again = Measured::from_csv(&measured.to_csv(), "a.csv").expect("a table");
    assert_eq!(
        (&again.force_n, &again.accel_m_s2),
        (&measured.force_n, &measured.accel_m_s2)
    );
    assert!((again.rate_hz - 1000.0).abs() < 1e-6);
    // A spreadsheet's dialect of the same table, with a column that nobody needs.
    let mut lines = measured.to_csv().replace(',', ";").replace('.', ",");
    lines = lines.replace('\n', ";x\r\n");
    let spread = Measured::from_csv(&lines, "a.csv").expect("a table");
    assert_eq!(spread, again);
    for (text, named) in [
        ("", "a.csv:1"),
        ("t,f,a\n", "the columns are t,f,a, but"),
        ("t_s,force_n,accel_m_s2\n0,0,0\n", "no two rows"),
        (
            "t_s,force_n,accel_m_s2\n0,0,0\n0.001,x,0\n",
            "force_n = `x`",
        ),
        (
            "t_s,force_n,accel_m_s2\n0,0,0\n0.001,0,nan\n",
            "accel_m_s2 = `nan`",
        ),
        ("t_s,force_n,accel_m_s2\n0,0,0\n0.001,0\n", "a.csv:3"),
        (
            "t_s,force_n,accel_m_s2\n0,0,0\n0.001,0,0\n0.005,0,0\n",
            "t_s = 0.005",
        ),
        ("t_s,force_n,accel_m_s2\n0,0,0\n0,0,0\n", "t_s = 0"),
    ] {
        let error = Measured::from_csv(text, "a.csv").expect_err(named);
        assert!(error.to_string().contains(named), "{error}");
        assert!(!error.remedy().is_empty());
    }
    let error = again.fit("a.csv").expect_err("too short");
    assert!(error.to_string().contains("too few"), "{error}");
}

#[test]
fn a_profile_of_a_simulation_says_that_nothing_in_it_is_confirmed() {
    let profile = profile_of(&devices()[1]);
    assert_eq!(profile.unconfirmed, FIELDS);
    assert!(Profile::from_toml(&profile.to_toml(), "simulated.toml").is_ok());
}

#[test]
fn an_accelerometer_that_fell_off_makes_no_profile() {
    let mut measured = simulate(&devices()[1], &sweep());
    let mut random = 1_u64;
    for accel in &mut measured.accel_m_s2 {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        *accel = (random >> 40) as f64;
    }
    let error = measured.fit("a.csv").expect_err("noise");
    assert!(
        matches!(error, CalibrationError::Coherence { .. }),
        "{error}"
    );
}

/// Claim: a unit under another's name is found by what it does to the gain and the force, and a
/// device within ±12 dB of its profile is none of that.
#[test]
fn a_wrong_unit_is_named_with_its_channel_and_factor() {
    let device = &devices()[1];
    let measured = simulate(device, &sweep());
    let doubted = |force: f64, accel: f64, bias_m_s2: f64| -> Vec<String> {
        let scaled = |values: &[f64], factor: f64, bias: f64| -> Vec<f64> {
            values.iter().map(|value| factor * (value + bias)).collect()
        };
        let scaled = Measured {
            rate_hz: measured.rate_hz,
            force_n: scaled(&measured.force_n, force, 0.0),
            accel_m_s2: scaled(&measured.accel_m_s2, accel, bias_m_s2),
        };
        let (response, design) = scaled.fit("a.csv").expect("a fit");
        let doubts = doubts("a.csv", &scaled, &response, &design, &profile_of(device));
        assert!(
            doubts
                .iter()
                .all(|doubt| doubt.remedy().contains("--force"))
        );
        doubts.iter().map(ToString::to_string).collect()
    };
    for (force, accel) in [(1.0, 1.0), (1.0, 0.4), (1.0, 2.5), (3.0, 3.0), (0.1, 0.1)] {
        assert_eq!(doubted(force, accel, 0.0), [""; 0], "{force} {accel}");
    }
    assert_eq!(doubted(1.0, 1.0, 9.81), [""; 0], "gravity along the force");
    const G: f64 = 9.806_65;
    for (force, accel, words) in [
        (1.0, 1.0 / G, ["accel_m_s2 fits g ", "9.81"]),
        (1.0, 1e3 / G, ["accel_m_s2 fits mg ", "102"]),
        (1.0, 1e3, ["accel_m_s2 fits mm/s^2 ", "1000"]),
        (1e3, 1.0, ["force_n fits mN ", "1000"]),
        (1e-3, 1.0, ["force_n fits kN ", "1000"]),
        (1e3 / G, 1.0, ["force_n fits gf ", "102"]),
        (1.0 / G, 1.0, ["force_n fits kgf ", "9.81"]),
        (1.0, 16.0, ["no unit", "16.0 times too high"]),
        (1.0, 1e6, ["no unit", ""]),
        (5.0, 5.0, ["force_n reaches 5.00 N", "1.52 times"]),
    ] {
        let doubts = doubted(force, accel, 0.0);
        let first = doubts.first().unwrap_or_else(|| panic!("{words:?}"));
        assert!(
            words.iter().all(|word| first.contains(word)),
            "{words:?}: {doubts:?}"
        );
    }
    let raised = doubted(1.0, 1.5, 9.81);
    assert!(raised[0].contains("1.50 times gravity"), "{raised:?}");

    // What no force bears is kept by nobody unasked, even of a device that is as heavy as it says.
    let mut heavy = device.clone();
    heavy.mechanics.mass_kg = [0.25; 3];
    let measured = simulate(&heavy, &sweep());
    let (response, design) = measured.fit("a.csv").expect("a fit");
    let doubts = doubts("a.csv", &measured, &response, &design, &profile_of(&heavy));
    assert!(
        doubts.len() == 1 && doubts[0].to_string().contains("coefficient"),
        "{doubts:?}"
    );
}
