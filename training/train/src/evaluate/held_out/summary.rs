//! From folds to figures.

use super::{
    errors::{METRICS, NAMES, PREDICTORS, Predictor},
    fold::Fold,
};
use crate::evaluate::{
    signature::Objective,
    statistics::{Share, Spread, mean},
};
use serde::{Deserialize, Serialize};

/// A metric over the folds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Metric {
    /// Its name and unit.
    pub name: String,
    /// Mean and spread over folds of the means over materials, a predictor each.
    pub errors: [Spread; PREDICTORS],
    /// The model's mean over that of the mean texture.
    pub to_mean: f64,
    /// The model's mean over that of the nearest material, by captions alone or by captions and lexicon, whichever
    /// is less off.
    pub to_nearest: f64,
    /// Materials on which the model is better than the mean texture.
    pub better_than_mean: Share,
    /// Materials on which the model is better than the nearest material, the same of the two.
    pub better_than_nearest: Share,
}

/// Rank correlation over the folds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ranks {
    /// The attribute.
    pub attribute: String,
    /// A predictor each; `None` where it says the same of everything.
    pub spearman: [Option<Spread>; PREDICTORS],
}

/// All folds of a way to split.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Folds {
    /// Rule by which materials were held out.
    pub split: String,
    /// Every metric.
    pub metrics: Vec<Metric>,
    /// Every attribute.
    pub ranks: Vec<Ranks>,
    /// Captions whose attributes lie within tolerance, a predictor each.
    pub within: [Share; PREDICTORS],
    /// The folds themselves.
    pub folds: Vec<Fold>,
}

impl Folds {
    pub(super) fn of(split: &str, folds: Vec<Fold>) -> Self {
        let metrics = (0..METRICS).map(|metric| {
            let errors = Predictor::ALL.map(|predictor| {
                let means: Vec<f64> = folds
                    .iter()
                    .map(|fold| {
                        let materials = fold.materials.iter();
                        let values: Vec<f64> = materials
                            .map(|m| m.errors[predictor as usize][metric])
                            .collect();
                        mean(&values)
                    })
                    .collect();
                Spread::of(&means)
            });
            let ratio = |other: Predictor| {
                let below = errors[other as usize].mean;
                if below > 0.0 {
                    errors[0].mean / below
                } else {
                    1.0
                }
            };
            let nearest = [Predictor::Nearest, Predictor::NearestRated]
                .into_iter()
                .min_by(|&a, &b| errors[a as usize].mean.total_cmp(&errors[b as usize].mean))
                .unwrap_or(Predictor::Nearest);
            let better = |other: Predictor| {
                let materials = folds.iter().flat_map(|fold| &fold.materials);
                Share::of(materials.map(|m| m.errors[0][metric] < m.errors[other as usize][metric]))
            };
            Metric {
                name: NAMES[metric].into(),
                errors,
                to_mean: ratio(Predictor::Mean),
                to_nearest: ratio(nearest),
                better_than_mean: better(Predictor::Mean),
                better_than_nearest: better(nearest),
            }
        });
        let ranks = Objective::NAMES
            .iter()
            .enumerate()
            .map(|(attribute, name)| Ranks {
                attribute: (*name).into(),
                spearman: Predictor::ALL.map(|predictor| {
                    let values: Option<Vec<f64>> = folds
                        .iter()
                        .map(|fold| fold.spearman[predictor as usize][attribute])
                        .collect();
                    values.map(|values| Spread::of(&values))
                }),
            });
        let within = Predictor::ALL.map(|predictor| {
            let trials = folds.iter().flat_map(|fold| &fold.trials);
            Share::of(trials.map(|trial| trial.within[predictor as usize]))
        });
        Self {
            split: split.into(),
            metrics: metrics.collect(),
            ranks: ranks.collect(),
            within,
            folds,
        }
    }

    /// Similarity of every held-out caption, and 1 where the model was within tolerance.
    pub(super) fn trials(&self) -> impl Iterator<Item = (f64, f64)> {
        let trials = self.folds.iter().flat_map(|fold| &fold.trials);
        trials.map(|trial| (trial.similarity, f64::from(u8::from(trial.within[0]))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::held_out::{errors::Trial, fold::Material};

    #[test]
    fn ratios_and_shares_are_those_of_the_materials() {
        let material = |text: f64, mean: f64| Material {
            name: "m".into(),
            family: "f".into(),
            errors: [
                [text; METRICS],
                [mean; METRICS],
                [4.0; METRICS],
                [5.0; METRICS],
                [0.0; METRICS],
            ],
        };
        let fold = |materials| Fold {
            training: 2,
            phrases: 0,
            materials,
            spearman: [
                [Some(0.5); 4],
                [None; 4],
                [Some(0.2); 4],
                [Some(0.1); 4],
                [Some(1.0); 4],
            ],
            trials: vec![Trial {
                similarity: 0.3,
                within: [true, false, false, false, true],
            }],
        };
        let folds = Folds::of(
            "x",
            vec![
                fold(vec![material(1.0, 2.0), material(3.0, 2.0)]),
                fold(vec![material(4.0, 8.0)]),
            ],
        );
        let metric = &folds.metrics[0];
        assert_eq!((metric.errors[0].mean, metric.errors[1].mean), (3.0, 5.0));
        assert_eq!((metric.to_mean, metric.to_nearest), (0.6, 0.75));
        assert_eq!(
            (metric.better_than_mean.hits, metric.better_than_mean.of),
            (2, 3)
        );
        assert_eq!(folds.ranks[0].spearman[1], None);
        assert_eq!(folds.within[0].hits, 2);
        assert_eq!(folds.trials().next(), Some((0.3, 1.0)));
    }
}
