//! The lexicon's files are well formed, repeat no phrase, and hold no prompt of an evaluation.

use asperity_corpus::reference::{self, ReferenceOptions, check::words};
use serde::Deserialize;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// Phrases there are at least.
const LEAST_PHRASES: usize = 9_700;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    text: String,
    rough: f64,
    slippery: f64,
    hard: f64,
    sure: f64,
}

fn corpora() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../corpora")
}

fn key(text: &str) -> String {
    words(text).join(" ")
}

/// Every row, with its file.
fn rows() -> Vec<(String, Row)> {
    let mut rows = Vec::new();
    for entry in fs::read_dir(corpora().join("lexicon")).expect("the folder of the lexicon") {
        let path = entry.expect("an entry").path();
        let name = path
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        if !name.ends_with(".csv") || name == "anchors.csv" {
            continue;
        }
        let mut reader = csv::Reader::from_path(&path).expect("a CSV file");
        for row in reader.deserialize() {
            let row = row.unwrap_or_else(|error| panic!("{name}: {error}"));
            rows.push((name.clone(), row));
        }
    }
    rows
}

/// Every text in a TOML value.
fn texts(value: &toml::Value, found: &mut BTreeSet<String>) {
    match value {
        toml::Value::String(text) => {
            found.insert(key(text));
        }
        toml::Value::Array(values) => values.iter().for_each(|value| texts(value, found)),
        toml::Value::Table(table) => table.values().for_each(|value| texts(value, found)),
        _ => {}
    }
}

#[test]
fn every_row_is_within_the_scale_and_no_phrase_stands_twice() {
    let options = ReferenceOptions {
        instances: 1,
        ..ReferenceOptions::default()
    };
    let (_, lexicon) = reference::load(&options).expect("the committed corpus");
    let rows = rows();
    // What is not in these files is in `everyday.toml`.
    let own: BTreeSet<&str> = rows.iter().map(|(_, row)| row.text.as_str()).collect();
    let mut seen: BTreeMap<String, String> = lexicon
        .iter()
        .filter(|entry| !own.contains(entry.text.as_str()))
        .map(|entry| (key(&entry.text), "everyday.toml".to_owned()))
        .collect();
    assert_eq!(seen.len() + rows.len(), lexicon.len());
    assert!(rows.len() >= LEAST_PHRASES, "{}", rows.len());
    for (file, row) in rows {
        let numbers = [row.rough, row.slippery, row.hard, row.sure];
        let text = row.text;
        assert!(
            numbers.iter().all(|x| (0.0..=100.0).contains(x)),
            "{file}: {text:?}"
        );
        assert!(
            !key(&text).is_empty() && text == text.trim(),
            "{file}: {text:?}"
        );
        if let Some(other) = seen.insert(key(&text), file.clone()) {
            panic!("{text:?} stands in {other} and in {file}");
        }
    }
}

#[test]
fn no_phrase_is_a_prompt_of_an_evaluation() {
    let mut prompts = BTreeSet::new();
    for file in ["pairs.toml", "probes.toml"] {
        let text = fs::read_to_string(corpora().join(file)).expect(file);
        texts(&toml::from_str(&text).expect(file), &mut prompts);
    }
    let touchable = fs::read_to_string(corpora().join("evaluation/touchable.txt"));
    prompts.extend(touchable.expect("touchable.txt").lines().map(key));
    let found: Vec<String> = rows()
        .into_iter()
        .filter(|(_, row)| prompts.contains(&key(&row.text)))
        .map(|(file, row)| format!("{file}: {:?}", row.text))
        .collect();
    assert!(
        found.is_empty(),
        "{} prompts are in the lexicon: {found:#?}",
        found.len()
    );
}
