//! `asperity record-check` and `asperity import recording`: what is accepted, what is refused and why.

use super::{asperity, entries, good, refused, text};
use std::{f64::consts::TAU, fmt::Write as _, fs, path::Path};
use tempfile::TempDir;

/// Speeds, mm/s, and loads, N, of strokes of 1.2 s each.
const STROKES: [(f64, f64); 9] = [
    (30.0, 0.5),
    (60.0, 0.5),
    (100.0, 0.5),
    (30.0, 1.0),
    (60.0, 1.0),
    (100.0, 1.0),
    (30.0, 1.6),
    (60.0, 1.6),
    (100.0, 1.6),
];
const STROKE: usize = 1200;

/// [`table_with`] a friction of 0.3.
pub(super) fn table(strokes: usize) -> String {
    table_with(&STROKES[..strokes], |_| 0.3)
}

/// A table at 1 kHz: a second in the air, then strokes, with vibration that grows with the speed and a
/// friction of `mu_at` a speed, mm/s.
fn table_with(strokes: &[(f64, f64)], mu_at: impl Fn(f64) -> f64) -> String {
    let mut state = 3_u64;
    let mut noise = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let mut csv = "t,ax,az,fx,fz,x\n".to_owned();
    let mut row = |n: usize, a: f64, fx: f64, fz: f64, x: f64| {
        // Writing to a string cannot fail.
        let _ = writeln!(
            csv,
            "{:.3},{a:.5},{:.5},{fx:.5},{fz:.5},{x:.5}",
            n as f64 / 1000.0,
            9.81 + 0.02 * noise(),
        );
    };
    let mut vibration = 0.0;
    let mut other = 5_u64;
    let mut x = 0.0;
    let mut rng = move || {
        other = other
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (other >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    for n in 0..1000 {
        row(n, 0.02 * rng(), 0.002 * rng(), 0.002 * rng(), x);
    }
    for (stroke, &(speed, load)) in strokes.iter().enumerate() {
        let side = if stroke % 2 == 0 { 1.0 } else { -1.0 };
        for n in 0..STROKE {
            // Half a period of a wave that is flat for most of it.
            let part = n as f64 / STROKE as f64;
            let v = side * speed * (12.0 * (0.5 * TAU * part).sin()).tanh();
            x += v / 1000.0;
            vibration = 0.6 * vibration + 0.02 * v.abs() * rng();
            row(
                1000 + stroke * STROKE + n,
                vibration + 0.02 * rng(),
                -mu_at(v.abs()) * load * (v / 5.0).tanh() + 0.002 * rng(),
                load + 0.002 * rng(),
                x,
            );
        }
    }
    csv
}

pub(super) fn description() -> String {
    let mut text = "name = \"Oak\"\n[[file]]\npath = \"all.csv\"\nclock = \"t\"\n".to_owned();
    for (column, quantity, axis, unit) in [
        ("ax", "acceleration", "x", "m/s^2"),
        ("az", "acceleration", "z", "m/s^2"),
        ("fx", "force", "x", "N"),
        ("fz", "force", "z", "N"),
        ("x", "position", "x", "mm"),
    ] {
        let _ = writeln!(
            text,
            "[[file.channel]]\ncolumn = \"{column}\"\nquantity = \"{quantity}\"\naxis = \"{axis}\"\nunit = \"{unit}\""
        );
    }
    text
}

/// A working folder with the recording `oak` in it.
pub(super) fn recorded(table: &str, description: Option<&str>) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let oak = folder.path().join("oak");
    fs::create_dir(&oak).expect("a folder");
    fs::write(oak.join("all.csv"), table).expect("written");
    if let Some(description) = description {
        fs::write(oak.join("recording.toml"), description).expect("written");
    }
    folder
}

/// Checks that `record-check` and `import recording` both refuse a recording and leave no file, and returns their
/// message.
fn refused_by_both(folder: &Path) -> String {
    let check = asperity(folder, &["record-check", "oak"]);
    let import = asperity(folder, &["import", "recording", "oak", "-o", "oak.asp"]);
    for output in [&check, &import] {
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        assert!(text(&output.stderr).starts_with("error: "));
    }
    assert_eq!(entries(folder), ["oak"]);
    assert_eq!(text(&check.stderr), text(&import.stderr));
    text(&check.stderr)
}

#[test]
fn a_recording_becomes_an_asset_with_its_friction() {
    let folder = recorded(&table(9), Some(&description()));
    let check = asperity(folder.path(), &["record-check", "oak"]);
    assert!(check.status.success(), "{}", text(&check.stdout));
    let arguments = [
        "import",
        "recording",
        "oak",
        "-o",
        "oak.asp",
        "--no-preview",
        "--report",
        "oak.json",
    ];
    let import = asperity(folder.path(), &arguments);
    assert!(import.status.success(), "{}", text(&import.stderr));
    assert_eq!(entries(folder.path()), ["oak", "oak.asp", "oak.json"]);
    let report = fs::read_to_string(folder.path().join("oak.json")).expect("the report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let mu = report["friction"]["mu"]
        .as_f64()
        .expect("recorded friction");
    assert!((mu / 0.3 - 1.0).abs() < 0.05, "{mu}");
    assert_eq!(report["sources"]["grid"], "recorded");
    assert_eq!(report["sources"]["taps"], "completed", "nothing was tapped");
    let inspect = asperity(folder.path(), &["inspect", "oak.asp"]);
    assert!(inspect.status.success());
}

/// The slowest, a middle and the fastest speed of a surface whose friction falls as Stribeck says, and of
/// one where it rises as a power, whatever the load: as recorded, within 5 %.
#[test]
fn friction_that_depends_on_speed_comes_back_and_is_said_to_be_rendered() {
    let strokes: Vec<(f64, f64)> = [0.5, 1.0, 1.6]
        .into_iter()
        .flat_map(|load| [25.0, 45.0, 70.0, 110.0, 160.0].map(|speed| (speed, load)))
        .collect();
    let falling = |v: f64| 0.3 + 0.5 * (-v / 40.0).exp();
    let rising = |v: f64| 0.4 * (v.max(1.0) / 100.0).powf(0.3);
    let laws: [&dyn Fn(f64) -> f64; 2] = [&falling, &rising];
    for mu_at in laws {
        let folder = recorded(&table_with(&strokes, mu_at), Some(&description()));
        let arguments = [
            "import",
            "recording",
            "oak",
            "-o",
            "oak.asp",
            "--no-preview",
        ];
        let import = asperity(folder.path(), &arguments);
        assert!(import.status.success(), "{}", text(&import.stderr));
        let said = [text(&import.stdout), text(&import.stderr)].concat();
        assert!(said.contains("rendered over speed from"), "{said}");

        let inspect = asperity(folder.path(), &["inspect", "oak.asp", "--json"]);
        let asset: serde_json::Value = serde_json::from_slice(&inspect.stdout).expect("JSON");
        assert_eq!(asset["format_version"], 2);
        let mu = asset["friction"]["mu"].as_f64().expect("μ");
        let points: Vec<(f64, f64)> = asset["friction"]["law"]
            .as_array()
            .expect("a law")
            .iter()
            .map(|p| {
                (
                    p["speed_mm_s"].as_f64().unwrap(),
                    p["factor"].as_f64().unwrap(),
                )
            })
            .collect();
        let rendered = |v: f64| {
            let above = points.partition_point(|p| p.0 <= v);
            let (from, to) = (above.saturating_sub(1), above.min(points.len() - 1));
            let ((slow, at_slow), (fast, at_fast)) = (points[from], points[to]);
            let part = if from == to {
                0.0
            } else {
                (v - slow) / (fast - slow)
            };
            mu * (at_slow + (at_fast - at_slow) * part)
        };
        for speed_mm_s in [30.0, 70.0, 150.0] {
            let (found, exact) = (rendered(speed_mm_s), mu_at(speed_mm_s));
            assert!(
                (found / exact - 1.0).abs() < 0.05,
                "{speed_mm_s} mm/s: {found}, not {exact}"
            );
        }
    }
}

#[test]
fn without_a_description_one_is_proposed_that_names_the_columns() {
    let folder = recorded(&table(1), None);
    let told = refused_by_both(folder.path());
    assert!(told.contains("has no recording.toml"), "{told}");
    let proposed = text(&asperity(folder.path(), &["record-check", "oak"]).stdout);
    for part in ["clock = \"t\"", "column = \"ax\"", "column = \"fz\""] {
        assert!(proposed.contains(part), "{part} in {proposed}");
    }
    // The same draft is written on request, once.
    let init = ["record-check", "oak", "--init"];
    let told = good(folder.path(), &init);
    assert!(
        told.contains("look at") && told.contains("a guess"),
        "{told}"
    );
    let written = fs::read_to_string(folder.path().join("oak/recording.toml")).expect("a draft");
    assert_eq!(written, proposed);
    refused(folder.path(), &init, &["recording.toml", "already exists"]);
    refused(
        folder.path(),
        &["record-check", "nowhere", "--init"],
        &["nowhere"],
    );
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    refused(
        folder.path(),
        &["record-check", "empty", "--init"],
        &["empty", ".wav"],
    );
    // With its guesses corrected it is a description.
    fs::write(folder.path().join("oak/recording.toml"), proposed).expect("written");
    let again = asperity(folder.path(), &["record-check", "oak"]);
    assert!(!text(&again.stderr).contains("no recording.toml"));
}

#[test]
fn what_is_wrong_is_named_with_file_and_line() {
    let good = table(3);
    let nan = good.replacen(",9.8", ",x9.8", 1);
    for (table, description, told) in [
        (
            &good,
            description().replace("unit = \"N\"", "unit = \"dyn\""),
            "recording.toml:",
        ),
        (
            &good,
            description().replace("clock = \"t\"", "clock = \"t\"\nrate_hz = 5000"),
            "rate_hz says 5000 Hz, the clock says 1000",
        ),
        (&nan, description(), "all.csv:2: column \"az\" holds \"x9.8"),
        (
            &good,
            description().replace("all.csv", "none.csv"),
            "none.csv",
        ),
        (
            &good,
            description().replace("all.csv", "../all.csv"),
            "../all.csv",
        ),
    ] {
        let folder = recorded(table, Some(&description));
        let found = refused_by_both(folder.path());
        assert!(found.contains(told), "{told} in {found}");
    }
}

#[test]
fn a_second_is_too_little_and_four_are_no_texture() {
    let short: String = table(1).lines().take(1001).fold(String::new(), |mut s, l| {
        s += l;
        s.push('\n');
        s
    });
    let folder = recorded(&short, Some(&description()));
    assert!(refused_by_both(folder.path()).contains("1.00 s"));
    let folder = recorded(&table(2), Some(&description()));
    let arguments = ["import", "recording", "oak", "-o", "oak.asp"];
    let import = asperity(folder.path(), &arguments);
    assert_eq!(import.status.code(), Some(1));
    assert!(
        text(&import.stderr).contains("usable strokes in 8 segments; at least 3 s are needed"),
        "{}",
        text(&import.stderr)
    );
    assert_eq!(entries(folder.path()), ["oak"]);
}

#[test]
fn a_gap_is_a_fault_that_stops_neither_the_report_nor_the_import() {
    let mut lines: Vec<String> = table(9).lines().map(str::to_owned).collect();
    lines.drain(4000..4040);
    let folder = recorded(&(lines.join("\n") + "\n"), Some(&description()));
    let check = asperity(folder.path(), &["record-check", "oak", "--json"]);
    assert_eq!(check.status.code(), Some(1));
    assert!(
        text(&check.stdout).contains("drop-out"),
        "{}",
        text(&check.stdout)
    );
    let arguments = [
        "import",
        "recording",
        "oak",
        "-o",
        "oak.asp",
        "--no-preview",
    ];
    let import = asperity(folder.path(), &arguments);
    assert!(import.status.success(), "{}", text(&import.stderr));
    assert!(
        text(&import.stderr).contains("gap"),
        "{}",
        text(&import.stderr)
    );
}
