//! Cost of a texture at each fidelity, and the fidelities worth considering.

use super::{
    cost::{Surfaces, zeros},
    target::Target,
};
use crate::{
    emit::{raise::raise, verify::VerifyError},
    passes::reduce::{Fidelity, Reference},
    pipeline::{Pass, Pipeline, PipelineError},
};
use asperity_formats::Asset;
use asperity_texture::model::TextureModel;
use rayon::prelude::*;

/// A texture at a fidelity.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    /// `full`, `auto`, an order, or `auto` with a lower order.
    pub(super) fidelity: String,
    pub(super) texture: TextureModel,
    /// The asset.
    pub(super) bytes: Vec<u8>,
    /// Executed instructions a tick.
    pub(super) instructions: u64,
    /// Largest spectral distance from the whole texture, dB.
    pub(super) error_db: f64,
}

/// The fidelities worth having, by ascending error: each costs fewer instructions or bytes
/// than all before it. The first is the whole texture.
///
/// # Errors
/// Why the whole texture cannot be lowered.
pub(super) fn candidates(
    texture: &TextureModel,
    target: &Target,
    surfaces: Surfaces,
    pipeline: &mut Pipeline,
) -> Result<Vec<Candidate>, PipelineError> {
    let lowered =
        |pipeline: &mut Pipeline, fidelity: String, mut texture: TextureModel, error_db| {
            texture.provenance.fidelity.clone_from(&fidelity);
            let bytes = pipeline.lower(&texture, None)?.bytes;
            Ok::<_, PipelineError>(Candidate {
                fidelity,
                instructions: target.instructions(&texture, surfaces),
                texture,
                bytes,
                error_db,
            })
        };
    let full = Fidelity::Full.to_string();
    let mut all = vec![lowered(pipeline, full, texture.clone(), 0.0)?];
    if let Some(reference) = Reference::new(&texture.grid) {
        let tried: Vec<(Option<Candidate>, Pipeline)> = reduced(texture, pipeline)
            .into_par_iter()
            .map(|(fidelity, kept)| {
                let mut own = pipeline.another();
                let distances = own.run(Pass::Compare, || reference.distances(&kept.grid));
                let candidate = distances.and_then(|distances| {
                    let (_, worst_db) = distances.summary();
                    // A low order can move LSFs too close together: then it cannot be chosen.
                    let lowered = worst_db
                        .is_finite()
                        .then(|| lowered(&mut own, fidelity, kept, worst_db));
                    lowered?.ok()
                });
                (candidate, own)
            })
            .collect();
        for (candidate, own) in tried {
            pipeline.merge(own.timings());
            all.extend(candidate);
        }
    }
    // The sort is stable: of equals the whole texture stays first.
    all.sort_by(|a, b| a.error_db.total_cmp(&b.error_db));
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in all {
        let pays = kept.iter().all(|before| {
            candidate.instructions < before.instructions
                || candidate.bytes.len() < before.bytes.len()
        });
        if pays {
            kept.push(candidate);
        }
    }
    Ok(kept)
}

/// `auto`, and every lower order of both `auto` and the whole texture.
fn reduced(texture: &TextureModel, pipeline: &mut Pipeline) -> Vec<(String, TextureModel)> {
    let auto = pipeline.reduce(texture, Fidelity::Auto).texture;
    let orders = |of: &TextureModel| (1..of.grid.order).rev();
    let of_whole = orders(texture).map(|order| (texture, order, ""));
    let of_auto = orders(&auto).map(|order| (&auto, order, "auto+"));
    let lower: Vec<(String, TextureModel, Pipeline)> = of_whole
        .chain(of_auto)
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|(of, order, prefix)| {
            let mut own = pipeline.another();
            let fidelity = Fidelity::Order(order);
            let reduced = own.reduce(of, fidelity).texture;
            (format!("{prefix}{fidelity}"), reduced, own)
        })
        .collect();
    let mut all = Vec::with_capacity(lower.len() + 1);
    for (fidelity, reduced, own) in lower {
        pipeline.merge(own.timings());
        all.push((fidelity, reduced));
    }
    all.push((Fidelity::Auto.to_string(), auto));
    all
}

impl Candidate {
    /// A texture as a library has it.
    ///
    /// # Errors
    /// Why the asset does not parse.
    pub(super) fn of(
        bytes: Vec<u8>,
        error_db: f64,
        target: &Target,
        surfaces: Surfaces,
    ) -> Result<Self, VerifyError> {
        let texture = raise(&Asset::parse(&bytes)?);
        Ok(Self {
            fidelity: texture.provenance.fidelity.clone(),
            instructions: target.instructions(&texture, surfaces),
            texture,
            bytes,
            error_db,
        })
    }

    /// Zeros that are mixed and converted.
    pub(super) fn zeros(&self) -> usize {
        zeros(&self.texture.grid)
    }
}
