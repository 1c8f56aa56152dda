//! `asperity-lab servo --record` and `--device replay:` as a user calls them, and what every kind of
//! device answers. Nothing here depends on how punctual the machine is.

use asperity_formats::{SceneSurface, Solid, library};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Without what only some machines grant.
const PLAIN: [&str; 5] = ["--policy", "other", "--no-lock", "--deep-idle", "--quiet"];

fn servo(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity-lab"));
    command.current_dir(folder).stdin(Stdio::null());
    // No library of a vendor that this machine may have.
    command
        .env_remove("ASPERITY_OPENHAPTICS")
        .env_remove("ASPERITY_DHD");
    let output = command.arg("servo").args(arguments).args(PLAIN).output();
    output.expect("the command starts")
}

/// Several sessions at once: each lasts as long as its recording.
fn servos<const N: usize>(folder: &Path, sessions: [&[&str]; N]) -> [Output; N] {
    std::thread::scope(|scope| {
        sessions
            .map(|arguments| scope.spawn(move || servo(folder, arguments)))
            .map(|session| session.join().expect("a session"))
    })
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs a session and returns its JSON.
fn ok(folder: &Path, arguments: &[&str]) -> Value {
    json(&servo(folder, &[arguments, &["--json"]].concat()))
}

fn json(output: &Output) -> Value {
    assert!(output.status.success(), "{}", errors(output));
    reported(output)
}

/// Returns the report, whatever the exit status.
fn reported(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn number(value: &Value) -> u64 {
    value.as_u64().expect("a number")
}

#[test]
fn a_recorded_session_is_played_to_the_same_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    // A step a tick, so that the hand strokes after its taps however late the machine is.
    let record = [
        "--device",
        "sim:?grip=firm&time=stepped",
        "--seconds",
        "4.5",
        "--seed",
        "77",
    ];
    let told = ok(
        folder.path(),
        &[&record[..], &["--record", "s.aspr"]].concat(),
    );
    let (ticks, lost) = (number(&told["ticks"]), number(&told["lost_records"]));
    assert_eq!(number(&told["recorded_ticks"]) + lost, ticks);
    let bytes = fs::read(folder.path().join("s.aspr")).expect("a recording");
    assert!(bytes.starts_with(b"ASPR"));

    let mut texture = asperity::sources::builtin::texture();
    texture.friction.mu *= 2.0;
    let other = asperity::emit::lower::lower(&texture, None).expect("a texture");
    fs::write(folder.path().join("other.asp"), other.bytes).expect("a file");
    let replay = ["--device", "replay:s.aspr", "--json"];
    let [same, another_seed, another_texture, looked] = servos(
        folder.path(),
        [
            &replay,
            &[&replay[..], &["--seed", "78"]].concat(),
            &[&["other.asp"], &replay[..]].concat(),
            &[&replay[..], &["--seed", "78", "--look"]].concat(),
        ],
    );
    // Rate, limits, mechanics and seed are those of the recording.
    let told = json(&same);
    assert_eq!(told["end"], "time is over", "it ends with the recording");
    let forces = number(&told["replay"]["forces"]);
    assert!(forces + lost + 8 >= ticks, "{forces} of {ticks}");
    if lost == 0 {
        assert_eq!(number(&told["replay"]["different"]), 0, "of {forces}");
    }
    assert_eq!(told["faults"], 0);

    // The comparison can fail, the user knows beforehand, and only who asked to look exits with 0.
    if lost == 0 {
        assert!(same.status.success(), "{}", errors(&same));
    }
    let said = errors(&another_seed);
    assert_eq!(another_seed.status.code(), Some(1), "{said}");
    assert!(
        said.contains("differ from the recording") && said.contains("--look"),
        "{said}"
    );
    assert!(looked.status.success(), "{}", errors(&looked));
    assert_eq!(json(&looked)["replay"], reported(&another_seed)["replay"]);
    let told = reported(&another_seed);
    assert!(errors(&another_seed).contains("seed 77"));
    assert!(number(&told["replay"]["different"]) > 0, "another seed");
    let said = errors(&another_texture);
    assert!(said.contains("is a different one"), "{said}");
}

/// A library with a scene: the built-in texture on a board, whose top is at this height.
fn scene(top_m: f32) -> Vec<u8> {
    let texture = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None);
    let texture = texture.expect("built in").bytes;
    let board = SceneSurface {
        solid: Solid::Box {
            center_m: [0.0, 0.0, top_m - 0.05],
            half_extents_m: [0.15, 0.15, 0.05],
        },
        from_m: [-0.2; 3],
        to_m: [0.2; 3],
        texture: 0,
    };
    let mut bytes = vec![0; 1 << 20];
    let used = library::encode_scene(&[("grit", &texture)], &[board], &mut bytes);
    bytes.truncate(used.expect("a scene"));
    bytes
}

#[test]
fn a_recorded_scene_is_played_to_the_same_bits_and_another_one_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, top_m) in [("desk.aspl", 0.0), ("other.aspl", 0.003)] {
        fs::write(folder.path().join(name), scene(top_m)).expect("a file");
    }
    let record = ["--device", "sim:?grip=firm&time=stepped", "--seconds", "3"];
    let told = ok(
        folder.path(),
        &[&["desk.aspl"], &record[..], &["--record", "s.aspr"]].concat(),
    );
    let lost = number(&told["lost_records"]);
    let replay = ["--device", "replay:s.aspr", "--json"];
    let [same, other, none] = servos(
        folder.path(),
        [
            &[&["desk.aspl"], &replay[..]].concat(),
            &[&["other.aspl"], &replay[..]].concat(),
            &replay,
        ],
    );
    let told = |output: &Output| {
        let different = &reported(output)["replay"]["different"];
        (number(different), errors(output))
    };
    let (different, said) = told(&same);
    assert!(!said.contains("the recording is of"), "{said}");
    assert!(lost > 0 || different == 0, "{different} forces differ");
    for other in [other, none] {
        let (different, said) = told(&other);
        assert!(
            said.contains("the recording is of a scene of 1 surface (CRC-32 ")
                && said.contains("is a different one"),
            "{said}"
        );
        assert!(different > 0, "the warning is for a reason: {said}");
        assert_eq!(other.status.code(), Some(1), "{said}");
    }
}

#[test]
fn the_name_says_how_to_record_and_nothing_that_is_read_is_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let null = ["--device", "null:", "--seconds", "0.3", "--record"];
    for (name, begins) in [("a.csv", "period,t_s,"), ("a.aspr", "ASPR")] {
        ok(folder.path(), &[&null[..], &[name]].concat());
        let bytes = fs::read(at(name)).expect("a record");
        assert!(bytes.starts_with(begins.as_bytes()), "{name}");
    }
    let before = fs::read(at("a.aspr")).expect("a record");
    for (arguments, status, words) in [
        (&["--device", "null:", "--record", "a.txt"][..], 2, ".aspr"),
        (&["--device", "null:", "--record", "a"], 2, ".csv"),
        (
            &["--device", "null:", "--record", "no/a.csv"],
            1,
            "no/a.csv",
        ),
        (
            &["--device", "replay:a.aspr", "--record", "a.aspr"],
            2,
            "an input",
        ),
        (
            &["--device", "replay:a.aspr", "--rate", "2000"],
            2,
            "1000 Hz",
        ),
        (&["--device", "replay:a.csv"], 1, "ASPR"),
        (&["--device", "replay:none.aspr"], 1, "none.aspr"),
        (&["--device", "replay:a.aspr?end=never"], 1, "leave"),
    ] {
        let output = servo(folder.path(), arguments);
        let told = errors(&output);
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {told}");
        assert!(
            told.contains(words) && told.contains("help:"),
            "{arguments:?}: {told}"
        );
    }
    assert_eq!(fs::read(at("a.aspr")).expect("a record"), before);
    let left = fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(left, 2, "nothing half-written stays");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_and_the_session_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let full = [
        "--device",
        "null:",
        "--seconds",
        "0.3",
        "--record",
        "/dev/full",
    ];
    let output = servo(folder.path(), &full);
    assert_eq!(output.status.code(), Some(1));
    let told = errors(&output);
    assert!(
        told.contains("/dev/full") && told.contains("help:"),
        "{told}"
    );
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(report.contains("the force is zero"), "{report}");
}

/// Every kind of device answers, on a machine that has none of them.
#[test]
fn every_kind_of_device_says_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    for (uri, words) in [
        ("touch:", "openhaptics:"),
        ("openhaptics:?lib=none.so", "none.so"),
        ("dhd:?lib=none.so", "none.so"),
        ("falcon:nobody", "alcon"),
        ("replay:", "replay:FILE"),
        ("sim:none.toml", "none.toml"),
        ("phantom:", "phantom:"),
    ] {
        let output = servo(folder.path(), &["--device", uri, "--seconds", "0.2"]);
        let told = errors(&output);
        let status = output.status.code();
        assert!(matches!(status, Some(1 | 2)), "{uri}: {status:?} {told}");
        assert!(told.contains(words), "{uri}: {told}");
        assert!(!told.contains("panicked"), "{uri}: {told}");
    }
    for uri in ["null:", "sim:", "sim:?time=stepped"] {
        let told = ok(folder.path(), &["--device", uri, "--seconds", "0.2"]);
        assert_eq!(told["ended_without_force"], true, "{uri}");
    }
}
