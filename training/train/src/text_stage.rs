//! The second stage: the autoencoder stands, and texts are placed on the mean latents of the
//! materials, by captions and by a lexicon of rated phrases.

use crate::{
    captions::{Captions, cosine},
    config::TextStage,
    material::MaterialLatent,
};
use asperity::learned::description::LATENT;
use asperity_corpus::Rating;

/// A text vector and where in the latent it belongs.
#[derive(Debug, Clone)]
struct Example {
    vector: Vec<f32>,
    target: [f32; LATENT],
    /// Certainty of the target, about 1.
    weight: f32,
}

/// Examples for fitting the memory, captions first, then phrases; targets are standardised.
pub(crate) struct Examples {
    all: Vec<Example>,
    mean: [f32; LATENT],
    deviation: [f32; LATENT],
}

impl Examples {
    /// Captions with their materials' latents; phrases with weighted means of latents,
    /// so that every target lies among real materials.
    pub(crate) fn new(
        materials: &[MaterialLatent],
        ratings: &[Option<Rating>],
        captions: &Captions,
        stage: &TextStage,
    ) -> Self {
        let (mean, deviation) = moments(materials);
        let standardise = |z: &[f32; LATENT]| -> [f32; LATENT] {
            std::array::from_fn(|i| (z[i] - mean[i]) / deviation[i])
        };
        let anchors: Vec<_> = materials.iter().map(|m| standardise(&m.mean)).collect();
        let example = |vector: &Vec<f32>, shares: Vec<f32>, weight: f32| Example {
            vector: vector.clone(),
            target: mixture(&anchors, &shares),
            weight,
        };
        let mut all = Vec::new();
        for (index, material) in materials.iter().enumerate() {
            let texts = &captions.training[material.material];
            let names_from = texts.len() - captions.names[material.material];
            for (place, vector) in texts.iter().enumerate() {
                let mut shares = vec![0.0; materials.len()];
                shares[index] = 1.0;
                let is_name = place >= names_from;
                let weight = if is_name {
                    1.0
                } else {
                    stage.memory.caption_weight as f32
                };
                all.push(example(vector, shares, weight));
            }
        }
        all.extend(captions.lexicon.iter().map(|phrase| {
            let shares = phrase_shares(&phrase.vector, &phrase.rating, materials, ratings, stage);
            example(&phrase.vector, shares, phrase.weight)
        }));
        Self {
            all,
            mean,
            deviation,
        }
    }

    /// Vectors, latents and weights, captions first, then phrases.
    pub(crate) fn all(&self) -> (Vec<&[f32]>, Vec<[f32; LATENT]>, Vec<f32>) {
        let all = || self.all.iter();
        let latent = |example: &Example| {
            std::array::from_fn(|k| example.target[k] * self.deviation[k] + self.mean[k])
        };
        (
            all().map(|example| example.vector.as_slice()).collect(),
            all().map(latent).collect(),
            all().map(|example| example.weight).collect(),
        )
    }
}

/// `w_i ∝ exp(cos(e, c_i)/τ − ‖r − r_i‖²/2h²)`, over rated materials; by meaning alone
/// where none is rated.
fn phrase_shares(
    vector: &[f32],
    rating: &Rating,
    materials: &[MaterialLatent],
    ratings: &[Option<Rating>],
    stage: &TextStage,
) -> Vec<f32> {
    let any_rated = ratings.iter().any(Option::is_some);
    let logits: Vec<f64> = materials
        .iter()
        .zip(ratings)
        .map(|(material, rated)| {
            let meaning = f64::from(cosine(vector, &material.caption)) / stage.lexicon_temperature;
            match rated {
                Some(rated) => {
                    meaning
                        - square_distance(rating, rated)
                            / (2.0 * stage.lexicon_bandwidth * stage.lexicon_bandwidth)
                }
                None if any_rated => f64::NEG_INFINITY,
                None => meaning,
            }
        })
        .collect();
    let most = logits.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let weights: Vec<f64> = logits.iter().map(|x| libm::exp(x - most)).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|w| (w / sum) as f32).collect()
}

fn square_distance(x: &Rating, y: &Rating) -> f64 {
    let square = |d: f64| d * d;
    square(x.rough - y.rough) + square(x.slippery - y.slippery) + square(x.hard - y.hard)
}

fn mixture(anchors: &[[f32; LATENT]], shares: &[f32]) -> [f32; LATENT] {
    let mut mixed = [0.0; LATENT];
    for (anchor, share) in anchors.iter().zip(shares) {
        for (sum, x) in mixed.iter_mut().zip(anchor) {
            *sum += share * x;
        }
    }
    mixed
}

/// Mean of the latents, and one deviation for all of them: directions that the latent
/// does not use stay small.
fn moments(materials: &[MaterialLatent]) -> ([f32; LATENT], [f32; LATENT]) {
    let count = materials.len() as f32;
    let mut mean = [0.0; LATENT];
    for material in materials {
        for (sum, x) in mean.iter_mut().zip(&material.mean) {
            *sum += x / count;
        }
    }
    let squares = materials.iter().flat_map(|m| m.mean.iter().zip(&mean));
    let square: f32 = squares.map(|(x, mean)| (x - mean) * (x - mean)).sum();
    let deviation = (square / (count * LATENT as f32)).sqrt().max(1e-6);
    (mean, [deviation; LATENT])
}
