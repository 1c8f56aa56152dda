//! The report on paper: `report.md` reads like a results section, `report.json` holds
//! every number.

mod bars;
mod charts;
mod clustering;
mod completion;
mod held_out;
mod midpoints;
mod names;
mod probes;
mod retrieval;

use super::{
    Bench, EvaluateError,
    clustering::Clustering,
    held_out::{Completion, HeldOut},
    midpoints::Midpoints,
    names::Names,
    probes::Probing,
    retrieval::Retrieval,
};
use asperity::learned::description::CertaintyCurve;
use asperity_io::output::{OutputError, write_folder};
use serde::Serialize;
use std::{fmt::Write as _, fs, path::Path};

/// Under what a report was measured. No clock is read: the same model and options give
/// the same report.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Conditions {
    /// Name of the model.
    pub model: String,
    /// CRC-32 of its networks and description, certainty apart.
    pub model_crc32: String,
    /// Seed that it was trained with, and that splits are drawn with.
    pub seed: u64,
    /// Name of the corpus.
    pub corpus: String,
    /// CRC-32 of its files.
    pub corpus_crc32: String,
    /// Materials.
    pub materials: usize,
    /// Families.
    pub families: usize,
    /// True if its taps were synthesised.
    pub taps_synthetic: bool,
    /// Text encoder.
    pub text_encoder: String,
    /// Its configuration, as TOML.
    pub config: String,
}

/// A report; parts that were not asked for, and not kept from before, are `None`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Under what it was measured.
    pub conditions: Conditions,
    /// Part 1.
    pub clustering: Option<Clustering>,
    /// Part 2.
    pub retrieval: Option<Retrieval>,
    /// Part 3.
    pub held_out: Option<HeldOut>,
    /// Part 4.
    pub probes: Option<Probing>,
    /// Part 5.
    pub midpoints: Option<Midpoints>,
    /// Part 7.
    pub names: Option<Names>,
    /// Part 8.
    pub completion: Option<Completion>,
}

/// `certainty.json`: the curve for a model description, and the one that also looks at
/// single materials held out.
#[derive(Serialize)]
struct Certainty<'a> {
    #[serde(flatten)]
    families: &'a CertaintyCurve,
    both: &'a CertaintyCurve,
}

impl Report {
    pub(super) fn new(bench: &Bench<'_>) -> Self {
        let (corpus, description) = (&bench.corpus, bench.subject.description());
        let families = description.anchors.iter().map(|a| a.family.as_str());
        let families: std::collections::BTreeSet<&str> = families.collect();
        Self {
            conditions: Conditions {
                model: description.name.clone(),
                model_crc32: format!("{:08x}", bench.subject.crc32),
                seed: bench.config.seed,
                corpus: corpus.name.clone(),
                corpus_crc32: format!("{:08x}", corpus.crc32),
                materials: bench.materials.len(),
                families: families.len(),
                taps_synthetic: corpus.taps_synthetic,
                text_encoder: description.text_encoder.name.clone(),
                // A configuration that was read as TOML can be written as TOML.
                config: bench.config.to_toml().unwrap_or_default(),
            },
            clustering: None,
            retrieval: None,
            held_out: None,
            probes: None,
            midpoints: None,
            names: None,
            completion: None,
        }
    }

    /// Writes everything into a folder, at once.
    pub(super) fn write(&self, folder: &Path) -> Result<(), EvaluateError> {
        fs::create_dir_all(folder).map_err(|source| OutputError {
            path: folder.to_owned(),
            doing: "cannot make the folder",
            source,
        })?;
        let mut files: Vec<(String, Vec<u8>)> = vec![
            ("report.md".into(), self.markdown().into_bytes()),
            ("report.json".into(), self.json()?.into_bytes()),
        ];
        if let Some(part) = &self.held_out {
            let certainty = Certainty {
                families: &part.certainty,
                both: &part.certainty_both,
            };
            let json = encode("certainty.json", &certainty)?;
            files.push(("certainty.json".into(), json.into_bytes()));
            files.push(("held_out.png".into(), charts::held_out(part)?));
        }
        if let Some(part) = &self.probes {
            files.push(("probes.png".into(), charts::probes(part)?));
        }
        let files: Vec<(String, &[u8])> = files
            .iter()
            .map(|(name, bytes)| (name.clone(), bytes.as_slice()))
            .collect();
        Ok(write_folder(folder, &files)?)
    }

    /// Returns the content of `report.json`.
    ///
    /// # Errors
    /// [`EvaluateError::Encode`], which no report met so far.
    pub fn json(&self) -> Result<String, EvaluateError> {
        encode("report.json", self)
    }

    fn markdown(&self) -> String {
        let mut text = self.head();
        let sections = [
            self.clustering.as_ref().map(clustering::section),
            self.retrieval.as_ref().map(retrieval::section),
            self.held_out.as_ref().map(held_out::section),
            self.probes.as_ref().map(probes::section),
            self.midpoints.as_ref().map(midpoints::section),
            self.names.as_ref().map(names::section),
            self.completion.as_ref().map(completion::section),
        ];
        for section in sections.into_iter().flatten() {
            text.push('\n');
            text.push_str(&section);
        }
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n## Configuration of the model\n\n```toml\n{}\n```\n",
            self.conditions.config.trim_end()
        );
        text
    }

    fn head(&self) -> String {
        let c = &self.conditions;
        let taps = if c.taps_synthetic {
            "synthesised, not recorded: what is said of taps says how well the model knows the \
             synthesis"
        } else {
            "recorded"
        };
        format!(
            "# Evaluation of the model `{}`\n\n\
             | | |\n|---|---|\n\
             | model | {}, CRC-32 {}, trained with seed {} |\n\
             | corpus | {}, CRC-32 {}: {} materials in {} families |\n\
             | taps | {taps} |\n\
             | text encoder | {} |\n\n\
             Written by `asperity-train evaluate`; `report.json` holds every number. Intervals \
             are Wilson's at 95 %. Nothing here was felt by people.\n",
            c.model,
            c.model,
            c.model_crc32,
            c.seed,
            c.corpus,
            c.corpus_crc32,
            c.materials,
            c.families,
            c.text_encoder,
        )
    }
}

fn encode(file: &str, value: &impl Serialize) -> Result<String, EvaluateError> {
    let json = serde_json::to_string_pretty(value).map_err(|e| EvaluateError::Encode {
        file: file.into(),
        message: e.to_string(),
    })?;
    Ok(json + "\n")
}

/// `12.3 % (10.1–14.9)`.
fn percent(share: super::statistics::Share) -> String {
    let scaled = |x: f64| 100.0 * x;
    format!(
        "{:.1} % ({:.1}–{:.1})",
        scaled(share.share),
        scaled(share.low),
        scaled(share.high)
    )
}

/// A row of a table.
fn row(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}

/// The head of a table: the first column left, the others right.
fn table(titles: &[&str]) -> String {
    let rules: Vec<&str> = (0..titles.len())
        .map(|column| if column == 0 { "---" } else { "---:" })
        .collect();
    format!("| {} |\n|{}|\n", titles.join(" | "), rules.join("|"))
}
