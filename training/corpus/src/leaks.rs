//! Leakage: evaluation texts that the model was trained on.
//!
//! Texts are compared by the stems of their words (Porter's second algorithm), without articles and in any order, and by
//! pairs of stems that stand side by side. Everything counts that any stage of training saw: captions, names,
//! synonyms, and the phrases of the lexicon with their ratings.

use crate::{
    Corpus,
    reference::{LexiconEntry, check::words},
};
use rust_stemmers::{Algorithm, Stemmer};
use std::{collections::HashSet, fmt};

/// Words that by themselves do not describe a material.
const EMPTY: [&str; 20] = [
    "a", "an", "the", "of", "some", "piece", "plain", "in", "on", "with", "and", "for", "to", "at",
    "by", "from", "is", "that", "s", "it",
];

/// All that was trained on.
pub struct TrainingTexts {
    stemmer: Stemmer,
    /// Each text as its words.
    verbatim: HashSet<Vec<String>>,
    /// Those of two meaning words or more.
    phrases: HashSet<Vec<String>>,
    texts: HashSet<Vec<String>>,
    pairs: HashSet<[String; 2]>,
}

impl fmt::Debug for TrainingTexts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} texts, {} pairs", self.texts.len(), self.pairs.len())
    }
}

impl TrainingTexts {
    /// The texts of a corpus and of the lexicon beside it.
    #[must_use]
    pub fn of(corpus: &Corpus, lexicon: &[LexiconEntry]) -> Self {
        let captions = corpus
            .materials
            .iter()
            .flat_map(|m| m.training.iter().map(|caption| &caption.text));
        let names = corpus
            .materials
            .iter()
            .flat_map(|m| m.synonyms.iter().chain([&m.name]));
        let phrases = lexicon.iter().map(|entry| &entry.text);
        Self::new(captions.chain(names).chain(phrases).map(String::as_str))
    }

    /// Those of a list.
    pub fn new<'a>(texts: impl IntoIterator<Item = &'a str>) -> Self {
        let mut all = Self {
            stemmer: Stemmer::create(Algorithm::English),
            verbatim: HashSet::new(),
            phrases: HashSet::new(),
            texts: HashSet::new(),
            pairs: HashSet::new(),
        };
        for text in texts {
            let mut stems = all.stems(text);
            if stems.len() > 1 {
                all.phrases.insert(words(text));
            }
            all.verbatim.insert(words(text));
            all.pairs.extend(pairs(&stems));
            stems.sort_unstable();
            all.texts.insert(stems);
        }
        all
    }

    /// Returns true if the text is among them, whatever its articles, endings and order.
    #[must_use]
    pub fn hold(&self, text: &str) -> bool {
        let mut stems = self.stems(text);
        stems.sort_unstable();
        self.texts.contains(&stems)
    }

    /// Returns true if the text is among them, word for word.
    #[must_use]
    pub fn hold_verbatim(&self, text: &str) -> bool {
        self.verbatim.contains(&words(text))
    }

    /// Returns true if a training text of at least two meaningful words occurs in the text word for word, or such a
    /// text in a training text.
    #[must_use]
    pub fn share_a_phrase_with(&self, text: &str) -> bool {
        let its_words = words(text);
        let holds = (1..=its_words.len()).any(|length| {
            its_words
                .windows(length)
                .any(|part| self.phrases.contains(part))
        });
        let mut all = self.verbatim.iter();
        let within =
            |outer: &Vec<String>| outer.windows(its_words.len()).any(|part| part == its_words);
        holds || self.stems(text).len() > 1 && all.any(within)
    }

    /// Returns true if two meaningful words adjacent in the text are also adjacent in a training text.
    #[must_use]
    pub fn share_a_pair_with(&self, text: &str) -> bool {
        pairs(&self.stems(text)).any(|pair| self.pairs.contains(&pair))
    }

    fn stems(&self, text: &str) -> Vec<String> {
        let words = words(text).into_iter();
        let kept = words.filter(|word| !EMPTY.contains(&word.as_str()));
        kept.map(|word| self.stemmer.stem(&word).into_owned())
            .collect()
    }
}

fn pairs(stems: &[String]) -> impl Iterator<Item = [String; 2]> {
    stems
        .windows(2)
        .map(|pair| [pair[0].clone(), pair[1].clone()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_found_in_another_number_article_and_order() {
        let trained = TrainingTexts::new(["a ball bearing", "hard cheese", "rough piece of felt"]);
        for text in [
            "Ball bearings",
            "the hard cheeses",
            "felt, roughly",
            "bearing ball",
        ] {
            assert!(trained.hold(text), "{text}");
        }
        assert!(!trained.hold("ball bearings in grease") && !trained.hold("cheese"));
        assert!(trained.share_a_pair_with("ball bearings in grease"));
        assert!(!trained.share_a_pair_with("a bearing with a ball"));
        assert!(trained.share_a_phrase_with("very hard cheese"));
        assert!(!trained.share_a_phrase_with("hard cheeses"));
        assert!(trained.hold_verbatim("Hard cheese") && !trained.hold_verbatim("the hard cheese"));
    }
}
