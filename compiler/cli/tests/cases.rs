//! Files of other people that were read wrongly once: `tests/cases`, a folder a case. Each does what its README
//! says, by the command that a user runs. A folder without a check here fails, and so does a check without a folder.

use serde_json::Value;
use std::{
    collections::BTreeSet,
    fs,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    process::Command,
};

/// What checks a case: its folder, and one to write into.
type Check = fn(&Case);

const CHECKS: [(&str, Check); 16] = [
    (
        "ahap-control-semantics",
        controls_as_core_haptics_plays_them,
    ),
    ("ahap-envelope-ignored", envelopes_are_named),
    ("ahap-lenient", what_is_not_used_refuses_no_ahap),
    ("ahap-trailing-comma", trailing_commas_are_read),
    ("clock-coarse", shared_stamps_are_a_clock_that_moves),
    ("csv-dialects", dialects_are_read_like_the_plain_one),
    ("dead-channel", one_value_throughout_is_a_fault_by_its_name),
    ("effect-refusal-names-no-cause", what_was_left_out_is_named),
    ("lfs-pointer", pointers_of_git_lfs_are_named),
    (
        "manifest-messages",
        lists_are_read_or_refused_by_what_is_wrong,
    ),
    ("prompt-zero-width", what_shows_nothing_changes_no_prompt),
    ("proposal-halves-time", a_proposal_keeps_the_clock),
    ("proposal-units", a_proposal_takes_units_from_the_header),
    ("thread-limit-panic", few_threads_bring_no_command_down),
    ("wav-float64", wavs_of_64_bit_floats_are_read),
    (
        "wrong-format-help",
        other_formats_are_named_with_their_command,
    ),
];

/// The RMS of a continuous event at full intensity, m/s²: 5/√2.
const FULL_M_S2: f64 = 3.5355;

struct Case {
    folder: PathBuf,
    scratch: tempfile::TempDir,
}

/// What a command did.
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Case {
    /// A file of the case.
    fn file(&self, name: &str) -> String {
        let path = self.folder.join(name);
        assert!(path.exists(), "{} is missing", path.display());
        path.to_str().expect("a path in UTF-8").to_owned()
    }

    fn asperity(&self, arguments: &[&str]) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(arguments)
            .current_dir(self.scratch.path())
            .output()
            .expect("the command runs");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Run {
            code: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        }
    }

    /// What importing a file says; it must succeed.
    fn import(&self, kind: &str, name: &str) -> String {
        let file = self.file(name);
        let run = self.asperity(&["import", kind, &file, "-o", "out.asp", "--no-preview"]);
        assert_eq!(run.code, Some(0), "{name}: {}", run.stderr);
        run.stderr
    }

    /// A refusal with exit status 1 that leaves no output and says all of this.
    fn refused(&self, arguments: &[&str], says: &[&str]) {
        let run = self.asperity(arguments);
        assert_eq!(run.code, Some(1), "{arguments:?}: {}", run.stderr);
        for one in says {
            assert!(
                run.stderr.contains(one),
                "{arguments:?}: {one}: {}",
                run.stderr
            );
        }
        let left = fs::read_dir(self.scratch.path())
            .expect("the folder")
            .count();
        assert_eq!(left, 0, "{arguments:?} left something behind");
    }

    /// The report of `record-check --json` on a folder.
    fn checked(&self, folder: &Path) -> Value {
        let run = self.asperity(&["record-check", folder.to_str().expect("UTF-8"), "--json"]);
        serde_json::from_str(&run.stdout)
            .unwrap_or_else(|error| panic!("{}: {error}: {}", folder.display(), run.stderr))
    }

    /// The proposal for a folder without recording.toml.
    fn proposed(&self, folder: &str) -> String {
        let run = self.asperity(&["record-check", &self.file(folder)]);
        assert_eq!(run.code, Some(1), "{folder}: {}", run.stderr);
        assert!(run.stdout.contains("[[file]]"), "{folder}: {}", run.stdout);
        run.stdout
    }

    /// Power of the imported texture's stroke at 100 mm/s and 1 N, (m/s²)² a bin, and a bin's width in Hz. It is
    /// computed from the line spectral frequencies that `inspect --json` prints.
    fn stroke_power(&self) -> (Vec<f64>, f64) {
        let json: Value =
            serde_json::from_str(&self.asperity(&["inspect", "out.asp", "--json"]).stdout)
                .expect("JSON");
        let ar = &json["ar"];
        let vertices = ar["vertices"].as_array().expect("vertices");
        let number = |value: &Value| value.as_f64().expect("a number");
        let stroke = vertices
            .iter()
            .find(|v| v["speed_mm_s"] == 100.0 && v["force_n"] == 1.0)
            .expect("the stroke");
        let lsf: Vec<f64> = stroke["lsf_rad"]
            .as_array()
            .expect("LSFs")
            .iter()
            .map(number)
            .collect();
        let level = number(&stroke["sigma_m_s2"]) * stroke["gain"].as_f64().unwrap_or(1.0);
        let bins = 20_000;
        let power = (0..bins).map(|n| {
            let w = std::f64::consts::PI * (f64::from(n) + 0.5) / f64::from(bins);
            // |A|² by the angles of the sum and the difference polynomial.
            let product = |first: usize| -> f64 {
                let own = lsf.iter().skip(first).step_by(2);
                own.map(|l| 2.0 * (w.cos() - l.cos())).product()
            };
            let (sum, difference) = (product(0), product(1));
            let a = if lsf.len().is_multiple_of(2) {
                (sum * (0.5 * w).cos()).powi(2) + (difference * (0.5 * w).sin()).powi(2)
            } else {
                0.25 * (sum.powi(2) + (2.0 * difference * w.sin()).powi(2))
            };
            (2.0 * (0.5 * w).cos() * level).powi(2) / a / f64::from(bins)
        });
        (
            power.collect(),
            0.5 * number(&ar["sample_rate_hz"]) / f64::from(bins),
        )
    }
}

/// Findings of one severity, as file, channel, kind and text.
fn findings(report: &Value, severity: &str) -> Vec<[String; 4]> {
    let all = report["findings"].as_array().expect("findings");
    all.iter()
        .filter(|one| one["severity"] == severity)
        .map(|one| {
            ["file", "channel", "kind", "what"].map(|key| one[key].as_str().expect(key).to_owned())
        })
        .collect()
}

#[test]
fn every_case_does_what_its_readme_says() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/cases");
    let entries = fs::read_dir(&root).unwrap_or_else(|error| panic!("{}: {error}", root.display()));
    let found: BTreeSet<String> = entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    let checked: BTreeSet<String> = CHECKS.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(
        found,
        checked,
        "cases in {}, and those with a check",
        root.display()
    );
    let failed: Vec<&str> = CHECKS
        .iter()
        .filter(|(name, check)| {
            let case = Case {
                folder: root.join(name),
                scratch: tempfile::tempdir().expect("a folder"),
            };
            assert!(case.folder.join("README").exists(), "{name} has no README");
            catch_unwind(AssertUnwindSafe(|| check(&case))).is_err()
        })
        .map(|(name, _)| *name)
        .collect();
    assert!(failed.is_empty(), "{failed:?}: see the panics above");
}

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

fn lists_are_read_or_refused_by_what_is_wrong(case: &Case) {
    for (file, says) in [
        ("table.toml", "write [[texture]]"),
        ("dupkey.jsonl", ":1: \"prompt\" is stated twice"),
    ] {
        case.refused(&["build", &case.file(file), "--check"], &[file, says]);
    }
    let table = case.asperity(&["build", &case.file("table.toml"), "--check"]);
    assert!(!table.stderr.contains("no such key"), "{}", table.stderr);
    for file in ["blank_rows.csv", "semicolon.csv"] {
        // A build leaves its lock beside the list.
        fs::copy(case.file(file), case.scratch.path().join(file)).expect("room for a list");
        let run = case.asperity(&["build", file, "-o", "out.aspl", "--no-preview"]);
        assert_eq!(run.code, Some(0), "{file}: {}", run.stderr);
        let list = case.asperity(&["list", "out.aspl", "--json"]);
        assert!(
            list.stdout.contains("\"oak\"") && list.stdout.contains("\"rough oak\""),
            "{}",
            list.stdout
        );
    }
}

fn what_shows_nothing_changes_no_prompt(case: &Case) {
    let prompt = fs::read_to_string(case.file("prompt.txt")).expect("a prompt");
    let compiled = |prompt: &str| {
        let run = case.asperity(&["compile", prompt, "-o", "p.asp", "--no-preview", "--json"]);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
        (
            json["taken_as"].clone(),
            json["attributes"].clone(),
            run.stderr,
        )
    };
    let (taken_as, attributes, warnings) = compiled(prompt.trim());
    assert_eq!(taken_as, "sandpaper");
    assert_eq!(attributes, compiled("sandpaper").1);
    assert!(!warnings.contains("understood"), "{warnings}");
}

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

/// The proposal says the clock; who states another rate beside it gets the factor.
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

fn wavs_of_64_bit_floats_are_read(case: &Case) {
    let report = case.checked(Path::new(&case.file("folder")));
    assert_eq!(findings(&report, "fault"), [[""; 4]; 0]);
}

/// Says that it is skipped where the script cannot set limits: it becomes another user, as only root may.
fn few_threads_bring_no_command_down(case: &Case) {
    let limited = "su nobody -s /bin/bash -c 'ulimit -u 20'";
    let can = Command::new("bash").args(["-c", limited]).output();
    if !can.is_ok_and(|output| output.status.success()) {
        println!(
            "thread-limit-panic: skipped: limits of processes cannot be set here (needs root, su, user nobody)"
        );
        return;
    }
    let output = Command::new("bash")
        .arg(case.file("run.sh"))
        .arg(env!("CARGO_BIN_EXE_asperity"))
        .output()
        .expect("bash runs");
    let said = String::from_utf8_lossy(&output.stdout);
    let text = format!("{said}{}", String::from_utf8_lossy(&output.stderr));
    let statuses: Vec<&str> = said
        .lines()
        .filter_map(|line| line.strip_prefix("rc "))
        .collect();
    assert_eq!(statuses.len(), 2, "{text}");
    assert!(
        statuses.iter().all(|status| ["0", "1"].contains(status)),
        "{text}"
    );
    assert!(!text.contains("panicked"), "{text}");
}
