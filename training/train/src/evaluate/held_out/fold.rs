//! Runs a fold: trains without some materials, then asks for them by unseen captions.

use super::{
    errors::{METRICS, PREDICTORS, Trial, errors},
    lexicon::{nearest_rating, without},
};
use crate::{
    attributes::Layout,
    captions::{Captions, dot},
    config::Config,
    error::FitError,
    evaluate::{EvaluateError, Watch, signature::Signature, statistics::mean, watch::Training},
    fit::fit_on,
    trained::{Modalities, Trained},
};
use asperity::learned::{
    Latent,
    description::{Anchor, FrictionDescription},
    friction,
};
use asperity::signal::quantile::rank_correlation;
use asperity_corpus::{BINS, Corpus, Instance, ORDER, TAP_SAMPLES, TAPS};
use serde::{Deserialize, Serialize};

/// Errors on one held-out material, means over its captions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Its name.
    pub name: String,
    /// Its family.
    pub family: String,
    /// A row a predictor, a column a metric.
    pub errors: [[f64; METRICS]; PREDICTORS],
}

/// Results of a fold.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fold {
    /// Materials trained on.
    pub training: usize,
    /// Phrases of the lexicon that were left out with the materials.
    pub phrases: usize,
    /// Materials held out.
    pub materials: Vec<Material>,
    /// Rank correlation of predicted and true attributes over captions, a row a
    /// predictor, in the order of `Objective::NAMES`.
    pub spearman: [[Option<f64>; 4]; PREDICTORS],
    /// Every held-out caption.
    pub trials: Vec<Trial>,
}

/// Data shared by all folds.
pub(super) struct Setting<'a> {
    pub(super) corpus: &'a Corpus,
    pub(super) captions: &'a Captions,
    /// Materials of the model under evaluation, and their signatures.
    pub(super) materials: &'a [usize],
    pub(super) signatures: &'a [Signature],
    pub(super) config: &'a Config,
}

/// Trains without the materials at the positions `held_out`, and asks for them.
pub(super) fn run(
    setting: &Setting<'_>,
    held_out: &[usize],
    what: &str,
    watch: &mut dyn Watch,
) -> Result<Fold, EvaluateError> {
    let corpus = setting.corpus;
    let left_out: Vec<usize> = held_out.iter().map(|&p| setting.materials[p]).collect();
    let captions = without(setting.captions, &corpus.materials, &left_out);
    let phrases = setting.captions.lexicon.len() - captions.lexicon.len();
    let setting = &Setting {
        captions: &captions,
        ..*setting
    };
    let (trained, positions) = train(setting, held_out, what, watch)?;
    let training: Vec<usize> = positions.iter().map(|&p| setting.materials[p]).collect();
    let anchors = anchors(&trained, corpus);
    let fold = TrainedFold {
        setting,
        trained: &trained,
        anchors: &anchors,
        mean: mean_texture(corpus, &training),
        positions: &positions,
        phrases,
    };
    Ok(fold.all(held_out))
}

/// Trains without the materials at the positions `held_out`; the positions of the
/// others, in the order of the model's materials.
pub(super) fn train(
    setting: &Setting<'_>,
    held_out: &[usize],
    what: &str,
    watch: &mut dyn Watch,
) -> Result<(Trained, Vec<usize>), EvaluateError> {
    let positions = (0..setting.materials.len()).filter(|p| held_out.binary_search(p).is_err());
    let positions: Vec<usize> = positions.collect();
    let training: Vec<usize> = positions.iter().map(|&p| setting.materials[p]).collect();
    let config = setting.config;
    let text_epochs = config
        .text_stage
        .as_ref()
        .map_or(0, |stage| stage.memory.iterations);
    let epochs = config.optimiser.epochs;
    let mut progress = Training::begin(watch, what, epochs, text_epochs);
    let (corpus, captions) = (setting.corpus, setting.captions);
    let trained = fit_on(corpus, &training, captions, config, &mut progress);
    let trained = trained.map_err(|error| match error {
        FitError::Interrupted { .. } => EvaluateError::Interrupted { what: what.into() },
        other => other.into(),
    })?;
    Ok((trained, positions))
}

/// A trained fold and its baselines.
struct TrainedFold<'a> {
    setting: &'a Setting<'a>,
    trained: &'a Trained,
    anchors: &'a [Anchor],
    mean: Signature,
    /// Positions of the training materials, in the order of the anchors.
    positions: &'a [usize],
    phrases: usize,
}

impl TrainedFold<'_> {
    fn all(&self, held_out: &[usize]) -> Fold {
        let mut materials = Vec::new();
        let mut trials = Vec::new();
        // Predicted values a predictor, and true ones, of every caption.
        let mut said: [Vec<[f64; 4]>; PREDICTORS] = Default::default();
        let mut truth = Vec::new();
        for &position in held_out {
            let index = self.setting.materials[position];
            let material = &self.setting.corpus.materials[index];
            let own = &self.setting.signatures[position];
            let mut sums = [[0.0; METRICS]; PREDICTORS];
            let predicted = self.material(index);
            let count = predicted.len().max(1) as f64;
            for (similarity, predictions) in predicted {
                for (predictor, prediction) in predictions.iter().enumerate() {
                    let found = errors(prediction, own);
                    for (sum, x) in sums[predictor].iter_mut().zip(found) {
                        *sum += x / count;
                    }
                    said[predictor].push(prediction.objective.values());
                }
                truth.push(own.objective.values());
                let objectives = predictions.map(|signature| signature.objective);
                trials.push(Trial::new(similarity, &objectives, &own.objective));
            }
            materials.push(Material {
                name: material.name.clone(),
                family: material.family.clone(),
                errors: sums,
            });
        }
        let spearman = said.map(|said| {
            std::array::from_fn(|attribute| {
                let column = |rows: &[[f64; 4]]| -> Vec<f64> {
                    rows.iter().map(|row| row[attribute]).collect()
                };
                rank_correlation(&column(&said), &column(&truth))
            })
        });
        Fold {
            training: self.positions.len(),
            phrases: self.phrases,
            materials,
            spearman,
            trials,
        }
    }

    /// Predicts a material from each of its held-out captions: the caption's largest cosine with a mean caption of a
    /// training material, and each predictor's signature.
    fn material(&self, index: usize) -> Vec<(f64, [Signature; PREDICTORS])> {
        let Setting {
            corpus, captions, ..
        } = *self.setting;
        let vectors: Vec<&[f32]> = captions.held_out[index].iter().map(Vec::as_slice).collect();
        let latents = self.trained.project(&vectors);
        let prototype = &corpus.materials[index].prototype;
        let own = self.trained.encode(&[prototype], Modalities::Both);
        let own: Vec<Latent> = own.iter().map(|posterior| posterior.mean).collect();
        let own = self.decode(&own);
        let decoded = self.decode(&latents);
        let predictions = vectors.iter().zip(decoded).map(|(vector, text)| {
            let (nearest, similarity) = self.nearest(vector);
            let rated = self.nearest_rated(vector, similarity).unwrap_or(nearest);
            let [nearest, rated] = [nearest, rated]
                .map(|place| self.setting.signatures[self.positions[place]].clone());
            // One latent gives one texture.
            let own = own.first().cloned().unwrap_or_else(|| text.clone());
            (similarity, [text, self.mean.clone(), nearest, rated, own])
        });
        predictions.collect()
    }

    fn nearest(&self, vector: &[f32]) -> (usize, f64) {
        let mut best = (0, f32::NEG_INFINITY);
        for (index, material) in self.trained.materials.iter().enumerate() {
            let similarity = dot(vector, &material.caption);
            if similarity > best.1 {
                best = (index, similarity);
            }
        }
        (best.0, f64::from(best.1))
    }

    /// The training material of the nearest rated phrase, where one is nearer than the nearest mean caption.
    fn nearest_rated(&self, vector: &[f32], nearest_caption: f64) -> Option<usize> {
        let lexicon = self.setting.captions.lexicon.iter();
        let phrases = lexicon.map(|phrase| (phrase, f64::from(dot(vector, &phrase.vector))));
        let (phrase, similarity) = phrases.max_by(|a, b| a.1.total_cmp(&b.1))?;
        if similarity <= nearest_caption {
            return None;
        }
        let ratings = self.positions.iter().map(|&p| {
            let material = self.setting.materials[p];
            self.setting.corpus.materials[material].rating
        });
        nearest_rating(&phrase.rating, ratings)
    }

    fn decode(&self, latents: &[Latent]) -> Vec<Signature> {
        let friction = self.setting.config.friction;
        let how = FrictionDescription {
            top_k: friction.top_k.min(self.anchors.len()),
            temperature: friction.temperature,
        };
        let decoded = self.trained.decode(latents);
        let layout = Layout::of(self.setting.corpus);
        let pairs = latents.iter().zip(&decoded);
        let signatures = pairs.map(|(z, instance)| {
            let near = friction::neighbours(z, self.anchors, how);
            Signature::of(instance, &layout, friction::mu(&near, self.anchors))
        });
        signatures.collect()
    }
}

fn anchors(trained: &Trained, corpus: &Corpus) -> Vec<Anchor> {
    let anchors = trained.materials.iter().map(|located| {
        let material = &corpus.materials[located.material];
        Anchor {
            name: material.name.clone(),
            family: material.family.clone(),
            mu: material.mu,
            stiffness_n_m: material.stiffness_n_m,
            z: located.mean.to_vec(),
        }
    });
    anchors.collect()
}

/// Mean LSFs, levels, samples and friction.
pub(super) fn mean_texture(corpus: &Corpus, training: &[usize]) -> Signature {
    let all = || training.iter().map(|&m| &corpus.materials[m].prototype);
    let share = 1.0 / training.len().max(1) as f64;
    let average = |value: &dyn Fn(&Instance) -> f32| -> f32 {
        (all().map(|i| f64::from(value(i))).sum::<f64>() * share) as f32
    };
    let instance = Instance {
        lsf_rad: std::array::from_fn::<_, BINS, _>(|bin| {
            std::array::from_fn::<_, ORDER, _>(|k| average(&|i| i.lsf_rad[bin][k]))
        }),
        level_db: std::array::from_fn(|bin| average(&|i| i.level_db[bin])),
        taps_m_s2: std::array::from_fn::<_, TAPS, _>(|trace| {
            std::array::from_fn::<_, TAP_SAMPLES, _>(|n| average(&|i| i.taps_m_s2[trace][n]))
        }),
    };
    let mu: Vec<f64> = training.iter().map(|&m| corpus.materials[m].mu).collect();
    Signature::of(&instance, &Layout::of(corpus), mean(&mu))
}
