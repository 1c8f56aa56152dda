//! What a texture costs at each fidelity, and which fidelities are worth having.

use super::cost::{Surfaces, Target, zeros};
use crate::{
    lower::{self, LowerError},
    model::TextureModel,
    reduce::{Fidelity, Reference, reduce},
};
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
) -> Result<Vec<Candidate>, LowerError> {
    let lowered = |fidelity: String, mut texture: TextureModel, error_db| {
        texture.provenance.fidelity.clone_from(&fidelity);
        let bytes = lower::lower(&texture, None)?.bytes;
        Ok::<_, LowerError>(Candidate {
            fidelity,
            instructions: target.instructions(&texture.grid, surfaces),
            texture,
            bytes,
            error_db,
        })
    };
    let mut all = vec![lowered(Fidelity::Full.to_string(), texture.clone(), 0.0)?];
    if let Some(reference) = Reference::new(&texture.grid) {
        let reduced: Vec<_> = reduced(texture)
            .into_par_iter()
            .filter_map(|(fidelity, kept)| {
                let (_, worst_db) = reference.distances(&kept.grid)?.summary();
                // A low order can move LSFs too close together: then it is none to choose.
                let candidate = worst_db
                    .is_finite()
                    .then(|| lowered(fidelity, kept, worst_db));
                candidate?.ok()
            })
            .collect();
        all.extend(reduced);
    }
    // Stable: of equals the whole texture stays first.
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
fn reduced(texture: &TextureModel) -> Vec<(String, TextureModel)> {
    let auto = reduce(texture, Fidelity::Auto).texture;
    let orders = |of: &TextureModel| (1..of.grid.order).rev();
    let of_whole = orders(texture).map(|order| (texture, order, String::new()));
    let of_auto = orders(&auto).map(|order| (&auto, order, "auto+".to_owned()));
    let mut all: Vec<(String, TextureModel)> = of_whole
        .chain(of_auto)
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|(of, order, prefix)| {
            let fidelity = Fidelity::Order(order);
            (format!("{prefix}{fidelity}"), reduce(of, fidelity).texture)
        })
        .collect();
    all.push((Fidelity::Auto.to_string(), auto));
    all
}

impl Candidate {
    /// Zeros that are mixed and converted.
    pub(super) fn zeros(&self) -> usize {
        zeros(&self.texture.grid)
    }
}
