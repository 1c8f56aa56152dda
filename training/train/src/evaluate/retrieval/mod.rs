//! Part 2: whether a caption never trained on finds its material.

mod tfidf;

use super::{
    EvaluateError,
    statistics::{Share, median},
    subject::Subject,
};
use crate::captions::Captions;
use asperity::learned::friction::cosine;
use asperity_corpus::Corpus;
use serde::{Deserialize, Serialize};
pub(super) use tfidf::{TfIdf, Words};

/// Ranks of the right material, by one way of asking.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RetrievalRanks {
    /// Query form.
    pub by: String,
    /// First of all.
    pub top_1: Share,
    /// Among the first five.
    pub top_5: Share,
    /// Mean of 1/rank.
    pub reciprocal_rank: f64,
    /// The middle rank; materials with equal scores share theirs.
    pub median_rank: f64,
}

/// Part 2.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Retrieval {
    /// Materials to choose from.
    pub materials: usize,
    /// Captions asked with.
    pub captions: usize,
    /// By the latent.
    pub latent: RetrievalRanks,
    /// By the network's `similarity` output: the text encoder alone.
    pub similarity: RetrievalRanks,
    /// TF-IDF with all words, and without stop words.
    pub tfidf: [RetrievalRanks; 2],
}

impl Retrieval {
    /// The better of the two TF-IDFs.
    #[must_use]
    pub fn baseline(&self) -> &RetrievalRanks {
        let [all, content] = &self.tfidf;
        if all.top_1.hits > content.top_1.hits {
            all
        } else {
            content
        }
    }
}

/// Asks with every held-out caption of the anchors' materials.
pub(super) fn measure(
    subject: &Subject,
    corpus: &Corpus,
    captions: &Captions,
    materials: &[usize],
) -> Result<Retrieval, EvaluateError> {
    let anchors = &subject.description().anchors;
    let mut own = Vec::new();
    let mut texts = Vec::new();
    let mut vectors = Vec::new();
    for (anchor, &material) in materials.iter().enumerate() {
        for (text, vector) in corpus.materials[material]
            .held_out
            .iter()
            .zip(&captions.held_out[material])
        {
            own.push(anchor);
            texts.push(text.as_str());
            vectors.push(vector.clone());
        }
    }
    let projected = subject.project(&vectors)?;
    let latent = projected.iter().map(|said| {
        let scores = anchors.iter().map(|anchor| cosine(&said.z, &anchor.z));
        scores.collect()
    });
    let similarity = projected
        .iter()
        .map(|said| said.similarity.iter().map(|&s| f64::from(s)).collect());
    let documents: Vec<Vec<&str>> = materials
        .iter()
        .map(|&m| {
            let training = corpus.materials[m].training.iter();
            training.map(|caption| caption.text.as_str()).collect()
        })
        .collect();
    let tfidf = |words, by| {
        let index = TfIdf::new(&documents, words);
        found(by, &own, texts.iter().map(|text| index.scores(text)))
    };
    Ok(Retrieval {
        materials: materials.len(),
        captions: own.len(),
        latent: found("latent z(text)", &own, latent),
        similarity: found("text similarity", &own, similarity),
        tfidf: [
            tfidf(Words::All, "TF-IDF, all words"),
            tfidf(Words::Content, "TF-IDF, no stop words"),
        ],
    })
}

pub(super) fn found(
    by: &str,
    own: &[usize],
    scores: impl Iterator<Item = Vec<f64>>,
) -> RetrievalRanks {
    let ranks: Vec<f64> = scores.zip(own).map(|(s, &own)| rank(&s, own)).collect();
    let reciprocal: f64 = ranks.iter().map(|rank| 1.0 / rank).sum();
    RetrievalRanks {
        by: by.into(),
        top_1: Share::of(ranks.iter().map(|&rank| rank <= 1.0)),
        top_5: Share::of(ranks.iter().map(|&rank| rank <= 5.0)),
        reciprocal_rank: reciprocal / ranks.len().max(1) as f64,
        median_rank: median(&ranks),
    }
}

/// From 1; equal scores share the mean of their ranks.
fn rank(scores: &[f64], own: usize) -> f64 {
    let better = scores.iter().filter(|&&s| s > scores[own]).count();
    let equal = scores.iter().filter(|&&s| s == scores[own]).count();
    better as f64 + 0.5 * (equal as f64 + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_scores_share_a_rank() {
        assert_eq!(rank(&[0.5, 0.9, 0.5, 0.1], 0), 2.5);
        assert_eq!(rank(&[0.0, 0.0, 0.0], 1), 2.0);
        assert_eq!(rank(&[3.0, 1.0], 0), 1.0);
    }
}
