//! Completion of the unrecorded parts, from the latent of the recorded ones.

use crate::learned::{
    LearnedModel, Present,
    complete::{ar_channels, taps_of_grid},
    contact, friction,
};
use asperity_io::diagnostic::Fault;
use asperity_texture::model::{ContactLaw, Gains, ModelGrid, TapBank};
use serde::Serialize;

/// Materials that are proposed.
const PROPOSED: usize = 3;

/// A training material near a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Nearest {
    /// Its name.
    pub name: String,
    /// Its family.
    pub family: String,
    /// Cosine between the latents.
    pub cosine: f64,
}

/// Completion of a grid by the learned model.
#[derive(Debug, Clone, PartialEq)]
pub struct Completed {
    /// The nearest materials, the nearest first.
    pub nearest: Vec<Nearest>,
    /// Taps that go with the grid.
    pub taps: TapBank,
    /// Coefficient of friction of the nearest materials.
    pub mu: f64,
    /// Stiffness of their walls, N/m.
    pub stiffness_n_m: f64,
    /// Their contact law, if they give way.
    pub contact: Option<ContactLaw>,
}

/// Encodes a grid and decodes what goes with it.
///
/// # Errors
/// [`Fault`] when a network fails.
pub fn complete(model: &LearnedModel, grid: &ModelGrid, gains: &Gains) -> Result<Completed, Fault> {
    let description = model.description();
    let z = model.encode(Present::Ar(&ar_channels(&description.grid, grid)))?;
    let neighbours = friction::neighbours(&z, &description.anchors, description.friction);
    let nearest = neighbours
        .iter()
        .take(PROPOSED)
        .map(|neighbour| {
            let anchor = &description.anchors[neighbour.index];
            Nearest {
                name: anchor.name.clone(),
                family: anchor.family.clone(),
                cosine: neighbour.cosine,
            }
        })
        .collect();
    Ok(Completed {
        nearest,
        taps: taps_of_grid(model, grid, gains)?,
        mu: friction::mu(&neighbours, &description.anchors),
        stiffness_n_m: friction::stiffness_n_m(&neighbours, &description.anchors),
        contact: contact::at(&z, description),
    })
}
