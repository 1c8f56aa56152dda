//! Lists of textures as spreadsheets and scripts write them.

use super::{Case, Check};
use std::fs;

pub(super) const CHECKS: &[(&str, Check)] = &[
    ("jsonl-layout", every_layout_of_objects_and_heads_is_read),
    (
        "manifest-messages",
        lists_are_read_or_refused_by_what_is_wrong,
    ),
    ("missing-as-prompt", what_stands_for_no_prompt_is_named),
    ("whole-numbers", whole_numbers_are_read_as_they_are_written),
];

/// Checks a list that must be without a fault.
fn good(case: &Case, file: &str) {
    let run = case.asperity(&["build", &case.file(file), "--check"]);
    assert_eq!(run.code, Some(0), "{file}: {}", run.stderr);
}

fn every_layout_of_objects_and_heads_is_read(case: &Case) {
    for file in ["array.jsonl", "commas.jsonl", "pretty.jsonl", "upper.csv"] {
        good(case, file);
    }
    let utf16 = case.file("utf16.csv");
    case.refused(
        &["build", &utf16, "--check"],
        &["utf16.csv", "UTF-16", "save"],
    );
}

fn what_stands_for_no_prompt_is_named(case: &Case) {
    let list = case.file("list.csv");
    let run = case.asperity(&["build", &list, "--check"]);
    assert_eq!(run.code, Some(1), "{}", run.stdout);
    let words = ["NA", "NaN", "None", "null", "#REF!", "#NAME?", "-"];
    for (line, word) in (2..).zip(words) {
        let named = format!(":{line}: prompt: {word:?} is no prompt");
        assert!(run.stderr.contains(&named), "{named}: {}", run.stderr);
    }
}

fn whole_numbers_are_read_as_they_are_written(case: &Case) {
    for file in ["float.jsonl", "float.toml", "pandas.csv"] {
        good(case, file);
    }
    let excel = case.file("excel.csv");
    let says = [":2: seed: \"1,000\" must be a whole number", "such as 1000"];
    case.refused(&["build", &excel, "--check"], &says);
    let run = case.asperity(&["build", &excel, "--check"]);
    assert!(!run.stderr.contains("1E+05"), "{}", run.stderr);
    case.import("model", "version.json");
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
