//! Files of other people that were read wrongly once: `cases`, a folder a case. Each does what its
//! README says, by the command that a user runs. A folder without a check here fails, and so does a
//! check without a folder.

use serde_json::Value;
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// Checks a case.
type Check = fn(&Case);

const CHECKS: &[(&str, Check)] = &[
    ("calibrate-wrong-unit", units_of_a_calibration_are_checked),
    ("cyclictest-without-histogram", a_missing_histogram_is_named),
    ("jitter-foreign-texts", other_tools_are_read_or_named),
    ("jitter-units", heads_state_units),
];

struct Case {
    folder: PathBuf,
    scratch: tempfile::TempDir,
}

impl Case {
    fn lab(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
            .args(arguments)
            .current_dir(self.scratch.path())
            .output()
            .expect("the command runs")
    }

    fn file(&self, name: &str) -> String {
        let path = self.folder.join(name);
        assert!(path.exists(), "{} is missing", path.display());
        path.to_str().expect("a path in UTF-8").to_owned()
    }

    /// Files of the case, without its README.
    fn files(&self) -> Vec<String> {
        let names = fs::read_dir(&self.folder).expect("the folder");
        let names = names.map(|entry| entry.expect("an entry").file_name().into_string());
        let mut names: Vec<String> = names.collect::<Result<_, _>>().expect("UTF-8");
        names.retain(|name| name != "README");
        names.sort();
        names
    }

    /// The median of a file's latencies, ns, or what refuses it.
    fn median_ns(&self, name: &str, options: &[&str]) -> Result<f64, String> {
        let file = self.file(name);
        let command = ["jitter", "overlay", &file, "-o", "x.png", "--json"];
        let run = self.lab(&[&command, options].concat());
        let stderr = String::from_utf8_lossy(&run.stderr).into_owned();
        if !run.status.success() {
            assert_eq!(run.status.code(), Some(1), "{name}: {stderr}");
            assert!(stderr.contains("\n  help: "), "{name}: {stderr}");
            assert!(!self.scratch.path().join("x.png").exists(), "{name}");
            return Err(stderr);
        }
        let json: Value = serde_json::from_slice(&run.stdout).expect("JSON");
        let median = &json["runs"][0]["percentiles_ns"]["p50"];
        Ok(median.as_f64().expect("a median"))
    }
}

fn units_of_a_calibration_are_checked(case: &Case) {
    let run = |name: &str, options: &[&str]| {
        let file = case.file(name);
        let command = ["device", "calibrate", &file, "-o", "x.toml"];
        let output = case.lab(&[&command, options].concat());
        let written = fs::read_to_string(case.scratch.path().join("x.toml")).ok();
        // The next one begins without it.
        let _ = fs::remove_file(case.scratch.path().join("x.toml"));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), said, written)
    };
    let (code, said, written) = run("ok.csv", &[]);
    assert_eq!(code, Some(0), "{said}");
    assert!(written.expect("a profile").contains("taps = [1.388"));
    for (name, words) in [
        ("g.csv", ["accel_m_s2", "9.8", "g"]),
        ("mn.csv", ["force_n", "1000", "mN"]),
    ] {
        let (code, said, written) = run(name, &[]);
        assert_eq!((code, written), (Some(1), None), "{name}: {said}");
        for word in words {
            assert!(said.contains(word), "{name}: {word}: {said}");
        }
        let (code, said, _) = run(name, &["--force"]);
        assert!(said.contains("warning"), "{name}, --force: {code:?} {said}");
    }
}

fn a_missing_histogram_is_named(case: &Case) {
    for name in case.files() {
        let refused = case.median_ns(&name, &[]).expect_err(&name);
        assert!(refused.contains("-h 1000"), "{name}: {refused}");
    }
}

fn other_tools_are_read_or_named(case: &Case) {
    for name in case.files() {
        let median = case.median_ns(&name, &["--column", "latency_us"]);
        let median_ns = median.unwrap_or_else(|said| panic!("{name}: {said}"));
        let (low, high) = match name.as_str() {
            // Latencies of 1 and 2 µs alone.
            "rtla.txt" => (1990.0, 2010.0),
            _ => (22_900.0, 24_000.0),
        };
        assert!((low..high).contains(&median_ns), "{name}: {median_ns} ns");
    }
}

fn heads_state_units(case: &Case) {
    for name in case.files() {
        let median_ns = case
            .median_ns(&name, &[])
            .unwrap_or_else(|said| panic!("{name}: {said}"));
        assert!(
            (23_000.0..24_000.0).contains(&median_ns),
            "{name}: {median_ns} ns"
        );
    }
}

#[test]
fn every_case_does_what_its_readme_says() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let entries = fs::read_dir(&root).expect("the cases");
    let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
    let found: BTreeSet<_> = entries.map(name).collect();
    let checked: BTreeSet<_> = CHECKS.iter().map(|(name, _)| (*name).into()).collect();
    assert_eq!(found, checked, "cases, and those with a check");
    for (name, check) in CHECKS {
        println!("{name}");
        let folder = root.join(name);
        assert!(folder.join("README").exists(), "{name} has no README");
        let scratch = tempfile::tempdir().expect("a folder");
        check(&Case { folder, scratch });
    }
}
