//! Everyday phrases with attributes: the meaning of ordinary words for touch.

use crate::{Rating, error::CorpusError};
use serde::Deserialize;
use std::{collections::BTreeSet, path::Path};

/// A phrase and its attributes.
#[derive(Debug, Clone, PartialEq)]
pub struct LexiconEntry {
    /// The phrase.
    pub text: String,
    /// Its attributes, 0–100.
    pub rating: Rating,
    /// The rater's confidence that an average person would agree within ±10, 0–100.
    pub sure: f64,
}

/// Sureness of a phrase in a file that does not state it.
const SURE: f64 = 75.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LexiconFile {
    phrases: Vec<Row>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    text: String,
    rough: f64,
    slippery: f64,
    hard: f64,
    #[serde(default = "sure")]
    sure: f64,
}

fn sure() -> f64 {
    SURE
}

/// Reads the files of a lexicon, TOML or CSV by the ending of their names.
///
/// # Errors
/// [`CorpusError`] for a syntax error, an empty or repeated phrase, or a number outside 0–100.
pub fn parse<'a>(
    files: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Result<Vec<LexiconEntry>, CorpusError> {
    let mut seen = BTreeSet::new();
    let mut faults = Vec::new();
    let mut entries = Vec::new();
    for (file, text) in files {
        let rows = rows(file, text)?;
        check(file, &rows, &mut seen, &mut faults);
        entries.extend(rows.into_iter().map(LexiconEntry::from));
    }
    if !faults.is_empty() {
        return Err(CorpusError::Faults { faults });
    }
    Ok(entries)
}

fn rows(file: &str, text: &str) -> Result<Vec<Row>, CorpusError> {
    let syntax = |message: String| CorpusError::Syntax {
        file: file.to_owned(),
        message,
    };
    if Path::new(file)
        .extension()
        .is_some_and(|ending| ending == "csv")
    {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let rows: Result<Vec<Row>, _> = reader.deserialize().collect();
        return rows.map_err(|error| syntax(error.to_string()));
    }
    let parsed: LexiconFile = toml::from_str(text).map_err(|error| syntax(error.to_string()))?;
    Ok(parsed.phrases)
}

fn check(file: &str, rows: &[Row], seen: &mut BTreeSet<String>, faults: &mut Vec<String>) {
    for row in rows {
        let mut fault =
            |what: String| faults.push(format!("{file}: phrase {:?}: {what}", row.text));
        if row.text.trim().is_empty() {
            fault("is empty".into());
        }
        if !seen.insert(row.text.to_lowercase()) {
            fault("appears twice".into());
        }
        for (field, value) in [
            ("rough", row.rough),
            ("slippery", row.slippery),
            ("hard", row.hard),
            ("sure", row.sure),
        ] {
            if !(0.0..=100.0).contains(&value) {
                fault(format!("{field} = {value} is not in 0..=100"));
            }
        }
    }
}

impl From<Row> for LexiconEntry {
    fn from(row: Row) -> Self {
        Self {
            text: row.text,
            rating: Rating {
                rough: row.rough,
                slippery: row.slippery,
                hard: row.hard,
            },
            sure: row.sure,
        }
    }
}
