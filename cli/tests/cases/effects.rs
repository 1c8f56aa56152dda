//! Effects and models of other writers.

use super::{Case, Check};

pub(super) const CHECKS: &[(&str, Check)] = &[
    (
        "ahap-control-semantics",
        controls_as_core_haptics_plays_them,
    ),
    ("ahap-envelope-ignored", envelopes_are_named),
    ("ahap-lenient", what_is_not_used_refuses_no_ahap),
    ("ahap-trailing-comma", trailing_commas_are_read),
    ("effect-refusal-names-no-cause", what_was_left_out_is_named),
    ("asset-line-ends", conversions_of_an_asset_are_named),
    ("lfs-pointer", pointers_of_git_lfs_are_named),
    (
        "unknown-haptic-formats",
        strangers_are_named_by_every_import,
    ),
    (
        "wrong-format-help",
        other_formats_are_named_with_their_command,
    ),
];

/// The RMS of a continuous event at full intensity, m/s²: 5/√2.
const FULL_M_S2: f64 = 3.5355;

fn controls_as_core_haptics_plays_them(case: &Case) {
    for (file, expected) in [
        ("intensity_step.ahap", FULL_M_S2),
        ("before_curve.ahap", FULL_M_S2),
        ("late_mute.ahap", FULL_M_S2),
        ("gap.ahap", 2.99),
        ("sharpness_step.ahap", FULL_M_S2),
    ] {
        case.import("ahap", file);
        let rms = case.stroke_power().0.iter().sum::<f64>().sqrt();
        assert!((rms / expected - 1.0).abs() < 0.02, "{file}: {rms} m/s²");
    }
    let (power, bin_hz) = case.stroke_power();
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

fn envelopes_are_named(case: &Case) {
    for (file, named) in [
        (
            "adsr.ahap",
            &["AttackTime", "DecayTime", "ReleaseTime", "Sustained"][..],
        ),
        ("control.ahap", &["HapticAttackTimeControl"]),
    ] {
        let said = case.import("ahap", file);
        for name in named {
            assert!(said.contains(name), "{file}: {name}: {said}");
        }
    }
}

fn what_is_not_used_refuses_no_ahap(case: &Case) {
    for (file, warned) in [
        ("audio_curve.ahap", "AudioVolumeControl"),
        ("created_number.ahap", ""),
        ("metadata_null.ahap", ""),
        ("rounding.ahap", "clamped"),
        ("sharpness_minus_1.ahap", "clamped"),
        ("version_string.ahap", ""),
    ] {
        let said = case.import("ahap", file);
        assert!(said.contains(warned), "{file}: {said}");
    }
}

fn trailing_commas_are_read(case: &Case) {
    case.import("ahap", "in.ahap");
}

fn what_was_left_out_is_named(case: &Case) {
    for (kind, file, named) in [
        ("ahap", "audio_only.ahap", "AudioCustom"),
        ("ahap", "typo.ahap", "HapticContinous"),
        ("hjif", "texture_modality.hjif", "Vibrotactile Texture"),
    ] {
        let path = case.file(file);
        case.refused(
            &["import", kind, &path, "-o", "out.asp"],
            &[file, "no effect that sounds", named],
        );
    }
}

fn pointers_of_git_lfs_are_named(case: &Case) {
    for (kind, file) in [
        ("hatt", "x.xml"),
        ("haptic", "x.haptic"),
        ("ahap", "x.haptic"),
        ("hjif", "x.haptic"),
        ("model", "x.haptic"),
    ] {
        let path = case.file(file);
        case.refused(
            &["import", kind, &path, "-o", "out.asp"],
            &[file, "Git LFS pointer", "git lfs pull"],
        );
    }
}

fn other_formats_are_named_with_their_command(case: &Case) {
    for (file, own, names) in [
        ("x.ahap", "ahap", ["AHAP", "import ahap"]),
        ("x.haps", "", ["Interhaptics .haps", "export the effect"]),
        ("x.hasp", "", ["Haptics Studio", "import haptic"]),
        ("x.tact", "", ["bHaptics .tact", "export the effect"]),
        ("vij0.haptic", "", ["version 0", "version 1"]),
    ] {
        let path = case.file(file);
        for kind in ["haptic", "ahap", "hjif"] {
            if kind != own {
                case.refused(
                    &["import", kind, &path, "-o", "out.asp"],
                    &[file, names[0], names[1]],
                );
            }
        }
    }
}

fn strangers_are_named_by_every_import(case: &Case) {
    for (file, named) in [
        ("android.xml", "an Android vibration (XML)"),
        ("bplist.ahap", "a property list"),
        ("in_plist.ahap", "a property list"),
        ("notfound.ahap", "a server's message"),
        ("notfound.haptic", "a server's message"),
        ("single_quotes.ahap", "Python"),
        ("string_json.ahap", "encoded twice"),
        ("unity_asset.haptic", "a Unity asset"),
        ("unity_meta.haptic", "a Unity .meta file"),
        ("waveform.json", "an Android vibration waveform"),
        ("x.funscript", "a funscript"),
    ] {
        let path = case.file(file);
        for kind in ["ahap", "haptic", "hjif", "hatt", "model"] {
            case.refused(&["import", kind, &path, "-o", "out.asp"], &[file, named]);
        }
        case.refused(&["inspect", &path], &[file, named]);
    }
    let nan = case.file("nan.ahap");
    case.refused(
        &["import", "ahap", &nan, "-o", "out.asp"],
        &["ParameterValue: NaN at line 15", "JSON has no NaN"],
    );
}

fn conversions_of_an_asset_are_named(case: &Case) {
    for (file, named) in [
        ("crlf.asp", "its line ends were converted"),
        ("utf8.asp", "it was read as text"),
    ] {
        let path = case.file(file);
        let says = [file, named, "*.asp binary", "fetch it again"];
        case.refused(&["inspect", &path], &says);
        case.refused(&["list", &path], &says);
        case.refused(&["preview", &path, "-o", "x.png"], &says);
    }
}
