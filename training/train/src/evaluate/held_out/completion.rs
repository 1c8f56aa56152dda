//! Part 8: what was not recorded, completed by the latent of what was.
//!
//! Each fold trains the first stage without a part of the materials. Those are encoded from their
//! AR models alone, or from their traces alone, and what was withheld is decoded.

use super::{
    Inputs,
    errors::{METRICS, NAMES, errors},
    fold::{Setting, mean_texture, train},
    split,
};
use crate::{
    attributes::Layout,
    config::Config,
    evaluate::{
        EvaluateError, Watch, cache,
        cache::Cache,
        signature::{Distance, Signature},
        statistics::{Share, Spread, mean},
    },
    trained::{Modalities, Trained},
};
use serde::{Deserialize, Serialize};

/// Who completes a material.
const PREDICTORS: usize = 4;
/// The model, from what was given.
const COMPLETED: usize = 0;
/// The mean texture of the training materials.
const MEAN: usize = 1;
/// The training material that is nearest in what was given.
const NEAREST: usize = 2;
/// The model, from both: what the decoder alone costs.
const BOTH: usize = 3;

/// The given modality.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Given {
    Ar,
    Taps,
}

impl Given {
    const ALL: [Self; 2] = [Self::Ar, Self::Taps];

    fn name(self) -> &'static str {
        match self {
            Self::Ar => "taps from AR models",
            Self::Taps => "AR models from taps",
        }
    }

    fn modalities(self) -> Modalities {
        match self {
            Self::Ar => Modalities::Ar,
            Self::Taps => Modalities::Taps,
        }
    }

    /// Which of [`NAMES`] tell of what is withheld.
    fn withheld(self) -> &'static [usize] {
        match self {
            Self::Ar => &[3, 4, 8],
            Self::Taps => &[0, 1, 2, 5, 6],
        }
    }

    /// Returns the distance of two materials in the given modality.
    fn distance(self, distance: &Distance) -> f64 {
        match self {
            Self::Ar => distance.spectrum_db,
            Self::Taps => distance.taps_db,
        }
    }
}

/// A metric of what was withheld.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Completed {
    /// Its name and unit.
    pub name: String,
    /// Mean and spread over folds of the means over materials: completed, mean texture, nearest
    /// in what was given, encoded from both.
    pub errors: [Spread; PREDICTORS],
    /// Materials on which completion is better than the mean texture.
    pub better_than_mean: Share,
    /// Materials on which completion is better than the nearest material.
    pub better_than_nearest: Share,
}

/// A way to complete.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Direction {
    /// Name of the completed modality, and of the given one.
    pub name: String,
    /// Every metric.
    pub metrics: Vec<Completed>,
}

/// Part 8.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Completion {
    /// Materials, each held out once.
    pub materials: usize,
    /// Folds that they are held out in.
    pub folds: usize,
    /// Epochs of a fold's first stage.
    pub epochs: usize,
    /// Share of training instances of which one half is withheld.
    pub modality_dropout: f64,
    /// Both ways.
    pub directions: Vec<Direction>,
}

/// Errors of a fold's materials: a direction, a material, a predictor, one of [`NAMES`].
type Errors = Vec<Vec<[[f64; METRICS]; PREDICTORS]>>;

/// Trains and asks all folds; those in the cache are not trained again. `None` where a fold is
/// neither there nor asked for.
pub(in crate::evaluate) fn measure(
    inputs: &Inputs<'_>,
    cache: &Cache,
    asked: bool,
    watch: &mut dyn Watch,
) -> Result<Option<Completion>, EvaluateError> {
    // Words have no part in it.
    let mut config: Config = inputs.config.clone();
    config.text_stage = None;
    let setting = Setting {
        corpus: inputs.corpus,
        captions: inputs.captions,
        materials: inputs.materials,
        signatures: inputs.signatures,
        config: &config,
    };
    let families: Vec<&str> = inputs
        .materials
        .iter()
        .map(|&m| inputs.corpus.materials[m].family.as_str())
        .collect();
    let folds = inputs.folds.max(1);
    let toml = config.to_toml()?;
    let mut all = Vec::new();
    for (index, held_out) in split::stratified(&families, folds, config.seed)
        .iter()
        .enumerate()
    {
        let number = index + 1;
        let file = format!("completion-{number}-of-{folds}");
        let key = format!("{:08x} {held_out:?}", cache::checksum([toml.as_bytes()]));
        let what = format!("completion {number}/{folds}");
        let fold = cache.part(&file, &key, asked, || {
            let (trained, positions) = train(&setting, held_out, &what, watch)?;
            Ok(complete(&setting, &trained, &positions, held_out))
        })?;
        match fold {
            Some(fold) => all.push(fold),
            None => return Ok(None),
        }
    }
    Ok(Some(Completion {
        materials: inputs.materials.len(),
        folds,
        epochs: config.optimiser.epochs,
        modality_dropout: config.augmentation.modality_dropout,
        directions: summary(&all),
    }))
}

fn complete(
    setting: &Setting<'_>,
    trained: &Trained,
    positions: &[usize],
    held_out: &[usize],
) -> Errors {
    let corpus = setting.corpus;
    let training: Vec<usize> = positions.iter().map(|&p| setting.materials[p]).collect();
    let mean = mean_texture(corpus, &training);
    let layout = Layout::of(corpus);
    let prototypes: Vec<_> = held_out
        .iter()
        .map(|&p| &corpus.materials[setting.materials[p]].prototype)
        .collect();
    let decoded = |modalities: Modalities| -> Vec<Signature> {
        let posteriors = trained.encode(&prototypes, modalities);
        let latents: Vec<_> = posteriors.into_iter().map(|p| p.mean).collect();
        let instances = trained.decode(&latents);
        let pairs = instances.iter().zip(held_out);
        pairs
            .map(|(instance, &p)| {
                let mu = setting.signatures[p].objective.mu;
                Signature::of(instance, &layout, mu)
            })
            .collect()
    };
    let both = decoded(Modalities::Both);
    Given::ALL
        .iter()
        .map(|given| {
            let completed = decoded(given.modalities());
            let rows = held_out.iter().zip(completed.iter().zip(&both));
            rows.map(|(&p, (completed, both))| {
                let truth = &setting.signatures[p];
                let apart = |q: usize| given.distance(&setting.signatures[q].distance(truth));
                let nearest = positions
                    .iter()
                    .min_by(|&&a, &&b| apart(a).total_cmp(&apart(b)));
                let nearest = nearest.map_or(&mean, |&q| &setting.signatures[q]);
                [completed, &mean, nearest, both].map(|said| errors(said, truth))
            })
            .collect()
        })
        .collect()
}

fn summary(folds: &[Errors]) -> Vec<Direction> {
    let ways = Given::ALL.iter().enumerate();
    ways.map(|(way, given)| Direction {
        name: given.name().into(),
        metrics: given
            .withheld()
            .iter()
            .map(|&metric| completed(folds, way, metric))
            .collect(),
    })
    .collect()
}

fn completed(folds: &[Errors], way: usize, metric: usize) -> Completed {
    let errors = std::array::from_fn(|predictor| {
        let means: Vec<f64> = folds
            .iter()
            .map(|fold| {
                let values = fold[way].iter().map(|m| m[predictor][metric]);
                mean(&values.collect::<Vec<_>>())
            })
            .collect();
        Spread::of(&means)
    });
    let better = |other: usize| {
        let materials = folds.iter().flat_map(|fold| &fold[way]);
        Share::of(materials.map(|m| m[COMPLETED][metric] < m[other][metric]))
    };
    Completed {
        name: NAMES[metric].into(),
        errors,
        better_than_mean: better(MEAN),
        better_than_nearest: better(NEAREST),
    }
}

impl Completed {
    /// Mean errors: completed, mean texture, nearest, encoded from both.
    #[must_use]
    pub fn means(&self) -> [f64; PREDICTORS] {
        [COMPLETED, MEAN, NEAREST, BOTH].map(|p| self.errors[p].mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_metrics_of_a_way_are_of_what_is_withheld() {
        let of_taps = |metric: &usize| {
            ["tap", "rate", "hard"]
                .iter()
                .any(|word| NAMES[*metric].starts_with(word))
        };
        assert!(Given::Ar.withheld().iter().all(of_taps));
        assert!(!Given::Taps.withheld().iter().any(of_taps));
        let material = |x: f64, y: f64| [x, y, 2.0, 0.0].map(|error| [error; METRICS]);
        let fold = vec![
            vec![material(1.0, 3.0), material(3.0, 1.0)],
            vec![material(1.0, 5.0); 2],
        ];
        let found = summary(&[fold]);
        assert_eq!(found[0].metrics[0].means(), [2.0, 2.0, 2.0, 0.0]);
        assert_eq!(found[0].metrics[0].better_than_mean.hits, 1);
        assert_eq!(found[1].metrics[0].means(), [1.0, 5.0, 2.0, 0.0]);
    }
}
