//! `asperity-lab` as a user sees it: outputs, exit status, errors, and no files left behind.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn lab(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the command runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("the folder")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

#[test]
fn feel_without_a_file_writes_everything_and_says_what_is_synthetic() {
    let folder = tempfile::tempdir().expect("a folder");
    let all = [
        "feel", "--csv", "f.csv", "--plot", "f.png", "--wav", "f.wav",
    ];
    let output = lab(folder.path(), &all);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = text(&output.stdout);
    for part in [
        "taps       4 scripted, 4 rendered",
        "strokes    4",
        "caveats",
        "unconfirmed",
    ] {
        assert!(summary.contains(part), "{part} in {summary}");
    }
    assert_eq!(text(&output.stderr), "", "progress only on a terminal");
    assert_eq!(entries(folder.path()), ["f.csv", "f.png", "f.wav"]);
    let begins = |name: &str, magic: &[u8]| {
        fs::read(folder.path().join(name))
            .expect("the output")
            .starts_with(magic)
    };
    assert!(begins("f.csv", b"tick,t_s,motion,"));
    assert!(begins("f.png", b"\x89PNG"));
    assert!(begins("f.wav", b"RIFF"));
}

#[test]
fn a_file_is_felt_as_the_built_in_texture_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let lowered = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
        .expect("built in");
    fs::write(folder.path().join("grit.asp"), lowered.bytes).expect("the file");
    let options = ["--seconds", "3", "--grip", "firm", "--seed", "9", "--quiet"];
    let built_in = lab(folder.path(), &[&["feel"], &options[..]].concat());
    let file = lab(
        folder.path(),
        &[&["feel", "grit.asp"], &options[..]].concat(),
    );
    assert!(file.status.success(), "{}", text(&file.stderr));
    assert_eq!(
        text(&file.stdout).replace("(grit.asp)", "(built in)"),
        text(&built_in.stdout)
    );
}

#[test]
fn a_device_and_a_grip_of_ones_own_are_used() {
    let folder = tempfile::tempdir().expect("a folder");
    let touch = include_str!("../../device-sim/devices/touch.toml");
    let mine = touch
        .replace("3D Systems Touch\"", "My Touch\"")
        .replace("transport_delay_ticks = 0", "transport_delay_ticks = 2");
    fs::write(folder.path().join("mine.toml"), mine).expect("the file");
    let grip = include_str!("../../device-sim/grips/firm.toml").replace("\"firm\"", "\"iron\"");
    fs::write(folder.path().join("iron.toml"), grip).expect("the file");
    let arguments = [
        "feel",
        "--device",
        "mine.toml",
        "--grip",
        "iron.toml",
        "--seconds",
        "2",
    ];
    let output = lab(folder.path(), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = text(&output.stdout);
    for part in [
        "My Touch (simulated)",
        "2 ticks of transport delay",
        "iron grip",
        "2.000 s",
    ] {
        assert!(summary.contains(part), "{part} in {summary}");
    }
}

#[test]
fn a_comparison_with_no_measured_material_is_refused_and_writes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = lab(folder.path(), &["measured", "--hatt", ".", "-o", "tables"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("help:"));
    assert_eq!(entries(folder.path()), [""; 0]);
}

#[test]
fn usage_errors_exit_with_2() {
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in [
        &["feel", "--seconds", "0"][..],
        &["feel", "--seconds", "nan"],
        &["feel", "--texture", "Cork"],
        &["feel", "--seed", "-1"],
        &["feel", "--loud"],
        &["shake"],
        &[],
    ] {
        let output = lab(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    let help = lab(folder.path(), &["feel", "--help"]);
    assert!(help.status.success() && text(&help.stdout).contains("Examples:"));
}

#[test]
fn failures_exit_with_1_name_the_culprit_and_leave_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        fs::write(folder.path().join(name), bytes).expect("the file");
    };
    let asset = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
        .expect("built in")
        .bytes;
    write("good.asp", &asset);
    write("cut.asp", &asset[..asset.len() / 2]);
    write("text.asp", b"not a texture");
    let touch = include_str!("../../device-sim/devices/touch.toml");
    write(
        "heavy.toml",
        touch.replace("0.045, 0.045", "0.045, 450.0").as_bytes(),
    );
    write("typo.toml", touch.replace("dac_bits", "dac_bit").as_bytes());
    write("fast.toml", touch.replace("1000.0", "1500.0").as_bytes());
    let before = entries(folder.path());
    for (arguments, culprits) in [
        (
            &["feel", "none.asp", "--csv", "o.csv"][..],
            &["none.asp"][..],
        ),
        (&["feel", "cut.asp", "--csv", "o.csv"], &["cut.asp"]),
        (&["feel", "text.asp"], &["text.asp"]),
        (
            &["feel", "good.asp", "--texture", "Cork"],
            &["good.asp", "Cork"],
        ),
        (&["feel", "."], &["."]),
        (&["feel", "--device", "none.toml"], &["none.toml"]),
        (
            &["feel", "--device", "heavy.toml"],
            &["heavy.toml", "mechanics.mass_kg[1]", "450"],
        ),
        (
            &["feel", "--device", "typo.toml"],
            &["typo.toml:", "dac_bit"],
        ),
        (
            &["feel", "--device", "fast.toml", "--csv", "o.csv"],
            &["1500", "1000"],
        ),
        (&["feel", "--grip", "limp"], &["limp"]),
        (
            &["feel", "--wav", "no/o.wav", "--csv", "o.csv"],
            &["no/o.wav"],
        ),
        (&["feel", "--plot", "."], &["."]),
        (&["stability", "--hatt", "none"], &["none"]),
    ] {
        let output = lab(folder.path(), arguments);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {error}");
        assert!(
            error.starts_with("error: ") && error.contains("\n  help: "),
            "{error}"
        );
        assert!(
            culprits.iter().all(|culprit| error.contains(culprit)),
            "{arguments:?}: {error}"
        );
        assert_eq!(text(&output.stdout), "", "{arguments:?}");
        assert_eq!(entries(folder.path()), before, "{arguments:?}");
    }
    assert_eq!(
        fs::read(folder.path().join("good.asp")).expect("the file"),
        asset
    );
}

#[test]
fn an_output_that_is_an_input_or_another_output_is_wrong_usage() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, bytes: &[u8]| {
        fs::write(folder.path().join(name), bytes).expect("the file");
    };
    let asset = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
        .expect("built in")
        .bytes;
    write("good.asp", &asset);
    write(
        "touch.toml",
        include_bytes!("../../device-sim/devices/touch.toml"),
    );
    write(
        "firm.toml",
        include_bytes!("../../device-sim/grips/firm.toml"),
    );
    fs::hard_link(folder.path().join("good.asp"), folder.path().join("hard")).expect("a link");
    let content = || -> Vec<Vec<u8>> {
        let names = entries(folder.path()).into_iter();
        names
            .map(|name| fs::read(folder.path().join(name)).expect("readable"))
            .collect()
    };
    let before = (entries(folder.path()), content());
    for (arguments, culprits) in [
        (
            &["feel", "--plot", "o", "--wav", "o"][..],
            &["o", "another output"][..],
        ),
        (
            &["feel", "good.asp", "--wav", "./good.asp"],
            &["good.asp", "an input"],
        ),
        (
            &["feel", "good.asp", "--csv", "hard"],
            &["hard", "an input"],
        ),
        (
            &["feel", "--device", "touch.toml", "--csv", "touch.toml"],
            &["touch.toml", "an input"],
        ),
        (
            &["feel", "--grip", "firm.toml", "--plot", "firm.toml"],
            &["firm.toml", "an input"],
        ),
        (&["feel", "--csv", "-", "--wav", "-"], &["standard output"]),
    ] {
        let output = lab(folder.path(), arguments);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(
            error.starts_with("error: ") && error.contains("\n  help: "),
            "{error}"
        );
        assert!(
            culprits.iter().all(|culprit| error.contains(culprit)),
            "{arguments:?}: {error}"
        );
        assert_eq!(text(&output.stdout), "", "{arguments:?}");
        assert!(
            (entries(folder.path()), content()) == before,
            "{arguments:?}"
        );
    }
}

#[test]
fn one_output_is_piped_and_the_summary_goes_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    for (option, magic) in [
        ("--csv", &b"tick,t_s,motion,"[..]),
        ("--plot", b"\x89PNG"),
        ("--wav", b"RIFF"),
    ] {
        let feel = ["feel", "--seconds", "1", option];
        let file = lab(folder.path(), &[&feel[..], &["out"]].concat());
        let piped = lab(folder.path(), &[&feel[..], &["-"]].concat());
        assert!(piped.status.success(), "{}", text(&piped.stderr));
        assert!(piped.stdout.starts_with(magic));
        assert!(piped.stdout == fs::read(folder.path().join("out")).expect("the output"));
        let told = text(&file.stdout).replace(" out,", " standard output,");
        assert_eq!(
            text(&piped.stderr).replace(" standard output\n", " out\n"),
            told.replace(" standard output\n", " out\n")
        );
    }
}

#[test]
fn a_toml_file_of_megabytes_and_escapes_gives_a_short_plain_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let long = format!("{} = \"\u{9b}31m\"", "k".repeat(1_000_000));
    fs::write(folder.path().join("hostile.toml"), long).expect("the file");
    for option in ["--device", "--grip"] {
        let output = lab(folder.path(), &["feel", option, "hostile.toml"]);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains("hostile.toml:1:1: unknown field"), "{error}");
        assert!(error.len() < 2000, "{} bytes", error.len());
        assert!(!error.contains(|c: char| c != '\n' && c.is_control()));
    }
}

#[test]
fn every_command_takes_quiet() {
    let folder = tempfile::tempdir().expect("a folder");
    for command in [&[][..], &["feel"], &["stability"], &["pareto"], &["record"]] {
        let help = lab(folder.path(), &[command, &["--help"]].concat());
        assert!(text(&help.stdout).contains("--quiet"), "{command:?}");
    }
}

#[test]
fn a_quiet_command_that_writes_files_prints_nothing_and_another_its_result() {
    let folder = tempfile::tempdir().expect("a folder");
    for (command, prints) in [
        ("feel --seconds 1 --csv felt.csv --wav felt.wav", false),
        ("feel --seconds 1", true),
        (
            "jitter --seconds 1 --policy other --no-lock --deep-idle --out run",
            false,
        ),
        ("device calibrate -o profile.toml", false),
        ("device serve --firmware-file virtual.bin", false),
    ] {
        let arguments: Vec<&str> = command.split(' ').chain(["--quiet"]).collect();
        let output = lab(folder.path(), &arguments);
        let error = text(&output.stderr);
        assert!(output.status.success(), "{command}: {error}");
        assert_eq!(!output.stdout.is_empty(), prints, "{command}");
        assert_eq!(error, "", "{command}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure_and_the_other_outputs_do_not_appear() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = [
        "feel",
        "--seconds",
        "1",
        "--csv",
        "o.csv",
        "--wav",
        "/dev/full",
    ];
    let output = lab(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        text(&output.stderr).contains("/dev/full"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(entries(folder.path()), [""; 0]);
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_leaves_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = [
        "feel",
        "--seconds",
        "300",
        "--csv",
        "o.csv",
        "--plot",
        "o.png",
    ];
    let mut child = Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
        .args(arguments)
        .current_dir(folder.path())
        .spawn()
        .expect("the command runs");
    // The temporary outputs appear before the work begins.
    while entries(folder.path()).is_empty() {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let killed = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(killed.expect("kill runs").success());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert_eq!(entries(folder.path()), [""; 0]);
}

#[test]
fn feel_gives_its_summary_as_json_and_every_output_is_spelled_alike() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = ["feel", "--csv", "f.csv", "--json", "-q"];
    let output = lab(folder.path(), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let rows = fs::read_to_string(folder.path().join("f.csv")).expect("a table");
    assert_eq!(json["ticks"], rows.lines().count() - 1);
    assert_eq!(json["taps"]["scripted"].as_array().map(Vec::len), Some(4));
    assert_eq!(json["strokes"].as_array().map(Vec::len), Some(4));
    assert!(json["caveats"].as_array().is_some_and(|c| !c.is_empty()));
    // Older spellings are taken, and not shown.
    for (command, old) in [
        (&["stability"][..], "--out "),
        (&["pareto"], "--out "),
        (&["jitter"], "--out "),
        (&["servo"], "--record"),
        (&["bench"], "--write"),
        (&["device", "probe"], "--report"),
    ] {
        let help = lab(folder.path(), &[command, &["--help"]].concat());
        let help = text(&help.stdout);
        assert!(help.contains("-o, --output"), "{command:?}");
        assert!(!help.contains(old), "{command:?}: {help}");
    }
}
