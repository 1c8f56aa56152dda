//! Recordings of other loggers.

use super::{Case, Check, findings};
use std::{fs, path::Path};

pub(super) const CHECKS: &[(&str, Check)] = &[
    ("accel-full-scale", gravity_tells_a_wrong_range),
    ("force-units", weights_are_forces),
    (
        "header-behind-preamble",
        tables_are_found_behind_what_stands_before,
    ),
    ("other-recording-formats", other_formats_are_named),
    ("phone-log-folder", one_acceleration_of_a_phone_is_proposed),
    ("plotter-labels", labelled_values_are_read),
    ("text-time-stamps", times_as_text_are_a_clock),
    ("topic-paths", the_end_of_a_path_says_what_it_is),
    ("whitespace-columns", blanks_separate_columns),
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

fn gravity_tells_a_wrong_range(case: &Case) {
    for (folder, factor) in [("x2", "2.00"), ("x0.67", "1.49"), ("x160", "160.")] {
        let report = case.checked(Path::new(&case.file(folder)));
        let faults = findings(&report, "fault");
        let told = |[_, channel, kind, what]: &[String; 4]| {
            channel == "acceleration" && kind == "unit" && what.contains(factor)
        };
        assert!(faults.iter().any(told), "{folder}: {faults:?}");
    }
}

/// Each line of a proposal is there.
fn proposes(case: &Case, folder: &str, lines: &[&str]) {
    let proposal = case.proposed(folder);
    for line in lines {
        assert!(
            proposal.lines().any(|one| one.starts_with(line)),
            "{folder}: {line}: {proposal}"
        );
    }
}

fn weights_are_forces(case: &Case) {
    for (folder, column, unit) in [
        ("fz_kg", "Fz (kg)", "kgf"),
        ("force_g", "Force (g)", "gf"),
        ("load_kg", "Load (kg)", "kgf"),
        ("suffix", "fz_g", "gf"),
        ("lbf", "Fz (lbf)", "lbf"),
    ] {
        let proposal = case.proposed(folder);
        let channel = proposal
            .split("[[file.channel]]")
            .find(|part| part.contains(&format!("column = \"{column}\"")));
        let channel = channel.unwrap_or_else(|| panic!("{folder}: {proposal}"));
        assert!(
            channel.contains("quantity = \"force\"")
                && channel.contains(&format!("unit = \"{unit}\"")),
            "{folder}: {channel}"
        );
    }
}

fn tables_are_found_behind_what_stands_before(case: &Case) {
    proposes(case, "lvm", &["column = \"ax (g)\"", "clock = \"X_Value\""]);
    proposes(
        case,
        "dewesoft",
        &["clock = \"Time (s)\"", "column = \"AI 1/acc x (m/s2)\""],
    );
    proposes(
        case,
        "optitrack",
        &[
            "clock = \"Time (Seconds)\"",
            "column = \"X\"",
            "quantity = \"position\"",
        ],
    );
    // What is proposed is read: the take is too short, and not in doubt otherwise.
    for folder in ["dewesoft", "lvm", "optitrack"] {
        let copy = case.copied(folder);
        let run = case.asperity(&["record-check", folder, "--init"]);
        assert_eq!(run.code, Some(0), "{folder}: {}", run.stderr);
        let run = case.asperity(&["record-check", folder]);
        assert!(
            run.stderr.contains("cover 0.20 s"),
            "{folder}: {}",
            run.stderr
        );
        assert!(copy.join("recording.toml").exists());
    }
}

fn other_formats_are_named(case: &Case) {
    for (folder, file, remedy) in [
        ("mat", "log.mat", "CSV"),
        ("tdms", "log.tdms", "CSV"),
        ("xlsx", "log.xlsx", "CSV"),
        ("npz", "log.npz", "CSV"),
        ("h5", "log.h5", "CSV"),
        ("parquet", "log.parquet", "CSV"),
        ("gz", "log.csv.gz", "unpack"),
    ] {
        case.refused(&["record-check", &case.file(folder)], &[file, remedy]);
        case.copied(folder);
        let run = case.asperity(&["record-check", folder, "--init"]);
        assert_eq!(run.code, Some(1), "{folder}");
        assert!(run.stderr.contains(file), "{folder}: {}", run.stderr);
        let draft = case.scratch.path().join(folder).join("recording.toml");
        assert!(!draft.exists(), "{folder}: a draft without a file");
        fs::remove_dir_all(case.scratch.path().join(folder)).expect("removed");
    }
}

fn one_acceleration_of_a_phone_is_proposed(case: &Case) {
    case.copied("sensorlogger");
    let run = case.asperity(&["record-check", "sensorlogger", "--init"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let draft = case.scratch.path().join("sensorlogger/recording.toml");
    let draft = fs::read_to_string(draft).expect("a draft");
    assert!(
        draft.contains("path = \"TotalAcceleration.csv\""),
        "{draft}"
    );
    assert_eq!(
        draft.matches("quantity = \"acceleration\"").count(),
        3,
        "{draft}"
    );
    assert!(!draft.contains("\"speed\""), "{draft}");
    let report = case.checked(&case.scratch.path().join("sensorlogger"));
    assert_eq!(findings(&report, "fault"), [[""; 4]; 0]);
    let proposal = case.proposed("gfx");
    for axis in ["x", "y", "z"] {
        let channel = format!(
            "column = \"gF{axis}\"\nquantity = \"acceleration\"\naxis = \"{axis}\"\nunit = \"g\"\n"
        );
        assert!(proposal.contains(&channel), "{axis}: {proposal}");
    }
}

fn labelled_values_are_read(case: &Case) {
    let run = case.asperity(&["record-check", &case.file("")]);
    for line in ["column = \"ax\"", "column = \"ay\"", "column = \"az\""] {
        assert!(run.stdout.contains(line), "{line}: {}", run.stdout);
    }
    assert!(!run.stdout.contains("ax:"), "{}", run.stdout);
}

fn times_as_text_are_a_clock(case: &Case) {
    for (folder, clock) in [
        ("iso8601", "timestamp"),
        ("matlab", "Time"),
        ("time_of_day", "time"),
        ("units_row", "Time"),
    ] {
        proposes(
            case,
            folder,
            &[&format!("clock = \"{clock}\""), "clock_unit = \"s\""],
        );
        case.copied(folder);
        assert_eq!(
            case.asperity(&["record-check", folder, "--init"]).code,
            Some(0)
        );
        // The clock is that of 201 rows at 1 kHz.
        let said = case.asperity(&["record-check", folder]).stderr;
        assert!(said.contains("cover 0.20 s"), "{folder}: {said}");
    }
}

fn the_end_of_a_path_says_what_it_is(case: &Case) {
    let ros = case.proposed("ros");
    for part in [
        "clock = \"%time\"",
        "column = \"field.linear_acceleration.x\"\nquantity = \"acceleration\"\naxis = \"x\"",
        "column = \"field.wrench.force.z\"\nquantity = \"force\"\naxis = \"z\"",
    ] {
        assert!(ros.contains(part), "{part}: {ros}");
    }
    let bag = case.proposed("plotjuggler");
    for part in [
        "clock = \"__time\"",
        "column = \"/imu/linear_acceleration/x\"\nquantity = \"acceleration\"\naxis = \"x\"",
        "column = \"/ft/wrench/force/z\"\nquantity = \"force\"\naxis = \"z\"",
        "column = \"/tip/pose/position/x\"\nquantity = \"position\"\naxis = \"x\"",
    ] {
        assert!(bag.contains(part), "{part}: {bag}");
    }
}

fn blanks_separate_columns(case: &Case) {
    for folder in ["header", "hash"] {
        proposes(
            case,
            folder,
            &["clock = \"t_s\"", "column = \"ax\"", "column = \"az\""],
        );
    }
    let none = case.proposed("none");
    assert!(none.contains("spaces separate"), "{none}");
    assert!(!none.contains("-0.031"), "{none}");
}
