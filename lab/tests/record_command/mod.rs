//! `asperity-lab record` as a user calls it: what is kept, what is refused, and that nothing
//! half-written is left. Nothing here depends on how punctual the machine is.

#[cfg(unix)]
mod sensors;

use asperity_recording::reader::{self, Recording};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Without what only some machines grant.
const PLAIN: [&str; 4] = ["--policy", "other", "--no-lock", "--deep-idle"];

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity-lab"));
    command.current_dir(folder).stdin(Stdio::null());
    // No library of a vendor that this machine may have.
    command
        .env_remove("ASPERITY_OPENHAPTICS")
        .env_remove("ASPERITY_DHD");
    command.arg("record").args(arguments).args(PLAIN);
    command
}

fn record(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = command(folder, arguments);
    command.output().expect("the command starts")
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn told(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {}", errors(output)))
}

/// A recording that an import reads, with nothing else beside its three files.
fn kept(folder: &Path) -> Recording {
    let entries = fs::read_dir(folder).expect("the folder");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    names.sort();
    assert_eq!(names, ["accel.csv", "recording.toml", "touch.csv"]);
    reader::load(folder).expect("a recording")
}

fn refused(folder: &Path, arguments: &[&str], code: i32, part: &str) {
    let output = record(folder, arguments);
    let error = errors(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {error}");
    assert!(
        error.contains(part) && error.contains("help:"),
        "{part} in {error}"
    );
    assert!(!folder.join("oak").exists(), "{arguments:?} leaves nothing");
}

#[test]
fn a_simulated_session_is_kept_and_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = [
        "oak",
        "--device",
        "sim:?grip=firm&hand=record&time=stepped",
        "--accel",
        "sim:?seed=4",
        "--seconds",
        "6",
        "--name",
        "Oak, \"planed\"",
        "--tool-mass",
        "0.05",
        "--json",
    ];
    let output = record(folder.path(), &arguments);
    assert!(output.status.success(), "{}", errors(&output));
    let told = told(&output);
    assert_eq!(told["end"], "time is over");
    assert_eq!(
        (&told["cells"], &told["bad_lines"]),
        (&12.into(), &0.into())
    );
    let recording = kept(&folder.path().join("oak"));
    assert_eq!(recording.description.name, "Oak, \"planed\"");
    let labels: Vec<&str> = recording
        .channels
        .iter()
        .map(|c| c.label.as_str())
        .collect();
    assert_eq!(
        labels[..4],
        ["position x", "position y", "position z", "force x"]
    );
    assert_eq!(
        labels[6..],
        ["acceleration x", "acceleration y", "acceleration z"]
    );

    // The folder is there now, and stays as it is.
    let again = record(folder.path(), &arguments);
    assert_eq!(again.status.code(), Some(1));
    assert!(
        errors(&again).contains("oak: cannot create the folder"),
        "{}",
        errors(&again)
    );
    kept(&folder.path().join("oak"));
}

/// Claim: a disk that is full costs the recording, which is said beside what was measured.
#[cfg(unix)]
#[test]
fn a_session_that_cannot_be_written_is_told_all_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let script = "ulimit -f 16; exec \"$0\" record \"$@\"";
    let output = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_asperity-lab"), "oak"])
        .args(["--device", "sim:?grip=firm&hand=record&time=stepped"])
        .args(["--accel", "sim:", "--seconds", "6", "--json"])
        .args(PLAIN)
        .current_dir(folder.path())
        .output()
        .expect("sh runs");
    assert_eq!(output.status.code(), Some(1), "{}", errors(&output));
    assert!(
        errors(&output).contains("was not kept"),
        "{}",
        errors(&output)
    );
    let told = told(&output);
    assert_eq!(
        (&told["folder"], &told["end"]),
        (&Value::Null, &"time is over".into())
    );
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

#[test]
fn a_recorded_session_of_the_servo_loop_is_a_device_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut servo = Command::new(env!("CARGO_BIN_EXE_asperity-lab"));
    let arguments = [
        "servo",
        "--device",
        "sim:?time=stepped",
        "--seconds",
        "4",
        "--record",
        "s.aspr",
    ];
    let status = servo
        .current_dir(folder.path())
        .args(arguments)
        .args(PLAIN)
        .output();
    assert!(status.expect("the command starts").status.success());
    let arguments = [
        "oak",
        "--device",
        "replay:s.aspr",
        "--accel",
        "sim:",
        "--json",
    ];
    let output = record(folder.path(), &arguments);
    assert!(output.status.success(), "{}", errors(&output));
    let seconds = told(&output)["seconds"].as_f64().expect("a number");
    // A busy machine misses periods, which lengthens the session.
    assert!(
        seconds > 2.0,
        "{seconds} s of 4, less what the sensor looks ahead"
    );
    kept(&folder.path().join("oak"));
}

#[test]
fn what_cannot_be_recorded_is_refused_and_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.txt"), "1,2,3\n").expect("a file");
    fs::write(folder.path().join("a.wav"), "1,2,3\n").expect("a file");
    let path = folder.path();
    let with = |device, accel| ["oak", "--device", device, "--accel", accel];
    let sim = with("sim:", "sim:");
    for (more, part) in [
        (["--speeds", "20"], "speeds"),
        (["--speeds", "40,20"], "do not ascend"),
        (["--forces", "0,1"], "forces"),
        (["--cell-seconds", "nan"], "0.1 to 60"),
        (["--tool-mass", "0"], "above 0"),
        (["--seconds", "0"], "0.1 to 86400"),
    ] {
        let output = record(path, &[&sim[..], &more].concat());
        let error = errors(&output);
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(part), "{part} in {error}");
    }
    for (accel, part) in [
        ("usb:", "known kinds are"),
        ("wav:a.wav", "g is missing"),
        ("serial:x?columns=speed", "`speed`"),
    ] {
        let output = record(path, &with("sim:", accel));
        assert_eq!(output.status.code(), Some(2));
        assert!(errors(&output).contains(part), "{}", errors(&output));
    }
    refused(path, &with("null:", "sim:"), 2, "simulated device");
    refused(path, &with("sim:", "wav:a.wav?g=16"), 1, "none of a WAV");
    refused(path, &with("touch:", "wav:a.wav?g=16"), 1, "none of a WAV");
    refused(
        path,
        &["missing/oak", "--device", "sim:", "--accel", "sim:"],
        1,
        "missing",
    );
    refused(path, &[&sim[..], &["none.asp"]].concat(), 1, "none.asp");
    refused(
        path,
        &["oak", "--device", "replay:none.aspr", "--accel", "sim:"],
        1,
        "none.aspr",
    );
    assert_eq!(fs::read_dir(path).expect("the folder").count(), 2);
}
