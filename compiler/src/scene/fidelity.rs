//! What a texture costs at each fidelity, and which fidelities a budget allows.

use super::cost::{Target, zeros};
use crate::{
    lower::{self, LowerError},
    model::TextureModel,
    reduce::{self, Fidelity},
};
use rayon::prelude::*;

/// A texture at a fidelity.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) fidelity: Fidelity,
    pub(super) texture: TextureModel,
    /// The asset.
    pub(super) bytes: Vec<u8>,
    /// Executed instructions a tick.
    pub(super) instructions: u64,
    /// Largest spectral distance from the whole texture, dB.
    pub(super) error_db: f64,
}

/// The texture at a fidelity, and its distance from the whole one, dB.
fn at_fidelity(texture: &TextureModel, fidelity: Fidelity) -> (TextureModel, f64) {
    let (grid, error_db) = reduce::reduce(&texture.grid, fidelity);
    let mut kept = TextureModel {
        grid,
        ..texture.clone()
    };
    kept.provenance.fidelity = fidelity.to_string();
    (kept, error_db)
}

/// The fidelities worth having, by ascending error: each costs fewer instructions or bytes
/// than all before it. The first is the whole texture.
pub(super) fn candidates(
    texture: &TextureModel,
    target: &Target,
    surfaces: usize,
) -> Result<Vec<Candidate>, LowerError> {
    let orders = (1..texture.grid.order).rev().map(Fidelity::Order);
    let fidelities: Vec<Fidelity> = [Fidelity::Full, Fidelity::Auto]
        .into_iter()
        .chain(orders)
        .collect();
    let mut all = fidelities
        .into_par_iter()
        .map(|fidelity| {
            let (texture, error_db) = at_fidelity(texture, fidelity);
            let bytes = match lower::lower(&texture, None) {
                Ok(lowered) => lowered.bytes,
                // A low order can move LSFs too close together: then it is none to choose.
                Err(_) if fidelity != Fidelity::Full => return Ok(None),
                Err(error) => return Err(error),
            };
            Ok(Some(Candidate {
                fidelity,
                instructions: target.instructions(&texture.grid, surfaces),
                texture,
                bytes,
                error_db,
            }))
        })
        .collect::<Result<Vec<_>, _>>()?
        .into_iter()
        .flatten()
        .collect::<Vec<_>>();
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

impl Candidate {
    /// Poles and zeros, for reports.
    pub(super) fn zeros(&self) -> usize {
        zeros(&self.texture.grid)
    }
}
