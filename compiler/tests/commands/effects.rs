//! Effects of other tools: the levels they give, and what a file is that is refused.

use super::*;
use serde_json::Value;
use std::path::PathBuf;

/// The RMS of a full scale at full intensity, m/s²: 5/√2.
const FULL_M_S2: f64 = 3.5355;

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../tests/cases")
        .join(name)
}

/// Power of a texture's stroke by frequency: at each of the rate's frequencies, m/s² squared, and their distance.
fn stroke_power(folder: &Path) -> (Vec<f64>, f64) {
    let output = asperity(folder, &["inspect", "out.asp", "--json"]);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let ar = &json["ar"];
    let vertices = ar["vertices"].as_array().unwrap();
    let sigma = |v: &&Value| v["sigma_m_s2"].as_f64().unwrap();
    let at = |v: &&Value| v["speed_mm_s"] == 100.0 && v["force_n"] == 1.0;
    let vertex = vertices.iter().find(at).expect("the stroke");
    let lsf: Vec<f64> = vertex["lsf_rad"]
        .as_array()
        .unwrap()
        .iter()
        .map(|w| w.as_f64().unwrap())
        .collect();
    let level = sigma(&vertex) * vertex["gain"].as_f64().unwrap_or(1.0);
    let bins = 20_000;
    let power = (0..bins).map(|n| {
        let w = std::f64::consts::PI * (f64::from(n) + 0.5) / f64::from(bins);
        // |A|² of LSFs: the sum and the difference polynomial, by their angles.
        let product = |first: usize| -> f64 {
            let own = lsf.iter().skip(first).step_by(2);
            own.map(|l| 2.0 * (w.cos() - l.cos())).product()
        };
        let (sum, difference) = (product(0), product(1));
        let even = lsf.len().is_multiple_of(2);
        let a = if even {
            (sum * (0.5 * w).cos()).powi(2) + (difference * (0.5 * w).sin()).powi(2)
        } else {
            0.25 * (sum.powi(2) + (2.0 * difference * w.sin()).powi(2))
        };
        (2.0 * (0.5 * w).cos() * level).powi(2) / a / f64::from(bins)
    });
    let rate_hz = ar["sample_rate_hz"].as_f64().unwrap();
    (power.collect(), 0.5 * rate_hz / f64::from(bins))
}

#[test]
fn controls_give_the_levels_and_frequencies_that_core_haptics_plays() {
    let folder = tempfile::tempdir().unwrap();
    let import = |name: &str| {
        let file = case("ahap-control-semantics").join(name);
        let file = file.to_str().unwrap();
        let output = asperity(
            folder.path(),
            &["import", "ahap", file, "-o", "out.asp", "--no-preview"],
        );
        assert!(output.status.success(), "{}", text(&output.stderr));
        stroke_power(folder.path())
    };
    for (name, expected) in [
        ("intensity_step.ahap", FULL_M_S2),
        ("before_curve.ahap", FULL_M_S2),
        ("late_mute.ahap", FULL_M_S2),
        ("gap.ahap", 2.99),
        ("sharpness_step.ahap", FULL_M_S2),
    ] {
        let rms = import(name).0.iter().sum::<f64>().sqrt();
        assert!((rms / expected - 1.0).abs() < 0.02, "{name}: {rms} m/s²");
    }
    let (power, bin_hz) = import("sharpness_step.ahap");
    let share = |low: f64, high: f64| {
        let inside = &power[(low / bin_hz) as usize..(high / bin_hz) as usize];
        inside.iter().sum::<f64>() / power.iter().sum::<f64>()
    };
    let (low, high) = (share(40.0, 120.0), share(220.0, 400.0));
    assert!(
        (low - 0.5).abs() < 0.1 && (high - 0.5).abs() < 0.1,
        "{low} {high}"
    );
}

#[test]
fn what_is_not_used_or_out_of_range_refuses_no_ahap() {
    let folder = tempfile::tempdir().unwrap();
    for (file, warned) in [
        ("ahap-lenient/audio_curve.ahap", "AudioVolumeControl"),
        ("ahap-lenient/created_number.ahap", ""),
        ("ahap-lenient/metadata_null.ahap", ""),
        ("ahap-lenient/rounding.ahap", "clamped"),
        ("ahap-lenient/sharpness_minus_1.ahap", "clamped"),
        ("ahap-lenient/version_string.ahap", ""),
        ("ahap-trailing-comma/in.ahap", ""),
        ("ahap-envelope-ignored/adsr.ahap", "AttackTime"),
        ("ahap-envelope-ignored/adsr.ahap", "Sustained"),
        (
            "ahap-envelope-ignored/control.ahap",
            "HapticAttackTimeControl",
        ),
    ] {
        let path = case(file);
        let path = path.to_str().unwrap();
        let output = asperity(
            folder.path(),
            &["import", "ahap", path, "-o", "out.asp", "--no-preview"],
        );
        let error = text(&output.stderr);
        assert!(output.status.success(), "{file}: {error}");
        assert!(error.contains(warned), "{file}: {error}");
    }
}

#[test]
fn effects_that_do_not_sound_say_what_was_left_out() {
    let folder = tempfile::tempdir().unwrap();
    for (kind, file, named) in [
        ("ahap", "audio_only.ahap", "AudioCustom"),
        ("ahap", "typo.ahap", "HapticContinous"),
        ("hjif", "texture_modality.hjif", "Vibrotactile Texture"),
    ] {
        let path = case("effect-refusal-names-no-cause").join(file);
        let arguments = ["import", kind, path.to_str().unwrap(), "-o", "out.asp"];
        refused(
            folder.path(),
            &arguments,
            &[file, "no effect that sounds", named],
        );
    }
}

#[test]
fn a_file_of_another_format_is_named_with_the_command_that_reads_it() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("x.gltf"),
        r#"{"asset": {"version": "2.0"}}"#,
    )
    .unwrap();
    fs::write(
        folder.path().join("x.mat"),
        b"MATLAB 5.0 MAT-file, \0\x01IM",
    )
    .unwrap();
    fs::write(
        folder.path().join("x.xlsx"),
        b"PK\x03\x04\x14\0xl/workbook.xml",
    )
    .unwrap();
    fs::write(
        folder.path().join("x.hjif"),
        r#"{"version": "2023", "perceptions": [],}"#,
    )
    .unwrap();
    fs::write(folder.path().join("x.html"), "<!DOCTYPE html><html></html>").unwrap();
    for name in ["x.ahap", "x.haps", "x.hasp", "x.tact", "vij0.haptic"] {
        fs::copy(
            case("wrong-format-help").join(name),
            folder.path().join(name),
        )
        .unwrap();
    }
    fs::write(folder.path().join("x.hmpg"), hmpg(folder.path())).unwrap();
    let known = [
        ("x.ahap", "AHAP", "import ahap"),
        ("x.hjif", "HJIF", "import hjif"),
        ("x.hmpg", "HMPG", "Decoder"),
        ("x.haps", "Interhaptics .haps", "export the effect"),
        ("x.hasp", "Haptics Studio", "import haptic"),
        ("x.tact", "bHaptics .tact", "export the effect"),
        ("vij0.haptic", "version 0", "version 1"),
        ("x.gltf", "glTF", "not read"),
        ("x.mat", "MATLAB", "CSV"),
        ("x.xlsx", "Excel", "CSV"),
        ("x.html", "web page", "download"),
    ];
    for (file, name, help) in known {
        for kind in ["haptic", "ahap", "hjif", "hatt", "model"] {
            if help.ends_with(kind) && help.starts_with("import") && file.ends_with(kind) {
                continue;
            }
            let arguments = ["import", kind, file, "-o", "out.asp"];
            refused(folder.path(), &arguments, &[file, name, help]);
        }
        refused(folder.path(), &["inspect", file], &[file, name, help]);
        fs::write(
            folder.path().join("list.toml"),
            format!("[[texture]]\nname = \"a\"\nimport = \"{file}\"\n"),
        )
        .unwrap();
        for list in [file, "list.toml"] {
            refused(
                folder.path(),
                &["build", list, "-o", "out.aspl"],
                &[file, name, help],
            );
        }
    }
}

#[test]
fn a_trajectory_that_is_a_workbook_is_named() {
    let folder = tempfile::tempdir().unwrap();
    asperity(folder.path(), &["builtin", "-o", "grit.asp"]);
    fs::write(
        folder.path().join("x.csv"),
        b"PK\x03\x04\x14\0xl/workbook.xml",
    )
    .unwrap();
    let arguments = [
        "render",
        "grit.asp",
        "--trajectory",
        "x.csv",
        "-o",
        "out.csv",
    ];
    refused(
        folder.path(),
        &arguments,
        &["Excel workbook, not a trajectory", "CSV"],
    );
}

/// What the built-in texture exports to.
fn hmpg(folder: &Path) -> Vec<u8> {
    asperity(folder, &["builtin", "-o", "grit.asp"]);
    asperity(
        folder,
        &["export", "grit.asp", "--to", "hmpg", "-o", "grit.hmpg"],
    );
    fs::read(folder.join("grit.hmpg")).unwrap()
}

#[test]
fn a_pointer_of_git_lfs_is_named_wherever_a_file_is_read() {
    let folder = tempfile::tempdir().unwrap();
    asperity(folder.path(), &["builtin", "-o", "grit.asp"]);
    let pointer = fs::read(case("lfs-pointer").join("x.xml")).unwrap();
    for name in [
        "x.xml",
        "x.haptic",
        "x.csv",
        "x.toml",
        "x.jsonl",
        "clip/model.onnx",
        "model/model.json",
    ] {
        let file = folder.path().join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, &pointer).unwrap();
    }
    for arguments in [
        &["import", "hatt", "x.xml", "-o", "out.asp"][..],
        &["import", "haptic", "x.haptic", "-o", "out.asp"],
        &["import", "ahap", "x.haptic", "-o", "out.asp"],
        &["import", "hjif", "x.haptic", "-o", "out.asp"],
        &["import", "model", "x.haptic", "-o", "out.asp"],
        &["inspect", "x.xml"],
        &["build", "x.toml", "-o", "out.aspl"],
        &["build", "x.csv", "-o", "out.aspl"],
        &["build", "x.jsonl", "-o", "out.aspl"],
        &[
            "render",
            "grit.asp",
            "--trajectory",
            "x.csv",
            "-o",
            "out.csv",
        ],
        &[
            "compile",
            "wood",
            "-o",
            "out.asp",
            "--text-encoder",
            "clip:clip",
        ],
        &["compile", "wood", "-o", "out.asp", "--model", "model"],
    ] {
        refused(
            folder.path(),
            arguments,
            &["Git LFS pointer", "git lfs pull"],
        );
    }
}
