//! Part 3: textures of materials that no fold was trained on.
//!
//! Two ways to hold out: single materials, spread over the families, and whole families,
//! whose captions calibrate how certain a prompt is by how near it lies to the training.

pub(super) mod completion;
mod errors;
mod fold;
mod lexicon;
mod split;
mod summary;

pub(super) use completion::{Completed, Completion};
pub(super) use errors::Predictor;
pub(super) use lexicon::SAME;
pub(super) use summary::Folds;

use super::{EvaluateError, Watch, cache, cache::Cache, signature::Signature};
use crate::{captions::Captions, certainty::certainty_curve, config::Config};
use asperity::learned::description::CertaintyCurve;
use asperity_corpus::Corpus;
use fold::Setting;
use serde::{Deserialize, Serialize};

/// Part 3.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeldOut {
    /// Configuration of the folds, as TOML.
    pub config: String,
    /// Epochs of their first stage.
    pub epochs: usize,
    /// Materials held out one by one.
    pub materials: Folds,
    /// Whole families held out.
    pub families: Folds,
    /// Certainty by similarity, from held-out families.
    pub certainty: CertaintyCurve,
    /// The same from both ways to hold out, which reaches higher similarities.
    pub certainty_both: CertaintyCurve,
}

/// The configuration of a fold: `epochs` shortens the first stage, and with it the rise
/// of β.
pub(super) fn shortened(mut config: Config, epochs: Option<usize>) -> Config {
    if let Some(epochs) = epochs {
        let scale = |epoch: usize| epoch * epochs / config.optimiser.epochs.max(1);
        config.loss.kl_from_epoch = scale(config.loss.kl_from_epoch);
        config.loss.kl_to_epoch = scale(config.loss.kl_to_epoch);
        config.optimiser.epochs = epochs;
    }
    config
}

/// Inputs of the folds.
pub(super) struct Inputs<'a> {
    pub(super) corpus: &'a Corpus,
    pub(super) captions: &'a Captions,
    pub(super) materials: &'a [usize],
    pub(super) signatures: &'a [Signature],
    pub(super) config: &'a Config,
    pub(super) folds: usize,
}

/// Trains and asks all folds; those in the cache are not trained again. `None` where a
/// fold is neither there nor asked for.
pub(super) fn measure(
    inputs: &Inputs<'_>,
    cache: &Cache,
    asked: bool,
    watch: &mut dyn Watch,
) -> Result<Option<HeldOut>, EvaluateError> {
    let families: Vec<&str> = inputs
        .materials
        .iter()
        .map(|&m| inputs.corpus.materials[m].family.as_str())
        .collect();
    let distinct: std::collections::BTreeSet<&str> = families.iter().copied().collect();
    let folds = inputs.folds;
    if asked && (folds < 2 || folds > distinct.len()) {
        return Err(EvaluateError::Folds {
            folds,
            count: distinct.len(),
            what: "families",
        });
    }
    let config = inputs.config.to_toml()?;
    let setting = Setting {
        corpus: inputs.corpus,
        captions: inputs.captions,
        materials: inputs.materials,
        signatures: inputs.signatures,
        config: inputs.config,
    };
    let mut all = |name: &str, split: Vec<Vec<usize>>| {
        let mut done = Vec::new();
        for (index, held_out) in split.iter().enumerate() {
            let number = index + 1;
            let file = format!("held-out-{name}-{number}-of-{folds}");
            let key = format!("{:08x} {held_out:?}", cache::checksum([config.as_bytes()]));
            let what = format!("without {name} {number}/{folds}");
            let fold = cache.part(&file, &key, asked, || {
                fold::run(&setting, held_out, &what, watch)
            })?;
            match fold {
                Some(fold) => done.push(fold),
                None => return Ok::<_, EvaluateError>(None),
            }
        }
        Ok(Some(Folds::of(name, done)))
    };
    let seed = inputs.config.seed;
    let single = split::stratified(&families, folds.max(1), seed);
    let Some(materials) = all("materials", single)? else {
        return Ok(None);
    };
    let whole = split::whole_families(&families, folds.max(1), seed);
    let Some(families) = all("families", whole)? else {
        return Ok(None);
    };
    let trials: Vec<(f64, f64)> = families.trials().collect();
    let both: Vec<(f64, f64)> = families.trials().chain(materials.trials()).collect();
    Ok(Some(HeldOut {
        config,
        epochs: inputs.config.optimiser.epochs,
        certainty: certainty_curve(&trials),
        certainty_both: certainty_curve(&both),
        materials,
        families,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shortened_recipe_raises_beta_in_proportion() {
        let config = Config::find("reference").unwrap();
        let short = shortened(config.clone(), Some(config.optimiser.epochs / 2));
        assert_eq!(short.optimiser.epochs, config.optimiser.epochs / 2);
        assert_eq!(short.loss.kl_to_epoch, config.loss.kl_to_epoch / 2);
        assert!(short.validate().is_ok());
        assert_eq!(shortened(config.clone(), None), config);
    }
}
