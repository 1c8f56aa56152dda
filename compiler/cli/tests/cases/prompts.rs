//! Prompts as people write and paste them.

use super::{Case, Check};
use serde_json::Value;
use std::fs;

pub(super) const CHECKS: &[(&str, Check)] =
    &[("prompt-zero-width", what_shows_nothing_changes_no_prompt)];

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
