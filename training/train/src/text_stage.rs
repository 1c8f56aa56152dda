//! The second stage: the autoencoder stands, the text projection alone is refitted, on
//! the mean latents of the materials and on a lexicon of rated phrases.

use crate::{
    adam::{Adam, Step},
    batch::add_noise,
    captions::{Captions, cosine, unit},
    config::TextStage,
    material::MaterialLatent,
    network::{Mode, TextProjection, matrix, unit_rows},
    parameters::Parameters,
    progress::Progress,
    rng::{Purpose, Stream},
    vae::learning_rate,
};
use asperity::learned::description::LATENT;
use asperity_corpus::Rating;
use burn_tensor::{Device, activation::log_softmax};

/// The gradient of this small network is clipped here.
const CLIP_NORM: f64 = 1.0;

/// A text vector and where in the latent it belongs.
#[derive(Debug, Clone)]
struct Example {
    vector: Vec<f32>,
    target: [f32; LATENT],
    /// Share of each material in the target.
    shares: Vec<f32>,
    /// How sure the target is, about 1.
    weight: f32,
}

/// What the projection is fitted to; targets are standardised.
pub(crate) struct Examples {
    width: usize,
    captions: Vec<Example>,
    lexicon: Vec<Example>,
    /// Standardised latents of the materials.
    anchors: Vec<[f32; LATENT]>,
    mean: [f32; LATENT],
    deviation: [f32; LATENT],
}

/// A refitted projection.
pub(crate) struct Refitted {
    pub(crate) projection: TextProjection,
    pub(crate) parameters: Parameters,
    /// Loss of each epoch.
    pub(crate) history: Vec<f32>,
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
            shares,
            weight,
        };
        let of_caption = stage.memory.as_ref().map_or(1.0, |how| how.caption_weight);
        let mut of_captions = Vec::new();
        for (index, material) in materials.iter().enumerate() {
            let texts = &captions.training[material.material];
            let names_from = texts.len() - captions.names[material.material];
            for (place, vector) in texts.iter().enumerate() {
                let mut shares = vec![0.0; materials.len()];
                shares[index] = 1.0;
                let is_name = place >= names_from;
                let weight = if is_name { 1.0 } else { of_caption as f32 };
                of_captions.push(example(vector, shares, weight));
            }
        }
        let lexicon = captions
            .lexicon
            .iter()
            .map(|phrase| {
                let shares =
                    phrase_shares(&phrase.vector, &phrase.rating, materials, ratings, stage);
                example(&phrase.vector, shares, phrase.weight)
            })
            .collect();
        Self {
            width: captions.width,
            captions: of_captions,
            lexicon,
            anchors,
            mean,
            deviation,
        }
    }

    /// Vectors, latents and weights, captions first, then phrases.
    pub(crate) fn all(&self) -> (Vec<&[f32]>, Vec<[f32; LATENT]>, Vec<f32>) {
        let all = || self.captions.iter().chain(&self.lexicon);
        let latent = |example: &Example| {
            std::array::from_fn(|k| example.target[k] * self.deviation[k] + self.mean[k])
        };
        (
            all().map(|example| example.vector.as_slice()).collect(),
            all().map(latent).collect(),
            all().map(|example| example.weight).collect(),
        )
    }

    /// An example, perhaps mixed with another, perhaps with noise.
    fn draw(&self, index: usize, stage: &TextStage, stream: &mut Stream) -> Example {
        let mut example = self.pick(index, stage, stream).clone();
        if stream.happens(stage.mixup) {
            let index = stream.below(self.captions.len());
            let other = self.pick(index, stage, stream).clone();
            let share = stream.uniform();
            let blend = |x: &mut [f32], y: &[f32]| {
                x.iter_mut()
                    .zip(y)
                    .for_each(|(x, y)| *x += share * (y - *x));
            };
            blend(&mut example.vector, &other.vector);
            blend(&mut example.target, &other.target);
            blend(&mut example.shares, &other.shares);
            unit(&mut example.vector);
        }
        add_noise(&mut example.vector, stage.noise, stream);
        example
    }

    /// The caption of this index, or a phrase in its place.
    fn pick(&self, index: usize, stage: &TextStage, stream: &mut Stream) -> &Example {
        if !self.lexicon.is_empty() && stream.happens(stage.lexicon_weight) {
            &self.lexicon[stream.below(self.lexicon.len())]
        } else {
            &self.captions[index]
        }
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

/// Fits a projection to the examples.
pub(crate) fn refit(
    examples: &Examples,
    stage: &TextStage,
    seed: u64,
    progress: &mut dyn Progress,
) -> Refitted {
    let mut parameters = Parameters::default();
    let mut stream = Stream::new(seed, Purpose::TextInitialisation, 0);
    let width = examples.width;
    let projection = TextProjection::new(&mut parameters, width, &stage.hidden, &mut stream);
    let mut adam = Adam::new(&parameters);
    let mut history = Vec::with_capacity(stage.epochs);
    for epoch in 0..stage.epochs {
        let mut stream = Stream::new(seed, Purpose::TextEpoch, epoch);
        let mut order: Vec<usize> = (0..examples.captions.len()).collect();
        stream.shuffle(&mut order);
        let done = epoch as f64 / stage.epochs as f64;
        let step = Step {
            learning_rate: learning_rate(stage.learning_rate, Some(0.0), done),
            weight_decay: stage.weight_decay,
            clip_norm: CLIP_NORM,
        };
        let mut mean = 0.0;
        for chosen in order.chunks(stage.batch) {
            let share = chosen.len() as f32 / order.len() as f32;
            let loss = train(
                examples,
                stage,
                chosen,
                &projection,
                &mut parameters,
                &mut adam,
                step,
                &mut stream,
            );
            mean += share * loss;
        }
        history.push(mean);
        progress.text_epoch(epoch + 1, stage.epochs, mean);
    }
    undo_standardisation(examples, &projection, &mut parameters);
    Refitted {
        projection,
        parameters,
        history,
    }
}

#[allow(
    clippy::too_many_arguments,
    reason = "one step of one loop, split out to be read"
)]
fn train(
    examples: &Examples,
    stage: &TextStage,
    chosen: &[usize],
    projection: &TextProjection,
    parameters: &mut Parameters,
    adam: &mut Adam,
    step: Step,
    stream: &mut Stream,
) -> f32 {
    let device = Device::flex().autodiff();
    let drawn: Vec<Example> = chosen
        .iter()
        .map(|&index| examples.draw(index, stage, stream))
        .collect();
    let stack = |part: fn(&Example) -> &[f32]| -> Vec<f32> {
        drawn
            .iter()
            .flat_map(|example| part(example).iter().copied())
            .collect()
    };
    let x = matrix(stack(|e| &e.vector), examples.width, &device);
    let target = matrix(stack(|e| &e.target), LATENT, &device);
    let shares = matrix(stack(|e| &e.shares), examples.anchors.len(), &device);
    let anchors = matrix(examples.anchors.concat(), LATENT, &device);
    let bound = parameters.bind(&device);
    let z = projection.forward(&bound, x, &mut Mode::Train(stream, stage.dropout));
    let distance = (z.clone() - target).square().mean();
    // Cross-entropy of the shares under a softmax over cosines with all materials.
    let cosines = unit_rows(z).matmul(unit_rows(anchors).transpose());
    let picked = log_softmax(cosines / stage.contrastive_temperature, 1);
    let contrastive = (picked * shares).sum() * (-1.0 / chosen.len() as f64);
    let total = distance + contrastive * stage.contrastive_weight;
    let gradients = bound.gradients(total.backward());
    adam.step(parameters, &gradients, step);
    total.inner().into_scalar()
}

/// Lets the last layer answer in the units of the latent.
fn undo_standardisation(
    examples: &Examples,
    projection: &TextProjection,
    parameters: &mut Parameters,
) {
    let Some(last) = projection.layers.last() else {
        return;
    };
    for row in parameters.get_mut(last.weight).values.chunks_mut(LATENT) {
        row.iter_mut()
            .zip(&examples.deviation)
            .for_each(|(x, scale)| *x *= scale);
    }
    let bias = &mut parameters.get_mut(last.bias).values;
    for ((x, scale), mean) in bias.iter_mut().zip(&examples.deviation).zip(&examples.mean) {
        *x = *x * scale + mean;
    }
}
