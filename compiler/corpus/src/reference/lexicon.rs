//! Everyday phrases with attributes: the meaning of ordinary words for touch.

use crate::{Rating, error::CorpusError};
use serde::Deserialize;

/// A phrase and its attributes.
#[derive(Debug, Clone, PartialEq)]
pub struct LexiconEntry {
    /// The phrase.
    pub text: String,
    /// Its attributes, 0–100.
    pub rating: Rating,
}

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
}

/// Reads the lexicon.
///
/// # Errors
/// [`CorpusError`] for a syntax error, an empty or repeated phrase, or a rating outside 0–100.
pub fn parse(file: &str, text: &str) -> Result<Vec<LexiconEntry>, CorpusError> {
    let parsed: LexiconFile = toml::from_str(text).map_err(|error| CorpusError::Syntax {
        file: file.to_owned(),
        message: error.to_string(),
    })?;
    let mut seen = std::collections::BTreeSet::new();
    let mut faults = Vec::new();
    for row in &parsed.phrases {
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
        ] {
            if !(0.0..=100.0).contains(&value) {
                fault(format!("{field} = {value} is not in 0..=100"));
            }
        }
    }
    if !faults.is_empty() {
        return Err(CorpusError::Faults { faults });
    }
    Ok(parsed
        .phrases
        .into_iter()
        .map(|row| LexiconEntry {
            text: row.text,
            rating: Rating {
                rough: row.rough,
                slippery: row.slippery,
                hard: row.hard,
            },
        })
        .collect())
}
