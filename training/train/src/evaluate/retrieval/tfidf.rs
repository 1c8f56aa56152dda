//! The baseline of retrieval: shared words, weighted by how rare they are.

use asperity_corpus::reference::check::{is_stop_word, words};
use std::collections::{BTreeMap, BTreeSet};

/// Which words count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::evaluate) enum Words {
    /// All of them.
    All,
    /// Those of three letters or more that are no English stop words.
    Content,
    /// In their place, runs of three characters of each, a space at either end.
    Trigrams,
}

/// A document a material, of its training captions: tf = 1 + ln n, idf = ln((1 + N)/(1 + df))
/// + 1, unit length.
pub(in crate::evaluate) struct TfIdf {
    kept: Words,
    idf: BTreeMap<String, f64>,
    documents: Vec<BTreeMap<String, f64>>,
}

impl TfIdf {
    pub(in crate::evaluate) fn new(documents: &[Vec<&str>], kept: Words) -> Self {
        let counted: Vec<BTreeMap<String, f64>> =
            documents.iter().map(|texts| count(texts, kept)).collect();
        let mut frequency: BTreeMap<String, f64> = BTreeMap::new();
        for word in counted.iter().flat_map(|counts| counts.keys()) {
            *frequency.entry(word.clone()).or_default() += 1.0;
        }
        let total = documents.len() as f64;
        let idf = frequency
            .into_iter()
            .map(|(word, df)| (word, libm::log((1.0 + total) / (1.0 + df)) + 1.0))
            .collect();
        let documents = counted.iter().map(|counts| weigh(counts, &idf)).collect();
        Self {
            kept,
            idf,
            documents,
        }
    }

    /// Cosine of a text with every document.
    pub(in crate::evaluate) fn scores(&self, text: &str) -> Vec<f64> {
        let asked = weigh(&count(&[text], self.kept), &self.idf);
        let score = |document: &BTreeMap<String, f64>| -> f64 {
            let shared = asked
                .iter()
                .filter_map(|(word, x)| document.get(word).map(|y| x * y));
            shared.sum()
        };
        self.documents.iter().map(score).collect()
    }
}

fn count(texts: &[&str], kept: Words) -> BTreeMap<String, f64> {
    let mut counts = BTreeMap::new();
    for word in texts.iter().flat_map(|text| words(text)) {
        match kept {
            Words::Content if is_stop_word(&word) => {}
            Words::All | Words::Content => *counts.entry(word).or_default() += 1.0,
            Words::Trigrams => {
                let padded: Vec<char> = format!(" {word} ").chars().collect();
                for run in padded.windows(3) {
                    *counts.entry(run.iter().collect()).or_default() += 1.0;
                }
            }
        }
    }
    counts
}

/// Unit vector of weights; words that no document holds do not count.
fn weigh(counts: &BTreeMap<String, f64>, idf: &BTreeMap<String, f64>) -> BTreeMap<String, f64> {
    let known: BTreeSet<&String> = counts
        .keys()
        .filter(|word| idf.contains_key(*word))
        .collect();
    let weight = |word: &String| (1.0 + libm::log(counts[word])) * idf[word];
    let length = known
        .iter()
        .map(|word| weight(word) * weight(word))
        .sum::<f64>();
    let length = length.sqrt();
    known
        .into_iter()
        .map(|word| (word.clone(), weight(word) / length))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rare_word_weighs_more_than_a_common_one() {
        let documents = [
            vec!["the rough brick"],
            vec!["the rough felt"],
            vec!["the ice"],
        ];
        let index = TfIdf::new(&documents, Words::All);
        let scores = index.scores("the brick");
        assert!(scores[0] > scores[1] && scores[0] > scores[2]);
        assert_eq!(index.scores("unheard"), [0.0; 3]);
        let itself = index.scores("the rough brick")[0];
        assert!((itself - 1.0).abs() < 1e-12);
    }

    #[test]
    fn runs_of_characters_see_what_words_do_not() {
        let documents = [vec!["sandpaper"], vec!["velvet"]];
        let of = |terms| TfIdf::new(&documents, terms).scores("sandpapers");
        assert_eq!(of(Words::All), [0.0; 2]);
        let [same, other] = of(Words::Trigrams)[..] else {
            panic!("two documents");
        };
        assert!(same > 0.8 && other == 0.0, "{same} {other}");
    }

    #[test]
    fn stop_words_alone_find_nothing() {
        let documents = [vec!["the rough brick"], vec!["the soft felt"]];
        let index = TfIdf::new(&documents, Words::Content);
        assert_eq!(index.scores("the"), [0.0; 2]);
    }
}
