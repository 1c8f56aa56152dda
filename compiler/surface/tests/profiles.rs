//! Profiles as tables, in the units and with the faults that they come with.

use asperity_surface::map::{Size, profile};

fn wide(width_mm: f64) -> Size {
    Size {
        width_mm: Some(width_mm),
        depth_mm: None,
    }
}

/// Claim: a profile in any units is the same field, with its own width; gaps, disorder and missing units are named.
#[test]
fn profiles_are_tables() {
    let size = Size {
        width_mm: None,
        depth_mm: None,
    };
    let table = |head: &str, per_x: f64, per_z: f64| {
        let row = |n: i32| {
            let x = 0.05 * f64::from(n);
            format!("{},{}\n", x / per_x, 1e-3 * (4.0 * x).sin() / per_z)
        };
        head.to_owned() + &(0..400).map(row).collect::<String>()
    };
    let rms = |text: &str, size: &Size| profile(text.as_bytes(), size).unwrap().field.rms_um();
    let millimetres = rms(&table("x_mm,z_mm\n", 1.0, 1.0), &size);
    assert!((millimetres - 0.5_f64.sqrt()).abs() < 0.02, "{millimetres}");
    for (text, size) in [
        (table("Position (µm),Height (nm)\n", 1e-3, 1e-6), size),
        (table("x,z\nm,um\n", 1e3, 1e-3), size),
        (table("x_mm,z_um\n", 1.0, 1e-3), wide(20.0)),
    ] {
        let size = Size {
            depth_mm: None,
            ..size
        };
        assert!(
            (rms(&text, &size) / millimetres - 1.0).abs() < 1e-3,
            "{text:.30}"
        );
    }
    let good = table("x_mm,z_um\n", 1.0, 1e-3);
    for (text, size, words) in [
        (
            good.clone(),
            wide(50.0),
            &["width_mm", "span 19.950 mm"][..],
        ),
        (good.replace("x_mm", "y"), size, &["one column of heights"]),
        (
            good.replace("z_um", "z"),
            size,
            &["\"z\" has no unit", "x_mm and z_um"],
        ),
        (
            good.replacen("\n0.1,", "\n0.01,", 1),
            size,
            &["positions do not ascend"],
        ),
        (
            good.replacen("\n0.1,", "\n0.1,nan", 1),
            size,
            &["is no length", "fill the gap"],
        ),
        (table("x_mm,z_um\n", 0.05, 1e-3), size, &["1.00 mm apart"]),
        (
            "z_um\n".to_owned() + &"1\n2\n".repeat(20),
            size,
            &["no picture says its width"],
        ),
    ] {
        let fault = profile(text.as_bytes(), &size).unwrap_err();
        let message = format!("{fault}; {}", fault.remedy);
        for word in words {
            assert!(message.contains(word), "{word}: {message}");
        }
    }
}
