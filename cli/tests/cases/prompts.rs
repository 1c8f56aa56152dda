//! Prompts as people write and paste them.

use super::{Case, Check};
use serde_json::Value;
use std::{collections::BTreeMap, fs};

pub(super) const CHECKS: &[(&str, Check)] = &[
    (
        "prompt-foreign",
        a_word_of_another_language_is_never_more_than_a_guess,
    ),
    ("prompt-graphics-words", each_feels_like_its_reference),
    ("prompt-numbers", each_feels_like_its_reference),
    ("prompt-one-word", each_feels_like_its_reference),
    (
        "prompt-warning-normalised",
        what_is_read_right_is_not_said_to_be_unread,
    ),
    ("prompt-zero-width", what_shows_nothing_changes_no_prompt),
];

/// The report of a prompt, and what the command warns of.
fn compiled(case: &Case, prompt: &str) -> (Value, String) {
    let run = case.asperity(&["compile", prompt, "-o", "p.asp", "--no-preview", "--json"]);
    assert_eq!(run.code, Some(0), "{prompt}: {}", run.stderr);
    let json = serde_json::from_str(&run.stdout).expect("JSON");
    (json, run.stderr)
}

fn lines(case: &Case, file: &str) -> Vec<String> {
    let text = fs::read_to_string(case.file(file)).expect(file);
    let lines = text.lines().filter(|line| !line.is_empty());
    lines.map(str::to_owned).collect()
}

/// Within 2 dB of roughness, 15 % of hardness and 10 % of friction.
fn each_feels_like_its_reference(case: &Case) {
    let feel = |prompt: &str| {
        let (json, _) = compiled(case, prompt);
        ["rough_db", "hard_hz", "mu"]
            .map(|attribute| json["attributes"][attribute].as_f64().expect(attribute))
    };
    let mut references: BTreeMap<String, [f64; 3]> = BTreeMap::new();
    let mut wrong = Vec::new();
    for line in lines(case, "pairs.tsv") {
        let (prompt, reference) = line.split_once('\t').expect("PROMPT, REFERENCE");
        let known = references.get(reference).copied();
        let [rough_db, hard_hz, mu] = known.unwrap_or_else(|| feel(reference));
        references.insert(reference.to_owned(), [rough_db, hard_hz, mu]);
        let felt = feel(prompt);
        let like = (felt[0] - rough_db).abs() <= 2.0
            && (felt[1] / hard_hz - 1.0).abs() <= 0.15
            && (felt[2] / mu - 1.0).abs() <= 0.10;
        if !like {
            wrong.push(format!("{prompt}: {felt:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

fn a_word_of_another_language_is_never_more_than_a_guess(case: &Case) {
    for prompt in lines(case, "prompts.txt") {
        let (json, warnings) = compiled(case, &prompt);
        assert_eq!(json["certainty_level"], "guess", "{prompt}");
        assert!(warnings.contains("a guess: "), "{prompt}: {warnings}");
    }
}

fn what_is_read_right_is_not_said_to_be_unread(case: &Case) {
    let read = ["fleece", "velvet"];
    let prompts = lines(case, "prompts.txt");
    assert_eq!(prompts.len(), read.len());
    for (prompt, read) in prompts.iter().zip(read) {
        let (json, warnings) = compiled(case, prompt);
        assert_eq!(json["taken_as"], read);
        assert!(!warnings.contains("understood"), "{warnings}");
    }
}

fn what_shows_nothing_changes_no_prompt(case: &Case) {
    let prompt = fs::read_to_string(case.file("prompt.txt")).expect("a prompt");
    let (json, warnings) = compiled(case, prompt.trim());
    assert_eq!(json["taken_as"], "sandpaper");
    assert_eq!(
        json["attributes"],
        compiled(case, "sandpaper").0["attributes"]
    );
    assert!(!warnings.contains("understood"), "{warnings}");
}
