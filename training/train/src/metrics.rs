//! Metrics of a model on the materials that it was trained on.

use crate::{
    captions::{Captions, cosine},
    normaliser::{AR, Coded, LSFS, TAP_VALUES},
    progress::EpochLoss,
    trained::{Modalities, Trained},
    words_held_out::{self, WordsHeldOut},
};
use asperity::learned::description::LATENT;
use asperity_corpus::{Corpus, Instance};
use serde::Serialize;

/// A latent unit is active if its posterior mean varies more than this over the instances
/// (Burda et al., "Importance Weighted Autoencoders", 2016).
const ACTIVE_VARIANCE: f64 = 0.01;

/// Measured on the training materials; only `held_out` looks at texts never seen.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Metrics {
    /// Losses of the last epoch.
    pub loss: EpochLoss,
    /// Share of the variance of the normalised LSFs that decoded posterior means explain.
    pub lsf_explained: f64,
    /// The same of the coded excitations.
    pub excitation_explained: f64,
    /// The same of the tap samples.
    pub taps_explained: f64,
    /// Latent units that are used.
    pub active_units: usize,
    /// Finding a material by its training captions.
    pub training: Retrieval,
    /// Finding a material by its held-out captions.
    pub held_out: Retrieval,
    /// Finding a material by its name.
    pub names: Retrieval,
    /// Finding a material by its synonyms, which it was trained on.
    pub synonyms: Retrieval,
    /// Ratings of phrases that were left out, where there is a memory.
    pub words: Option<WordsHeldOut>,
}

/// Hit rates of the material among the anchors nearest to the projected caption.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Retrieval {
    /// Captions.
    pub captions: usize,
    /// Share with the material first.
    pub top_1: f64,
    /// Share with the material among the first five.
    pub top_5: f64,
}

/// Measures a model.
#[must_use]
pub fn measure(trained: &Trained, corpus: &Corpus, captions: &Captions) -> Metrics {
    let instances: Vec<&Instance> = trained
        .materials
        .iter()
        .flat_map(|m| &corpus.materials[m.material].instances)
        .collect();
    let means: Vec<[f32; LATENT]> = trained
        .encode(&instances, Modalities::Both)
        .iter()
        .map(|p| p.mean)
        .collect();
    let decoded = trained.decode(&means);
    let coding = trained.normaliser.coding;
    let coded = |instances: &mut dyn Iterator<Item = &Instance>| {
        let mut coded = Coded::of(coding, instances);
        trained.normaliser.normalise(&mut coded);
        coded
    };
    let (truth, said) = (
        coded(&mut instances.iter().copied()),
        coded(&mut decoded.iter()),
    );
    let ar = explained(&truth.ar, &said.ar, AR);
    let taps = explained(&truth.taps, &said.taps, TAP_VALUES);
    Metrics {
        loss: trained.history.last().copied().unwrap_or_default(),
        lsf_explained: share(&ar[..LSFS]),
        excitation_explained: share(&ar[LSFS..]),
        taps_explained: share(&taps),
        active_units: active_units(&means),
        training: retrieval(trained, &captions.training),
        held_out: retrieval(trained, &captions.held_out),
        names: retrieval(trained, &named(captions, |names| &names[..1])),
        synonyms: retrieval(trained, &named(captions, |names| &names[1..])),
        words: words(trained, corpus, captions),
    }
}

/// Some of the names of each material.
fn named(captions: &Captions, of: fn(&[Vec<f32>]) -> &[Vec<f32>]) -> Vec<Vec<Vec<f32>>> {
    let each = captions.training.iter().zip(&captions.names);
    each.map(|(texts, &names)| of(&texts[texts.len() - names..]).to_vec())
        .collect()
}

fn words(trained: &Trained, corpus: &Corpus, captions: &Captions) -> Option<WordsHeldOut> {
    let memory = trained.memory.as_ref()?;
    let how = &trained.config.text_stage.as_ref()?.memory;
    let materials: Vec<usize> = trained.materials.iter().map(|m| m.material).collect();
    let seed = trained.config.seed;
    Some(words_held_out::measure(
        memory, corpus, &materials, captions, how, seed,
    ))
}

/// Residual and total sum of squares, a column each.
fn explained(truth: &[f32], said: &[f32], columns: usize) -> Vec<(f64, f64)> {
    let rows = (truth.len() / columns) as f64;
    let mut mean = vec![0.0; columns];
    for row in truth.chunks(columns) {
        mean.iter_mut()
            .zip(row)
            .for_each(|(sum, &x)| *sum += f64::from(x) / rows);
    }
    let mut sums = vec![(0.0, 0.0); columns];
    for (truth, said) in truth.chunks(columns).zip(said.chunks(columns)) {
        for (column, (&x, &y)) in truth.iter().zip(said).enumerate() {
            let (x, y) = (f64::from(x), f64::from(y));
            sums[column].0 += (x - y) * (x - y);
            sums[column].1 += (x - mean[column]) * (x - mean[column]);
        }
    }
    sums
}

fn share(sums: &[(f64, f64)]) -> f64 {
    let residual: f64 = sums.iter().map(|sum| sum.0).sum();
    let total: f64 = sums.iter().map(|sum| sum.1).sum();
    if total > 0.0 {
        1.0 - residual / total
    } else {
        0.0
    }
}

/// Latent units whose posterior mean varies.
pub(crate) fn active_units(means: &[[f32; LATENT]]) -> usize {
    let count = means.len().max(1) as f64;
    let active = |unit: usize| {
        let values = means.iter().map(|z| f64::from(z[unit]));
        let mean = values.clone().sum::<f64>() / count;
        values.map(|x| (x - mean) * (x - mean)).sum::<f64>() / count > ACTIVE_VARIANCE
    };
    (0..LATENT).filter(|&unit| active(unit)).count()
}

/// Place of a material among the anchors, by cosine with a latent; 0 is first.
fn place(trained: &Trained, z: &[f32; LATENT], own: usize) -> usize {
    let nearness = cosine(&trained.materials[own].mean, z);
    let nearer = |mean: &[f32; LATENT]| cosine(mean, z) > nearness;
    trained.materials.iter().filter(|m| nearer(&m.mean)).count()
}

fn retrieval(trained: &Trained, captions: &[Vec<Vec<f32>>]) -> Retrieval {
    let places: Vec<usize> = trained
        .materials
        .iter()
        .enumerate()
        .flat_map(|(own, located)| {
            let vectors: Vec<&[f32]> = captions[located.material]
                .iter()
                .map(Vec::as_slice)
                .collect();
            let latents = trained.project(&vectors);
            latents.into_iter().map(move |z| place(trained, &z, own))
        })
        .collect();
    let within = |limit: usize| {
        let hits = places.iter().filter(|&&place| place < limit).count();
        hits as f64 / places.len().max(1) as f64
    };
    Retrieval {
        captions: places.len(),
        top_1: within(1),
        top_5: within(5),
    }
}
