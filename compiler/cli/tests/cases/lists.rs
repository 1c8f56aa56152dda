//! Lists of textures as spreadsheets and scripts write them.

use super::{Case, Check};
use std::fs;

pub(super) const CHECKS: &[(&str, Check)] = &[(
    "manifest-messages",
    lists_are_read_or_refused_by_what_is_wrong,
)];

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
