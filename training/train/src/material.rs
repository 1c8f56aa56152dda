//! Where a training material lies in the latent, and what its captions say.

use asperity::learned::description::LATENT;

/// A training material in the latent.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MaterialLatent {
    /// Index into the corpus.
    pub(crate) material: usize,
    /// Mean of its instances' posterior means.
    pub(crate) mean: [f32; LATENT],
    /// Unit mean of its training captions.
    pub(crate) caption: Vec<f32>,
}
