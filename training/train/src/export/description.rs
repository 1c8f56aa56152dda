//! `model.json`.

use crate::{
    attributes::{self, Layout},
    certainty::certainty_curve,
    metrics::Metrics,
    ridge,
    trained::Trained,
};
use asperity::learned::description::{
    Anchor, AttributeAxis, CorpusDescription, FORMAT, FrictionDescription, ModelDescription,
    TapDescription, TextEncoderDescription,
};
use asperity_corpus::{Corpus, TAP_RATE_HZ, TAP_SAMPLES};

/// Everything about a model that is not a network.
pub(super) fn describe(trained: &Trained, corpus: &Corpus, metrics: &Metrics) -> ModelDescription {
    let config = &trained.config;
    let words = metrics.words.as_ref();
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
    ModelDescription {
        format: FORMAT,
        name: config.name.clone(),
        corpus: CorpusDescription {
            name: corpus.name.clone(),
            licence: corpus.licence.clone(),
            crc32: corpus.crc32,
            taps_synthetic: corpus.taps_synthetic,
        },
        text_encoder: TextEncoderDescription {
            name: trained.encoder.clone(),
            width: trained.width,
        },
        seed: config.seed,
        grid: corpus.grid.description(),
        taps: TapDescription {
            sample_rate_hz: TAP_RATE_HZ,
            speeds_m_s: corpus.tap_speeds_m_s.to_vec(),
            samples: TAP_SAMPLES,
        },
        friction: FrictionDescription {
            top_k: config.friction.top_k.min(trained.materials.len()),
            temperature: config.friction.temperature,
        },
        anchors: anchors.collect(),
        axes: axes(trained, corpus),
        spread: trained.spread.to_vec(),
        certainty: certainty_curve(words.map_or(&[], |words| &words.trials)),
        unfamiliar: words.map_or(0.0, |words| words.unfamiliar),
        same_latent: Vec::new(),
    }
}

/// Lines through the attributes of what the anchors decode to, and through their μ.
fn axes(trained: &Trained, corpus: &Corpus) -> Vec<AttributeAxis> {
    let latents: Vec<_> = trained.materials.iter().map(|m| m.mean).collect();
    let points: Vec<Vec<f64>> = latents
        .iter()
        .map(|z| z.iter().map(|&x| f64::from(x)).collect())
        .collect();
    let layout = Layout::of(corpus);
    let decoded: Vec<_> = trained
        .decode(&latents)
        .iter()
        .map(|instance| attributes::of(instance, &layout))
        .collect();
    let mu = trained
        .materials
        .iter()
        .map(|m| corpus.materials[m.material].mu);
    let values: [(&str, Vec<f64>); 4] = [
        ("rough_db", decoded.iter().map(|a| a.rough_db).collect()),
        ("sharp_hz", decoded.iter().map(|a| a.sharp_hz).collect()),
        ("hard_hz", decoded.iter().map(|a| a.hard_hz).collect()),
        ("mu", mu.collect()),
    ];
    values
        .into_iter()
        .map(|(attribute, values)| {
            let line = ridge::fit(&points, &values);
            AttributeAxis {
                attribute: attribute.to_owned(),
                offset: line.offset,
                direction: line.direction.iter().map(|&x| x as f32).collect(),
                r_squared: line.r_squared,
            }
        })
        .collect()
}
