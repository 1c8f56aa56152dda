//! The vectors of a corpus's texts: encoded once, used by every fold.

use crate::error::FitError;
use asperity::learned::text::TextEncoder;
use asperity_corpus::{Corpus, Rating, reference::LexiconEntry};
use rayon::prelude::*;

/// Unit vectors of all captions and of the lexicon.
#[derive(Debug, Clone, PartialEq)]
pub struct Captions {
    /// Name of the encoder.
    pub encoder: String,
    /// Width of the vectors.
    pub width: usize,
    /// Training captions of each material of the corpus, then its name and its synonyms.
    pub training: Vec<Vec<Vec<f32>>>,
    /// Number of names and synonyms, which come last in `training`, per material.
    pub names: Vec<usize>,
    /// Held-out captions of each material.
    pub held_out: Vec<Vec<Vec<f32>>>,
    /// The phrases of the lexicon.
    pub lexicon: Vec<Phrase>,
}

/// A phrase of the lexicon.
#[derive(Debug, Clone, PartialEq)]
pub struct Phrase {
    /// Its words.
    pub text: String,
    /// Its unit vector.
    pub vector: Vec<f32>,
    /// Its rating.
    pub rating: Rating,
    /// Certainty of the rating, relative to the mean of the lexicon; within 0.3..=1.6.
    pub weight: f32,
}

/// Range of a phrase's weight.
const LEAST_WEIGHT: f64 = 0.3;
/// Range of a phrase's weight.
const MOST_WEIGHT: f64 = 1.6;

impl Captions {
    /// Encodes everything, in parallel.
    ///
    /// # Errors
    /// [`FitError::Caption`] for a text without a vector, [`FitError::Width`] for one
    /// whose vector is of another width than the encoder says.
    pub fn encode(
        corpus: &Corpus,
        lexicon: &[LexiconEntry],
        encoder: &dyn TextEncoder,
    ) -> Result<Self, FitError> {
        let vector = |text: &str| vector(encoder, text);
        let training = corpus.materials.par_iter().map(|material| {
            let captions = material.training.iter().map(|caption| &caption.text);
            let names = [&material.name].into_iter().chain(&material.synonyms);
            captions.chain(names).map(|text| vector(text)).collect()
        });
        let held_out = corpus
            .materials
            .par_iter()
            .map(|material| material.held_out.iter().map(|text| vector(text)).collect());
        let mean_sure = lexicon.iter().map(|entry| entry.sure).sum::<f64>();
        let mean_sure = (mean_sure / lexicon.len().max(1) as f64).max(1.0);
        let lexicon = lexicon.par_iter().map(|entry| {
            Ok(Phrase {
                text: entry.text.clone(),
                vector: vector(&entry.text)?,
                rating: entry.rating,
                weight: (entry.sure / mean_sure).clamp(LEAST_WEIGHT, MOST_WEIGHT) as f32,
            })
        });
        Ok(Self {
            encoder: encoder.name().to_owned(),
            width: encoder.width(),
            training: training.collect::<Result<_, _>>()?,
            names: corpus
                .materials
                .iter()
                .map(|m| 1 + m.synonyms.len())
                .collect(),
            held_out: held_out.collect::<Result<_, _>>()?,
            lexicon: lexicon.collect::<Result<_, FitError>>()?,
        })
    }

    /// The normalised mean of a material's training captions.
    #[must_use]
    pub fn mean(&self, material: usize) -> Vec<f32> {
        let mut mean = vec![0.0; self.width];
        for caption in &self.training[material] {
            for (sum, x) in mean.iter_mut().zip(caption) {
                *sum += x;
            }
        }
        unit(&mut mean);
        mean
    }
}

fn vector(encoder: &dyn TextEncoder, text: &str) -> Result<Vec<f32>, FitError> {
    let encoded = encoder.encode(text).map_err(|fault| FitError::Caption {
        caption: text.to_owned(),
        source: fault.into(),
    })?;
    if encoded.vector.len() != encoder.width() {
        return Err(FitError::Width {
            encoder: encoder.name().to_owned(),
            found: encoded.vector.len(),
            expected: encoder.width(),
        });
    }
    Ok(encoded.vector)
}

/// Scales to length one; a null vector stays.
pub(crate) fn unit(x: &mut [f32]) {
    let norm = dot(x, x).sqrt();
    if norm > 0.0 {
        x.iter_mut().for_each(|x| *x /= norm);
    }
}

/// Inner product.
pub(crate) fn dot(x: &[f32], y: &[f32]) -> f32 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// Cosine; zero where one of them is null.
pub(crate) fn cosine(x: &[f32], y: &[f32]) -> f32 {
    let norm = (dot(x, x) * dot(y, y)).sqrt();
    if norm > 0.0 { dot(x, y) / norm } else { 0.0 }
}
