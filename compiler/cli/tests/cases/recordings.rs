//! Recordings of other loggers.

use super::{Case, Check, findings};
use std::{fs, path::Path};

pub(super) const CHECKS: &[(&str, Check)] = &[
    ("clock-coarse", shared_stamps_are_a_clock_that_moves),
    ("csv-dialects", dialects_are_read_like_the_plain_one),
    ("dead-channel", one_value_throughout_is_a_fault_by_its_name),
    ("proposal-halves-time", a_proposal_keeps_the_clock),
    ("proposal-units", a_proposal_takes_units_from_the_header),
    ("wav-float64", wavs_of_64_bit_floats_are_read),
];

fn shared_stamps_are_a_clock_that_moves(case: &Case) {
    for folder in ["packets", "two_decimals"] {
        let report = case.checked(Path::new(&case.file(folder)));
        assert_eq!(findings(&report, "fault"), [[""; 4]; 0], "{folder}");
        let seconds = report["duration_s"].as_f64().expect("a duration");
        assert!((seconds - 6.0).abs() < 0.05, "{folder}: {seconds} s");
    }
}

fn dialects_are_read_like_the_plain_one(case: &Case) {
    let plain = case.checked(Path::new(&case.file("plain")));
    for dialect in ["label", "comment", "hash_header"] {
        assert_eq!(
            case.checked(Path::new(&case.file(dialect))),
            plain,
            "{dialect}"
        );
    }
    case.refused(
        &["record-check", &case.file("dup")],
        &["log.csv", "\"x\" 2 times"],
    );
}

fn one_value_throughout_is_a_fault_by_its_name(case: &Case) {
    for (folder, file, channels) in [
        (
            "zero",
            "accel.csv",
            &["acceleration x", "acceleration y", "acceleration z"][..],
        ),
        ("force", "force.csv", &["force x", "force z"]),
        ("still", "position.csv", &["position x", "position z"]),
    ] {
        let report = case.checked(Path::new(&case.file(folder)));
        let dead: Vec<[String; 3]> = findings(&report, "fault")
            .into_iter()
            .map(|[file, channel, kind, _]| [file, channel, kind])
            .collect();
        let expected: Vec<[&str; 3]> = channels.iter().map(|one| [file, *one, "dead"]).collect();
        assert_eq!(dead, expected, "{folder}");
    }
}

fn a_proposal_keeps_the_clock(case: &Case) {
    let proposal = case.proposed("folder");
    for line in ["clock = \"Time (s)\"", "unit = \"g\""] {
        assert!(proposal.lines().any(|one| one == line), "{proposal}");
    }
    let folder = case.scratch.path().join("log");
    fs::create_dir(&folder).expect("a folder");
    for (from, to) in [
        ("folder/log.csv", "log.csv"),
        ("fixed.toml", "recording.toml"),
    ] {
        fs::copy(case.file(from), folder.join(to)).expect("a copy");
    }
    let run = case.asperity(&["record-check", "log"]);
    let said = run.stdout + &run.stderr;
    assert_eq!(run.code, Some(1), "{said}");
    assert!(
        said.contains("1000 Hz") && said.contains("factor of 2.0"),
        "{said}"
    );
}

fn a_proposal_takes_units_from_the_header(case: &Case) {
    for (folder, clock, clock_unit, unit) in [
        ("brackets", "time [s]", "s", "g"),
        ("ms", "Time(ms)", "ms", "g"),
        ("parentheses", "Time (s)", "s", "m/s^2"),
        ("suffix", "time_ms", "ms", "mg"),
    ] {
        let proposal = case.proposed(folder);
        for line in [
            format!("clock = \"{clock}\""),
            format!("clock_unit = \"{clock_unit}\""),
            format!("unit = \"{unit}\""),
        ] {
            assert!(
                proposal.lines().any(|one| one == line),
                "{folder}: {line}: {proposal}"
            );
        }
        assert!(
            !proposal.lines().any(|one| one.starts_with("rate_hz")),
            "{folder}: {proposal}"
        );
    }
}

fn wavs_of_64_bit_floats_are_read(case: &Case) {
    let report = case.checked(Path::new(&case.file("folder")));
    assert_eq!(findings(&report, "fault"), [[""; 4]; 0]);
}
