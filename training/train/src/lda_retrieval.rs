//! A text that is clearly about one material is drawn to that material.
//!
//! Prototypes are the mean text, the name and every synonym of each material, on the directions
//! that tell the materials' texts apart. With `w = b·exp((e·c − 1)/τ)` over the prototypes c, b
//! above 1 for mean texts, and the same `g = exp((f − 1)/τ)` of a cosine f,
//! `x ← (Σ w·x_m + g·x)/(Σ w + g)`: a name comes out as its material, and what is less like any
//! prototype than f stays where the regression put it.

use crate::{
    captions::Captions,
    config::Recall as How,
    discriminant::Discriminant,
    kernel_ridge::{KernelRidge, in_8_bits},
    material::MaterialLatent,
};
use asperity::learned::description::LATENT;

/// Prototypes in 8 bits.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LdaRetrieval {
    /// τ, f and the like.
    pub(crate) how: How,
    /// From the directions of a memory to those that tell materials apart.
    pub(crate) discriminant: Discriminant,
    /// Codes, a prototype a row.
    pub(crate) codes: Vec<i8>,
    /// Quantisation scale of the codes, per prototype.
    pub(crate) scales: Vec<f32>,
    /// ln b, one a prototype.
    pub(crate) log_weights: Vec<f32>,
    /// The material's place among the anchors, one a prototype.
    pub(crate) owners: Vec<usize>,
}

impl LdaRetrieval {
    /// Fits the prototypes of materials.
    pub(crate) fn new(
        memory: &KernelRidge,
        materials: &[MaterialLatent],
        captions: &Captions,
        how: &How,
    ) -> Self {
        let (mut vectors, mut classes) = (Vec::new(), Vec::new());
        for (owner, material) in materials.iter().enumerate() {
            let texts = &captions.training[material.material];
            let views: Vec<&[f32]> = texts.iter().map(Vec::as_slice).collect();
            vectors.extend(memory.directions(&views));
            classes.resize(vectors.len(), owner);
        }
        let (kept, shrinkage) = (how.directions, how.shrinkage);
        let discriminant = Discriminant::fit(&vectors, &classes, kept, shrinkage);
        let kept = discriminant.offset.len();
        let (mut owners, mut prototypes, mut log_weights) = (Vec::new(), Vec::new(), Vec::new());
        let mut placed = vectors.iter().map(|vector| discriminant.place(vector));
        for (owner, material) in materials.iter().enumerate() {
            let count = captions.training[material.material].len();
            let texts: Vec<Vec<f32>> = placed.by_ref().take(count).collect();
            let names = &texts[count - captions.names[material.material]..];
            owners.resize(owners.len() + 1 + names.len(), owner);
            prototypes.extend(mean(&texts, kept));
            prototypes.extend(names.iter().flatten());
            log_weights.push(libm::log(how.mean_weight) as f32);
            log_weights.resize(owners.len(), 0.0);
        }
        let (codes, scales) = in_8_bits(&prototypes, kept);
        Self {
            how: *how,
            discriminant,
            codes,
            scales,
            log_weights,
            owners,
        }
    }

    /// Draws the latents of text vectors, given on the memory's directions, to those of the
    /// materials.
    pub(crate) fn draw(
        &self,
        materials: &[[f32; LATENT]],
        directions: &[Vec<f32>],
        said: &mut [[f32; LATENT]],
    ) {
        let kept = self.kept();
        for (direction, said) in directions.iter().zip(said) {
            let weights = self.weights(&self.discriminant.place(direction));
            drawn(said, kept, &weights, &self.owners, materials);
        }
    }

    /// g: what the regression counts.
    pub(crate) fn kept(&self) -> f32 {
        libm::expf(((self.how.familiar - 1.0) / self.how.temperature) as f32)
    }

    /// `b·exp((e·c − 1)/τ)` of all prototypes.
    fn weights(&self, placed: &[f32]) -> Vec<f32> {
        let rows = self.codes.chunks(placed.len().max(1));
        let rows = rows.zip(&self.scales).zip(&self.log_weights);
        rows.map(|((codes, scale), log_weight)| {
            let pairs = codes.iter().zip(placed);
            let product: f32 = pairs.map(|(&code, x)| f32::from(code) * x).sum();
            let temperature = self.how.temperature as f32;
            libm::expf((product * scale - 1.0) / temperature + log_weight)
        })
        .collect()
    }
}

/// `x ← (Σ w·x_m + g·x)/(Σ w + g)`, x_m of the owner of each w.
pub(crate) fn drawn<const N: usize>(
    said: &mut [f32; N],
    kept: f32,
    weights: &[f32],
    owners: &[usize],
    materials: &[[f32; N]],
) {
    let mut sum = said.map(|x| x * kept);
    for (weight, &owner) in weights.iter().zip(owners) {
        let pairs = sum.iter_mut().zip(&materials[owner]);
        pairs.for_each(|(sum, x)| *sum += weight * x);
    }
    let total = weights.iter().sum::<f32>() + kept;
    *said = sum.map(|x| x / total);
}

/// The mean of vectors of length one, of length one.
fn mean(vectors: &[Vec<f32>], width: usize) -> Vec<f32> {
    let mut mean = vec![0.0; width];
    for vector in vectors {
        mean.iter_mut().zip(vector).for_each(|(sum, x)| *sum += x);
    }
    crate::captions::unit(&mut mean);
    mean
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_takes_the_latent_of_its_material_and_a_stranger_keeps_its_own() {
        let materials = [[1.0; LATENT], [3.0; LATENT]];
        let mut basis = vec![0.0; 9];
        (0..3).for_each(|k| basis[4 * k] = 1.0);
        let recall = LdaRetrieval {
            how: How {
                temperature: 0.02,
                directions: 3,
                shrinkage: 1.0,
                mean_weight: 1.0,
                familiar: 0.7,
                felt_temperature: 0.02,
                felt_phrase_weight: 3.0,
            },
            discriminant: Discriminant {
                basis,
                offset: vec![0.0; 3],
            },
            codes: vec![100, 0, 0, 0, 100, 0],
            scales: vec![0.01; 2],
            log_weights: vec![0.0; 2],
            owners: vec![0, 1],
        };
        let directions = [
            vec![1.0, 0.0, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.7, 0.714_142_8],
        ];
        let mut latents = [[-5.0; LATENT]; 3];
        recall.draw(&materials, &directions, &mut latents);
        // The last is as like a prototype as what is called familiar: half of each.
        for (z, expected) in latents.iter().zip([1.0, -5.0, -1.0]) {
            assert!((z[5] - expected).abs() < 1e-2, "{} {expected}", z[5]);
        }
    }
}
