//! Files of other people that were read wrongly once: `tests/cases`, a folder a case. Each does what its README
//! says, by the command that a user runs. A folder without a check here fails, and so does a check without a folder.

mod effects;
mod lists;
mod machine;
mod prompts;
mod recordings;

use serde_json::Value;
use std::{
    collections::BTreeSet,
    fs,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    process::Command,
};

/// A check of a case.
type Check = fn(&Case);

const CHECKS: [&[(&str, Check)]; 5] = [
    effects::CHECKS,
    lists::CHECKS,
    machine::CHECKS,
    prompts::CHECKS,
    recordings::CHECKS,
];

struct Case {
    folder: PathBuf,
    scratch: tempfile::TempDir,
}

/// Result of a command.
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

    /// A folder of the case in the scratch folder.
    fn copied(&self, folder: &str) -> PathBuf {
        let copy = self.scratch.path().join(folder);
        fs::create_dir(&copy).expect("a folder");
        for entry in fs::read_dir(self.file(folder)).expect("the folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().expect("a name");
            fs::copy(&path, copy.join(name)).expect("a copy");
        }
        copy
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

    /// Imports a file, which must succeed, and returns standard error.
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
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/cases");
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
    let checked: BTreeSet<String> = CHECKS
        .concat()
        .iter()
        .map(|(name, _)| (*name).to_owned())
        .collect();
    assert_eq!(
        found,
        checked,
        "cases in {}, and those with a check",
        root.display()
    );
    let failed: Vec<&str> = CHECKS
        .concat()
        .into_iter()
        .filter(|(name, check)| {
            let case = Case {
                folder: root.join(name),
                scratch: tempfile::tempdir().expect("a folder"),
            };
            assert!(case.folder.join("README").exists(), "{name} has no README");
            catch_unwind(AssertUnwindSafe(|| check(&case))).is_err()
        })
        .map(|(name, _)| name)
        .collect();
    assert!(failed.is_empty(), "{failed:?}: see the panics above");
}
