//! `--emit-model` and `import model`: the way through a file, and what is refused on it.

use super::*;
use serde_json::Value;

/// Returns the `inspect --json` output of an asset without `provenance` and `bytes`.
fn content(folder: &Path, file: &str) -> Value {
    let shown = asperity(folder, &["inspect", file, "--json"]);
    assert!(shown.status.success(), "{file}: {}", text(&shown.stderr));
    let mut json: Value = serde_json::from_slice(&shown.stdout).expect("JSON");
    let top = json.as_object_mut().expect("an object");
    for key in ["provenance", "bytes"] {
        top.remove(key).expect("a key of the contract");
    }
    json
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let output = asperity(folder, arguments);
    let error = text(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {error}");
    output
}

/// Runs what must be refused as wrong usage; nothing may be left over.
fn misused(folder: &Path, arguments: &[&str], says: &str) {
    let before = entries(folder);
    let output = asperity(folder, arguments);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
    assert!(error.contains(says), "{arguments:?}: {error}");
    assert_eq!(entries(folder), before, "{arguments:?} left something");
}

#[test]
fn an_emitted_model_imports_to_the_same_asset() {
    let inputs = inputs();
    let folder = inputs.path();
    run(
        folder,
        &["builtin", "-o", "b.asp", "--emit-model", "b.json"],
    );
    let import = ["import", "hatt", "wood.xml", "-o", "w.asp"];
    run(folder, &[&import[..], &["--emit-model", "w.json"]].concat());
    for (model, asset) in [("b.json", "b.asp"), ("w.json", "w.asp")] {
        run(
            folder,
            &["import", "model", model, "-o", "again.asp", "--no-preview"],
        );
        assert_eq!(
            content(folder, "again.asp"),
            content(folder, asset),
            "{asset}"
        );
        // The haptic bytes come first, but for the section table that the provenance changes.
        let haptic = |file: &str| {
            let shown = run(folder, &["inspect", file, "--json"]);
            let json: Value = serde_json::from_slice(&shown.stdout).expect("JSON");
            json["bytes"]["haptic"].clone()
        };
        assert_eq!(haptic("again.asp"), haptic(asset), "{asset}");
    }
    // Beside an asset that cannot be, there is no model either.
    refused(
        folder,
        &["builtin", "-o", "no/such/b.asp", "--emit-model", "c.json"],
        &["no/such/b.asp"],
    );
    refused(
        folder,
        &["builtin", "-o", "c.asp", "--emit-model", "no/such/c.json"],
        &["no/such/c.json"],
    );
}

#[test]
fn the_report_of_an_import_is_text_or_json() {
    let inputs = inputs();
    let folder = inputs.path();
    run(
        folder,
        &["builtin", "-o", "b.asp", "--emit-model", "b.json"],
    );
    let import = [
        "import",
        "model",
        "b.json",
        "-o",
        "again.asp",
        "--fidelity",
        "5",
    ];
    let line = text(&run(folder, &import).stdout);
    assert_eq!(line.lines().count(), 1, "{line}");
    assert!(line.contains("5 of 20 poles"), "{line}");
    let json = run(folder, &[&import[..], &["--json"]].concat());
    let json: Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert_eq!(json["reduction"]["order"]["kept"], 5);
    assert_eq!(
        json["bytes"]["total"],
        fs::read(folder.join("again.asp")).expect("it").len()
    );
}

#[test]
fn timings_go_to_standard_error_and_change_no_byte() {
    let inputs = inputs();
    let folder = inputs.path();
    fs::write(
        folder.join("scene.toml"),
        "[[texture]]\nname = \"a\"\nasset = \"good.asp\"\n[[surface]]\ntexture = \"a\"\n\
         plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }\n",
    )
    .expect("a scene");
    run(folder, &["builtin", "-o", "x", "--emit-model", "b.json"]);
    let commands: [(&[&str], &[&str]); 4] = [
        (
            &["builtin"],
            &["generate", "reduce", "ceiling", "lower", "verify", "write"],
        ),
        (
            &["import", "hatt", "wood.xml"],
            &["read", "lower", "verify", "compare", "write"],
        ),
        (
            &["import", "model", "b.json"],
            &["read", "preview", "lower", "verify", "write"],
        ),
        (
            &["build", "scene.toml", "--no-cache", "--target", "100000"],
            &["read", "reduce", "lower", "pack", "verify", "write"],
        ),
    ];
    for (command, passes) in commands {
        let plain = run(folder, &[command, &["-o", "plain"]].concat());
        let timed = run(folder, &[command, &["-o", "timed", "--timings"]].concat());
        let figures = |output: &Output| text(&output.stdout).replace("plain", "timed");
        assert_eq!(figures(&timed), figures(&plain), "{command:?}");
        assert_eq!(text(&plain.stderr), "", "{command:?}");
        let table = text(&timed.stderr);
        let named: Vec<&str> = table
            .lines()
            .filter_map(|line| line.split_whitespace().next())
            .collect();
        for pass in [passes, &["total"]].concat() {
            assert!(named.contains(&pass), "{command:?}: {pass} not in {table}");
        }
        let read = |name: &str| fs::read(folder.join(name)).expect("an asset");
        assert!(read("plain") == read("timed"), "{command:?}");
    }
}

#[test]
fn malformed_models_are_refused_with_file_and_field() {
    let inputs = inputs();
    let folder = inputs.path();
    run(
        folder,
        &["builtin", "-o", "b.asp", "--emit-model", "b.json"],
    );
    let good = fs::read_to_string(folder.join("b.json")).expect("a model");
    let changed = |from: &str, to: &str| {
        let changed = good.replacen(from, to, 1);
        assert_ne!(changed, good, "{from}");
        changed
    };
    let cases: [(&str, String, &[&str]); 8] = [
        ("cut.json", good[..good.len() / 2].to_owned(), &["EOF"]),
        (
            "huge.json",
            changed("\"mu\": 0.72", "\"mu\": 1e999"),
            &["friction.mu", "out of range"],
        ),
        (
            "unit.json",
            changed("\"speed_mm_s\"", "\"speed_m_s\""),
            &["grid.vertices[0]", "speed_m_s"],
        ),
        (
            "later.json",
            changed("\"version\": 1", "\"version\": 7"),
            &["version", "7"],
        ),
        (
            "other.json",
            changed("asperity-model", "asperity-scene"),
            &["format", "asperity-scene"],
        ),
        (
            "mu.json",
            changed("\"mu\": 0.72", "\"mu\": -0.72"),
            &["friction.mu", "-0.72"],
        ),
        (
            "name.json",
            changed("Built-in Grit", ""),
            &["name", "1 to 64"],
        ),
        ("trace.csv", stroke(), &["trace.csv"]),
    ];
    for (name, json, named) in cases {
        fs::write(folder.join(name), json).expect("a file");
        let import = ["import", "model", name, "-o", "out.asp"];
        refused(folder, &import, &[&[name], named].concat());
    }
    // A resonance so narrow that an asset cannot hold it.
    let mut narrow: Value = serde_json::from_str(&good).expect("JSON");
    let lsf = &mut narrow["grid"]["vertices"][0]["lsf_rad"];
    lsf[1] = (lsf[0].as_f64().expect("a number") + 1e-6).into();
    fs::write(folder.join("narrow.json"), narrow.to_string()).expect("a file");
    refused(
        folder,
        &["import", "model", "narrow.json", "-o", "out.asp"],
        &["narrow.json", "vertex 0", "LSFs"],
    );
    for (name, says) in [("absent.json", "cannot read"), ("dir", "dir")] {
        refused(
            folder,
            &["import", "model", name, "-o", "out.asp"],
            &[name, says],
        );
    }
}

#[test]
fn outputs_that_are_inputs_or_each_other_are_wrong_usage() {
    let inputs = inputs();
    let folder = inputs.path();
    run(
        folder,
        &["builtin", "-o", "b.asp", "--emit-model", "b.json"],
    );
    let misuses: [(&[&str], &str); 6] = [
        (
            &["import", "model", "b.json", "-o", "dir/../b.json"],
            "an input",
        ),
        (
            &["import", "hatt", "wood.xml", "-o", "wood.xml"],
            "an input",
        ),
        (
            &[
                "import",
                "hatt",
                "wood.xml",
                "-o",
                "w.asp",
                "--emit-model",
                "wood.xml",
            ],
            "an input",
        ),
        (
            &["builtin", "-o", "c.asp", "--emit-model", "./c.asp"],
            "another output",
        ),
        (
            &["compile", "cork", "-o", "c.asp", "--plot", "c.asp"],
            "another output",
        ),
        (
            &[
                "import",
                "hatt",
                "mixed",
                "-o",
                "out",
                "--emit-model",
                "m.json",
            ],
            "--emit-model",
        ),
    ];
    for (arguments, says) in misuses {
        misused(folder, arguments, says);
    }
    misused(
        folder,
        &["import", "model", "b.json", "-o", "c.asp", "--rate", "3"],
        "--rate 3 Hz",
    );
}
