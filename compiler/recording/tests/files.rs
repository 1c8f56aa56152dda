//! Bad files are refused with the file and the line; what can be mended is mended and told.

use asperity_io::diagnostic::Diagnostic;
use asperity_recording::{
    check::{self, FindingKind, Severity},
    description::propose,
    reader,
};
use std::{fmt::Write as _, fs, path::Path};

const HEAD: &str = "name = \"oak\"\n[tool]\nmass_kg = 0.05\n";

/// A CSV with acceleration, force and position at 1 kHz, `seconds` long: strokes of a hand that presses with 1 N, and
/// noise on every sensor.
fn table(seconds: usize, edit: impl Fn(usize, &mut Vec<String>)) -> String {
    let mut state = 7_u64;
    let mut noise = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let mut text = String::from("t,ax,ay,az,fx,fy,fz,x,y,z\n");
    for n in 0..1000 * seconds {
        let t = n as f64 / 1000.0;
        let omega = std::f64::consts::TAU * 0.7;
        let (x, v) = (0.03 * (omega * t).sin(), 0.03 * omega * (omega * t).cos());
        let touching = t > 1.0;
        let load = if touching { 1.0 } else { 0.0 };
        let vibration = load * noise();
        let a = -0.03 * omega * omega * (omega * t).sin();
        let values = [
            a + vibration + 0.02 * noise(),
            0.02 * noise(),
            9.81 + 0.02 * noise(),
            -0.4 * load * v.signum() + 0.05 * vibration + 0.002 * noise(),
            0.002 * noise(),
            load + 0.002 * noise(),
            1e3 * x,
            0.0,
            if touching { -2.0 } else { 10.0 },
        ];
        let mut row: Vec<String> = std::iter::once(format!("{t:.4}"))
            .chain(values.iter().map(|v| format!("{v:.6}")))
            .collect();
        edit(n, &mut row);
        if !row.is_empty() {
            let _ = writeln!(text, "{}", row.join(","));
        }
    }
    text
}

fn description() -> String {
    let mut text = format!("{HEAD}[[file]]\npath = \"all.csv\"\nclock = \"t\"\n");
    let channels = [
        ("a", "acceleration", "m/s^2"),
        ("f", "force", "N"),
        ("", "position", "mm"),
    ];
    for (prefix, quantity, unit) in channels {
        for axis in ["x", "y", "z"] {
            let _ = writeln!(
                text,
                "[[file.channel]]\ncolumn = \"{prefix}{axis}\"\nquantity = \"{quantity}\"\naxis = \"{axis}\"\nunit = \"{unit}\""
            );
        }
    }
    text
}

fn folder(table: &str, description: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("all.csv"), table).expect("written");
    fs::write(folder.path().join("recording.toml"), description).expect("written");
    folder
}

fn refused(folder: &Path) -> (String, String) {
    let error = reader::load(folder)
        .and_then(|recording| check::check(&recording))
        .expect_err("refused");
    (error.to_string(), error.remedy())
}

#[test]
fn a_folder_without_description_gets_a_proposal() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("all.csv"), table(1, |_, _| {})).expect("written");
    let error = reader::load(folder.path()).expect_err("refused");
    assert!(error.to_string().ends_with("has no recording.toml"));
    let proposal = propose(folder.path())
        .expect("readable files")
        .expect("a proposal");
    assert!(
        proposal.text.contains("column = \"az\"") && proposal.text.contains("clock = \"t\""),
        "{proposal:?}"
    );
    // The proposal is a description as it stands.
    fs::write(folder.path().join("recording.toml"), &proposal.text).expect("written");
    reader::load(folder.path()).expect("a recording");
}

#[test]
fn a_value_that_is_no_number_is_named_with_line_and_column() {
    let bad = table(3, |n, row| {
        if n == 41 {
            row[3] = "9,81x".replace(',', ".")
        }
    });
    let (what, _) = refused(folder(&bad, &description()).path());
    assert!(
        what.contains("all.csv:43: column \"az\" holds \"9.81x\""),
        "{what}"
    );
}

#[test]
fn a_clock_that_contradicts_the_rate_or_itself_is_refused() {
    let rate = description().replace("clock = \"t\"", "clock = \"t\"\nrate_hz = 2000");
    let (what, remedy) = refused(folder(&table(3, |_, _| {}), &rate).path());
    assert!(
        what.contains("recording.toml:4: rate_hz says 2000 Hz, the clock says 1000"),
        "{what}"
    );
    assert!(remedy.contains("clock_unit"), "{remedy}");
    let backwards = table(3, |n, row| {
        if n == 100 {
            row[0] = "0.05".into()
        }
    });
    let (what, _) = refused(folder(&backwards, &description()).path());
    assert!(
        what.contains("all.csv:102: the clock goes from 0.099 s to 0.05 s"),
        "{what}"
    );
    let gap = table(8, |n, row| {
        if (3000..5000).contains(&n) {
            row.clear()
        }
    });
    let (what, remedy) = refused(folder(&gap, &description()).path());
    assert!(
        what.contains("all.csv:3002: the clock jumps by 2.001 s") && remedy.contains("split"),
        "{what} {remedy}"
    );
}

#[test]
fn unknown_columns_and_absent_quantities_are_named() {
    let other = description().replace("\"fz\"", "\"force\"");
    let (what, _) = refused(folder(&table(3, |_, _| {}), &other).path());
    assert!(what.contains("no column \"force\"; it has t, ax"), "{what}");
    let without: String = format!(
        "{HEAD}[[file]]\npath = \"all.csv\"\nclock = \"t\"\n[[file.channel]]\ncolumn = \"ax\"\nquantity = \"acceleration\"\nunit = \"g\"\n"
    );
    let (what, _) = refused(folder(&table(3, |_, _| {}), &without).path());
    assert!(what.contains("no force along the normal"), "{what}");
}

#[test]
fn one_second_is_too_little() {
    let (what, remedy) = refused(folder(&table(1, |_, _| {}), &description()).path());
    assert!(what.contains("cover 1.00 s"), "{what}");
    assert!(remedy.contains("stroke for a minute"), "{remedy}");
}

#[test]
fn missing_values_and_short_gaps_are_bridged_and_told() {
    let holes = table(8, |n, row| {
        if (2000..2020).contains(&n) {
            row[1] = "NaN".into();
        }
        if (4000..4040).contains(&n) {
            row.clear();
        }
    });
    let folder = folder(&holes, &description());
    let recording = reader::load(folder.path()).expect("read");
    let (checked, timeline) = check::check(&recording).expect("checked");
    let drop_outs: Vec<String> = checked
        .at_least(Severity::Fault)
        .filter(|f| f.kind == FindingKind::DropOut)
        .map(ToString::to_string)
        .collect();
    assert!(
        drop_outs
            .iter()
            .any(|f| f.contains("20 values are missing, the first in line 2002")),
        "{drop_outs:?}"
    );
    assert!(
        drop_outs.iter().any(|f| f.contains("1 gaps")),
        "{drop_outs:?}"
    );
    assert!(!timeline.good[2010] && !timeline.good[4020] && timeline.good[3000]);
    assert_eq!(timeline.len(), 7999);
}

#[test]
fn what_was_stroked_is_what_the_timeline_says() {
    let folder = folder(&table(8, |_, _| {}), &description());
    let recording = reader::load(folder.path()).expect("read");
    let (checked, timeline) = check::check(&recording).expect("checked");
    assert!(checked.worst() <= Severity::Note, "{checked}");
    let fastest = timeline.speed_mm_s.iter().copied().fold(0.0, f64::max);
    let expected = 30.0 * std::f64::consts::TAU * 0.7;
    assert!((fastest / expected - 1.0).abs() < 0.02, "{fastest}");
    assert!(
        (timeline.load_n[4000] - 1.0).abs() < 0.01
            && !timeline.contact[500]
            && timeline.contact[4000]
    );
    let drag = timeline.drag_n.expect("recorded");
    // In the middle of a stroke.
    assert!((drag[5715] - 0.4).abs() < 0.03, "{}", drag[5715]);
}
