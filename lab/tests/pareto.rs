//! `asperity-lab pareto`: the files it writes, and that it writes the same ones again.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn pareto(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
        .current_dir(folder)
        .arg("pareto")
        .args(arguments)
        .output()
        .expect("the program starts")
}

#[test]
fn a_quick_run_writes_every_table_and_chart_twice_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    for out in ["one", "two"] {
        let output = pareto(folder.path(), &["--quick", "--json", "--out", out]);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{stderr}");
        assert!(
            stderr.is_empty(),
            "no progress where there is no terminal: {stderr}"
        );
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(json["materials"], 6);
        assert_eq!(json["auto"]["within_budget"], 6);
        let default = &json["designs"][0];
        assert_eq!(default["within_budget"], true);
        assert_eq!(default["unstable_share"], 0.0);
        assert!(
            default["instructions_a_tick"].is_null(),
            "nothing was counted"
        );
    }
    let mut names: Vec<String> = fs::read_dir(folder.path().join("one"))
        .expect("made")
        .map(|entry| {
            entry
                .expect("readable")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    assert_eq!(
        names,
        ["factors.png", "fidelity.png", "front.png", "tables.md"]
    );
    for name in names {
        let read = |out: &str| fs::read(folder.path().join(out).join(&name)).expect("readable");
        assert!(read("one") == read("two"), "{name} differs");
    }
}

#[test]
fn a_missing_folder_and_a_table_that_is_none_are_failures_that_leave_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("m4f.csv"), "factor,name\nx,y\n").expect("written");
    for arguments in [
        &["--hatt", "nowhere", "--out", "charts"][..],
        &["--cortex-m", "m4f.csv", "--out", "charts"],
        &["--cortex-m", "nowhere.csv", "--out", "charts"],
    ] {
        let output = pareto(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(!output.stderr.is_empty());
        assert!(!folder.path().join("charts").exists());
    }
}

#[test]
fn counts_of_a_firmware_bench_get_a_column() {
    let folder = tempfile::tempdir().expect("a folder");
    let counts = "factor,name,instructions\ndefault,default,1234\n";
    fs::write(folder.path().join("m4f.csv"), counts).expect("written");
    let output = pareto(
        folder.path(),
        &["--quick", "--cortex-m", "m4f.csv", "--out", "charts"],
    );
    assert!(output.status.success());
    let tables = fs::read_to_string(folder.path().join("charts/tables.md")).expect("written");
    let cells: Vec<(&str, &str)> = tables
        .lines()
        .filter_map(|line| match line.split(" | ").collect::<Vec<_>>()[..] {
            [name, _, m4f, _, _, _, _, _] if name != "| design" => Some((name, m4f)),
            _ => None,
        })
        .collect();
    assert!(cells.len() > 8, "{tables}");
    for (name, m4f) in cells {
        let expected = if name == "| **default**" {
            "1234"
        } else {
            "–"
        };
        assert_eq!(m4f, expected, "{name}");
    }
}

#[test]
fn tables_do_not_replace_the_counts_they_are_made_of() {
    let folder = tempfile::tempdir().expect("a folder");
    let charts = folder.path().join("charts");
    fs::create_dir(&charts).expect("a folder");
    let counts = "factor,name,instructions\ndefault,default,1234\n";
    fs::write(charts.join("tables.md"), counts).expect("written");
    let output = pareto(
        folder.path(),
        &[
            "--quick",
            "--cortex-m",
            "charts/tables.md",
            "--out",
            "charts",
        ],
    );
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(
        error.contains("tables.md: the output is also an input"),
        "{error}"
    );
    let entries = fs::read_dir(&charts).expect("the folder").count();
    assert_eq!(entries, 1, "nothing else was written");
    let kept = fs::read_to_string(charts.join("tables.md")).expect("readable");
    assert_eq!(kept, counts);
}
