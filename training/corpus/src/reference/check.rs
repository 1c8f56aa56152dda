//! The rules of the corpus, checked entry by entry.

use super::schema::{FamilyFile, MaterialEntry};
use crate::{Focus, error::CorpusError};
use std::collections::{BTreeMap, BTreeSet};

/// Fewest materials, families and captions.
const LEAST_MATERIALS: usize = 160;
const LEAST_FAMILIES: usize = 14;
const LEAST_TRAINING: usize = 6;
const LEAST_FOCUSES: usize = 3;
const HELD_OUT: usize = 3;
/// Largest fraction of the content words of a held-out caption that its material's training
/// captions may contain.
const LARGEST_OVERLAP: f64 = 0.50;
/// Prefixes of a provenance.
const ORIGINS: [&str; 5] = [
    "handbook:",
    "standard:",
    "geometry:",
    "estimate:",
    "analogy:",
];
/// Words that say nothing about a material.
const STOP_WORDS: &str = "a about above across after against all along also an and another any are as at \
    away back be because been before behind being below beside between both but by can could does down \
    each even ever every few for from gets give gives given goes had has have having her here his how \
    i if in into is it its itself just keep keeps kind leaves less let lets like little made make makes \
    many more most much my near nearly neither never no nor not of off on once one only onto or other our \
    out over own quite rather round same she so some something still such than that the their them then \
    there these they thing things this those through to too two under until up upon us very was way we \
    were what when where which while who whose will with within without you your";

/// Checks all files together.
///
/// # Errors
/// [`CorpusError::Faults`] with every fault by file, material and field.
pub fn check(files: &[(String, FamilyFile)]) -> Result<(), CorpusError> {
    let mut faults = Vec::new();
    let mut names: BTreeMap<&str, &str> = BTreeMap::new();
    let mut captions: BTreeMap<String, String> = BTreeMap::new();
    for (file, family) in files {
        let expected = file.strip_suffix(".toml").unwrap_or(file);
        if family.family != expected {
            faults.push(format!(
                "{file}: family is {:?}, not {expected:?}",
                family.family
            ));
        }
        for entry in &family.material {
            if let Some(other) = names.insert(&entry.name, file) {
                faults.push(format!("{file}: {}: name: also in {other}", entry.name));
            }
            let mut report = |field: &str, what: String| {
                faults.push(format!("{file}: {}: {field}: {what}", entry.name));
            };
            entry_faults(entry, &mut report);
            let texts = entry
                .training
                .iter()
                .map(|c| &c.text)
                .chain(&entry.held_out);
            for text in texts {
                if let Some(other) = captions.insert(text.to_lowercase(), entry.name.clone()) {
                    report("captions", format!("{text:?} is also a caption of {other}"));
                }
            }
        }
    }
    let materials: usize = files.iter().map(|(_, family)| family.material.len()).sum();
    if materials < LEAST_MATERIALS {
        faults.push(format!(
            "corpus: {materials} materials, at least {LEAST_MATERIALS} wanted"
        ));
    }
    if files.len() < LEAST_FAMILIES {
        faults.push(format!(
            "corpus: {} families, at least {LEAST_FAMILIES} wanted",
            files.len()
        ));
    }
    if faults.is_empty() {
        Ok(())
    } else {
        Err(CorpusError::Faults { faults })
    }
}

fn entry_faults(entry: &MaterialEntry, report: &mut impl FnMut(&str, String)) {
    if entry.name.is_empty() || entry.name.len() > asperity_name_limit() {
        report(
            "name",
            format!(
                "{} bytes, 1..={} wanted",
                entry.name.len(),
                asperity_name_limit()
            ),
        );
    }
    if entry.training.len() < LEAST_TRAINING {
        report(
            "training",
            format!(
                "{} captions, at least {LEAST_TRAINING} wanted",
                entry.training.len()
            ),
        );
    }
    let focuses: BTreeSet<Focus> = entry.training.iter().map(|caption| caption.focus).collect();
    if focuses.len() < LEAST_FOCUSES {
        report(
            "training",
            format!(
                "{} kinds of focus, at least {LEAST_FOCUSES} wanted",
                focuses.len()
            ),
        );
    }
    if entry.held_out.len() != HELD_OUT {
        report(
            "held_out",
            format!("{} captions, {HELD_OUT} wanted", entry.held_out.len()),
        );
    }
    for caption in &entry.held_out {
        held_out_faults(entry, caption, report);
    }
    let rating = &entry.attributes;
    for (field, value) in [
        ("attributes.rough", rating.rough),
        ("attributes.slippery", rating.slippery),
        ("attributes.hard", rating.hard),
    ] {
        if !(0.0..=100.0).contains(&value) {
            report(field, format!("{value} is not in 0..=100"));
        }
    }
    for (field, sourced, (low, high)) in entry.physical.fields() {
        let field = format!("physical.{field}");
        if !(low..=high).contains(&sourced.value) {
            report(
                &field,
                format!("{} is not in {low}..={high}", sourced.value),
            );
        }
        let told = ORIGINS.iter().any(|origin| {
            sourced
                .from
                .strip_prefix(origin)
                .is_some_and(|rest| rest.trim().len() > 2)
        });
        if !told {
            report(
                &field,
                format!(
                    "from = {:?} must begin with one of {ORIGINS:?} and say more",
                    sourced.from
                ),
            );
        }
    }
}

fn held_out_faults(entry: &MaterialEntry, caption: &str, report: &mut impl FnMut(&str, String)) {
    let words = words(caption);
    let text = format!(" {} ", words.join(" "));
    for synonym in &entry.synonyms {
        let synonym = self::words(synonym).join(" ");
        if !synonym.is_empty()
            && (text.contains(&format!(" {synonym} ")) || text.contains(&format!(" {synonym}s ")))
        {
            report("held_out", format!("{caption:?} names it: {synonym:?}"));
        }
    }
    let trained: BTreeSet<String> = entry
        .training
        .iter()
        .flat_map(|caption| self::words(&caption.text))
        .collect();
    let content: Vec<&String> = words.iter().filter(|word| !is_stop_word(word)).collect();
    let shared = content
        .iter()
        .filter(|word| trained.contains(**word))
        .count();
    if shared as f64 > LARGEST_OVERLAP * content.len() as f64 {
        report(
            "held_out",
            format!(
                "{caption:?} shares {shared} of {} content words with training captions",
                content.len()
            ),
        );
    }
    for training in &entry.training {
        let training = self::words(&training.text);
        let repeats = words
            .windows(4)
            .any(|four| training.windows(4).any(|other| four == other));
        if repeats {
            report(
                "held_out",
                format!(
                    "{caption:?} repeats four words in a row of {:?}",
                    training.join(" ")
                ),
            );
        }
    }
}

/// Lower-case words without punctuation.
#[must_use]
pub fn words(text: &str) -> Vec<String> {
    text.split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_lowercase)
        .collect()
}

/// Returns true if a lower-case word says nothing about a material.
#[must_use]
pub fn is_stop_word(word: &str) -> bool {
    word.len() < 3 || STOP_WORDS.split_whitespace().any(|stop| stop == word)
}

const fn asperity_name_limit() -> usize {
    64
}
