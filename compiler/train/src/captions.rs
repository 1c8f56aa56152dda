//! The vectors of a corpus's texts: encoded once, used by every fold.

use crate::error::FitError;
use asperity::text::TextEncoder;
use asperity_corpus::{Corpus, Rating, reference::LexiconEntry};
use rayon::prelude::*;

/// Unit vectors of all captions and of the lexicon.
#[derive(Debug, Clone, PartialEq)]
pub struct Captions {
    /// What the encoder calls itself.
    pub encoder: String,
    /// Width of the vectors.
    pub width: usize,
    /// Training captions of each material of the corpus.
    pub training: Vec<Vec<Vec<f32>>>,
    /// Held-out captions of each material.
    pub held_out: Vec<Vec<Vec<f32>>>,
    /// Phrases of the lexicon with their ratings.
    pub lexicon: Vec<(Vec<f32>, Rating)>,
}

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
            let captions = material.training.iter();
            captions.map(|caption| vector(&caption.text)).collect()
        });
        let held_out = corpus
            .materials
            .par_iter()
            .map(|material| material.held_out.iter().map(|text| vector(text)).collect());
        let lexicon = lexicon
            .par_iter()
            .map(|entry| Ok((vector(&entry.text)?, entry.rating)));
        Ok(Self {
            encoder: encoder.name().to_owned(),
            width: encoder.width(),
            training: training.collect::<Result<_, _>>()?,
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
    let encoded = encoder.encode(text).map_err(|source| FitError::Caption {
        caption: text.to_owned(),
        source,
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
