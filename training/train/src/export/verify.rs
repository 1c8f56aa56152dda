//! Verifies that the written networks agree with the trained ones.

use super::{
    ExportError,
    networks::{AR_DECODER, ENCODER, TAP_DECODER, TEXT_PROJECTION},
};
use crate::{
    captions::{Captions, cosine},
    rng::{Purpose, Stream},
    trained::{Modalities, Trained},
};
use asperity::learned::description::LATENT;
use asperity_corpus::{BINS, CHANNELS, Corpus, Instance, TAP_SAMPLES, TAPS};
use asperity_nn::{Portable, Session, Tensor};

/// Largest difference of an output, relative to its largest value or 1: weights are in 16 bits,
/// which rounds each by up to 2⁻¹¹, and a recall multiplies the rounding of a cosine by 1/τ.
const LIMIT: f64 = 1e-3;
/// Materials, captions and latents that are compared.
const SAMPLES: usize = 24;

/// Runs every written network and compares.
pub(super) fn check(
    trained: &Trained,
    corpus: &Corpus,
    captions: &Captions,
    networks: &[(&'static str, Vec<u8>); 4],
) -> Result<(), ExportError> {
    let run = |file: &'static str, inputs: &[(&str, &Tensor)]| {
        let (_, bytes) =
            networks
                .iter()
                .find(|(name, _)| *name == file)
                .ok_or(ExportError::Encode {
                    file,
                    message: "was not written".into(),
                })?;
        let portable =
            Portable::from_bytes(bytes).map_err(|source| ExportError::Graph { file, source })?;
        portable
            .run(inputs)
            .map_err(|source| ExportError::Run { file, source })
    };
    let materials = &trained.materials[..trained.materials.len().min(SAMPLES)];
    let mut stream = Stream::new(trained.config.seed, Purpose::Verification, 0);
    let mut latents: Vec<[f32; LATENT]> = materials.iter().map(|m| m.mean).collect();
    // Far from anything trained, where the bounds work.
    for scale in [1.0, 3.0, 30.0] {
        latents.push(std::array::from_fn(|_| scale * stream.normal()));
    }
    let z = Tensor::f32(&[latents.len(), LATENT], latents.concat());
    let decoded = trained.decode(&latents);
    let ar = run(AR_DECODER, &[("z", &z)])?;
    let flat = |of: fn(&Instance) -> Vec<f32>| decoded.iter().flat_map(of).collect::<Vec<_>>();
    compare(AR_DECODER, &ar, "lsf_rad", &flat(|i| i.lsf_rad.concat()))?;
    compare(AR_DECODER, &ar, "level_db", &flat(|i| i.level_db.to_vec()))?;
    let taps = run(TAP_DECODER, &[("z", &z)])?;
    compare(
        TAP_DECODER,
        &taps,
        "taps_m_s2",
        &flat(|i| i.taps_m_s2.concat()),
    )?;

    let vectors: Vec<&[f32]> = materials
        .iter()
        .filter_map(|m| captions.training[m.material].first().map(Vec::as_slice))
        .collect();
    let embedding = Tensor::f32(&[vectors.len(), trained.width], vectors.concat());
    let text = run(TEXT_PROJECTION, &[("embedding", &embedding)])?;
    compare(
        TEXT_PROJECTION,
        &text,
        "z",
        &trained.project(&vectors).concat(),
    )?;
    let felt = trained.feel(&vectors);
    if !felt.is_empty() {
        compare(TEXT_PROJECTION, &text, "felt", felt.as_flattened())?;
    }
    let cosines = vectors
        .iter()
        .flat_map(|vector| trained.materials.iter().map(|m| cosine(vector, &m.caption)));
    compare(
        TEXT_PROJECTION,
        &text,
        "similarity",
        &cosines.collect::<Vec<_>>(),
    )?;

    let instances: Vec<&Instance> = materials
        .iter()
        .map(|m| &corpus.materials[m.material].prototype)
        .collect();
    let count = instances.len();
    let ar = instances.iter().flat_map(|instance| {
        let bins = instance.lsf_rad.iter().zip(instance.level_db);
        bins.flat_map(|(lsf_rad, level_db)| lsf_rad.iter().copied().chain([level_db]))
    });
    let ar = Tensor::f32(&[count, BINS, CHANNELS], ar.collect());
    let taps = instances
        .iter()
        .flat_map(|i| i.taps_m_s2.concat())
        .collect();
    let taps = Tensor::f32(&[count, TAPS, TAP_SAMPLES], taps);
    for (modalities, present) in [
        (Modalities::Both, [1.0, 1.0]),
        (Modalities::Ar, [1.0, 0.0]),
        (Modalities::Taps, [0.0, 1.0]),
    ] {
        let present = Tensor::f32(&[count, 2], present.repeat(count));
        let inputs = [("ar", &ar), ("taps_m_s2", &taps), ("present", &present)];
        let said = run(ENCODER, &inputs)?;
        let posteriors = trained.encode(&instances, modalities);
        let means: Vec<f32> = posteriors.iter().flat_map(|p| p.mean).collect();
        let log_variances: Vec<f32> = posteriors.iter().flat_map(|p| p.log_variance).collect();
        compare(ENCODER, &said, "mean", &means)?;
        compare(ENCODER, &said, "log_variance", &log_variances)?;
    }
    Ok(())
}

fn compare(
    file: &'static str,
    said: &[(String, Tensor)],
    output: &'static str,
    expected: &[f32],
) -> Result<(), ExportError> {
    let found = said.iter().find(|(name, _)| name == output);
    let found = found
        .and_then(|(_, tensor)| tensor.as_f32())
        .unwrap_or_default();
    let scale = expected
        .iter()
        .fold(1.0_f64, |scale, &x| scale.max(f64::from(x.abs())));
    let mut difference = if found.len() == expected.len() {
        0.0
    } else {
        f64::INFINITY
    };
    for (x, y) in found.iter().zip(expected) {
        let apart = f64::from((x - y).abs()) / scale;
        // A NaN on either side is an infinite difference.
        difference = if apart <= difference {
            difference
        } else {
            apart
        };
        if apart.is_nan() {
            difference = f64::INFINITY;
            break;
        }
    }
    if difference <= LIMIT {
        return Ok(());
    }
    Err(ExportError::Disagreement {
        file,
        output,
        difference,
        limit: LIMIT,
    })
}
