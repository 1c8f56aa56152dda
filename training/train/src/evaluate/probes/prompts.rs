//! The committed prompts of the evaluation: never trained on.

use crate::evaluate::EvaluateError;
use serde::{Deserialize, Serialize, de::DeserializeOwned};

const PROBES_FILE: &str = "training/corpora/probes.toml";
const PROBES: &str = include_str!("../../../../corpora/probes.toml");
const PAIRS_FILE: &str = "training/corpora/pairs.toml";
const PAIRS: &str = include_str!("../../../../corpora/pairs.toml");

/// An attribute that people name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Attribute {
    /// Objectively `rough_db`.
    Rough,
    /// Objectively −μ.
    Slippery,
    /// Objectively `hard_hz`.
    Hard,
}

impl Attribute {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Rough, Self::Slippery, Self::Hard];

    /// The attribute's name and its objective counterpart.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rough => "rough (rough_db)",
            Self::Slippery => "slippery (−μ)",
            Self::Hard => "hard (hard_hz)",
        }
    }
}

/// Kind of change to a prompt.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ChangeKind {
    /// "not", "without", "no".
    Negation,
    /// "less", "more".
    Comparative,
    /// "very", "slightly".
    Degree,
}

/// Where an attribute should go.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Change {
    /// Up.
    More,
    /// Down.
    Less,
}

/// A prompt, a change of it, and what should follow.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Direction {
    /// The prompt.
    pub from: String,
    /// The prompt, changed.
    pub to: String,
    /// Attribute that should change with it.
    pub attribute: Attribute,
    /// Where to.
    pub change: Change,
    /// Kind of the change.
    pub kind: ChangeKind,
}

/// A material that latents are mixed between, under its names in both corpora.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::evaluate) struct End {
    pub(in crate::evaluate) name: String,
    pub(in crate::evaluate) reference: String,
    pub(in crate::evaluate) hatt: String,
}

/// `probes.toml`.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::evaluate) struct Probes {
    pub(super) paraphrases: Vec<[String; 2]>,
    pub(super) directions: Vec<Direction>,
    /// Each sharper and rougher than the next.
    pub(super) orders: Vec<[String; 3]>,
    pub(in crate::evaluate) ends: Vec<End>,
}

/// `pairs.toml`: the first prompt is rougher, more slippery or harder.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Pairs {
    rough: Vec<[String; 2]>,
    slippery: Vec<[String; 2]>,
    hard: Vec<[String; 2]>,
}

impl Pairs {
    pub(super) fn read() -> Result<Self, EvaluateError> {
        parse(PAIRS_FILE, PAIRS)
    }

    pub(super) fn of(&self, attribute: Attribute) -> &[[String; 2]] {
        match attribute {
            Attribute::Rough => &self.rough,
            Attribute::Slippery => &self.slippery,
            Attribute::Hard => &self.hard,
        }
    }
}

impl Probes {
    pub(in crate::evaluate) fn read() -> Result<Self, EvaluateError> {
        parse(PROBES_FILE, PROBES)
    }

    /// Every prompt, some more than once.
    pub(super) fn prompts(&self) -> impl Iterator<Item = &str> {
        let paraphrases = self.paraphrases.iter().flatten().map(String::as_str);
        let directions = self
            .directions
            .iter()
            .flat_map(|d| [d.from.as_str(), &d.to]);
        let orders = self.orders.iter().flatten().map(String::as_str);
        paraphrases.chain(directions).chain(orders)
    }
}

/// The bytes that a result of this part depends on.
pub(in crate::evaluate) fn sources() -> [&'static [u8]; 2] {
    [PROBES.as_bytes(), PAIRS.as_bytes()]
}

fn parse<T: DeserializeOwned>(file: &'static str, text: &str) -> Result<T, EvaluateError> {
    toml::from_str(text).map_err(|error| EvaluateError::Prompts {
        file,
        message: error.to_string().trim_end().to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_corpus::{
        leaks::TrainingTexts,
        reference::{self, ReferenceOptions},
    };
    use std::collections::BTreeSet;

    #[test]
    fn there_are_enough_probes_and_none_was_trained_on_letter_for_letter() {
        let probes = Probes::read().unwrap();
        assert!(probes.paraphrases.len() + probes.directions.len() >= 60);
        let options = ReferenceOptions {
            instances: 1,
            ..ReferenceOptions::default()
        };
        let (corpus, lexicon) = reference::load(&options).unwrap();
        let captions = corpus.materials.iter().flat_map(|m| &m.training);
        let captions = captions.map(|caption| caption.text.as_str());
        let phrases = lexicon.iter().map(|entry| entry.text.as_str());
        let trained = TrainingTexts::new(captions.chain(phrases));
        let found: Vec<&str> = probes
            .prompts()
            .filter(|prompt| trained.hold_verbatim(prompt))
            .collect();
        assert!(found.is_empty(), "{found:?}");
        for end in &probes.ends {
            assert!(
                corpus.materials.iter().any(|m| m.name == end.reference),
                "{end:?}"
            );
        }
    }

    #[test]
    fn no_probe_appears_twice() {
        let probes = Probes::read().unwrap();
        let mut seen = BTreeSet::new();
        for [a, b] in &probes.paraphrases {
            assert!(seen.insert((a, b)) && a != b);
        }
        for direction in &probes.directions {
            assert!(
                seen.insert((&direction.from, &direction.to)),
                "{direction:?}"
            );
        }
        assert!(Pairs::read().is_ok());
    }
}
