//! A text that is clearly about one material is drawn to that material's latent.
//!
//! Prototypes are the mean caption, the name and every synonym of each material. With
//! `p = softmax(e·c/τ)` over the prototypes c, `z ← z + ‖p‖·(Σ p·z_m − z)`: a name comes out as
//! its material, and what is like many prototypes, or like none, stays nearly where it was.

use crate::{captions::Captions, memory::TextMemory, trained::MaterialLatent};
use asperity::learned::description::LATENT;

/// Prototypes on the principal directions of a memory, in 8 bits.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Recall {
    /// τ.
    pub(crate) temperature: f32,
    /// Codes, a prototype a row.
    pub(crate) codes: Vec<i8>,
    /// What a code is worth, one a prototype.
    pub(crate) scales: Vec<f32>,
    /// The material's place among the anchors, one a prototype.
    pub(crate) owners: Vec<usize>,
}

impl Recall {
    /// Of materials; `None` at a temperature of zero.
    pub(crate) fn new(
        memory: &TextMemory,
        materials: &[MaterialLatent],
        captions: &Captions,
        temperature: f64,
    ) -> Option<Self> {
        if temperature <= 0.0 {
            return None;
        }
        let (mut owners, mut vectors) = (Vec::new(), Vec::new());
        for (owner, material) in materials.iter().enumerate() {
            let texts = &captions.training[material.material];
            let names = &texts[texts.len() - captions.names[material.material]..];
            let own = [material.caption.as_slice()].into_iter();
            for vector in own.chain(names.iter().map(Vec::as_slice)) {
                owners.push(owner);
                vectors.push(vector);
            }
        }
        let (codes, scales) = memory.codes_of(&vectors);
        Some(Self {
            temperature: temperature as f32,
            codes,
            scales,
            owners,
        })
    }

    /// Draws the latents of text vectors, given on the memory's directions.
    pub(crate) fn draw(
        &self,
        materials: &[MaterialLatent],
        directions: &[Vec<f32>],
        latents: &mut [[f32; LATENT]],
    ) {
        for (direction, z) in directions.iter().zip(latents) {
            let shares = self.shares(direction);
            let clarity = shares.iter().map(|share| share * share).sum::<f32>().sqrt();
            let mut recalled = [0.0; LATENT];
            for (share, &owner) in shares.iter().zip(&self.owners) {
                let pairs = recalled.iter_mut().zip(&materials[owner].mean);
                pairs.for_each(|(sum, x)| *sum += share * x);
            }
            let pairs = z.iter_mut().zip(&recalled);
            pairs.for_each(|(z, recalled)| *z += clarity * (recalled - *z));
        }
    }

    fn shares(&self, direction: &[f32]) -> Vec<f32> {
        let rows = self.codes.chunks(direction.len().max(1)).zip(&self.scales);
        let logits: Vec<f32> = rows
            .map(|(codes, scale)| {
                let pairs = codes.iter().zip(direction);
                let product: f32 = pairs.map(|(&code, x)| f32::from(code) * x).sum();
                product * scale / self.temperature
            })
            .collect();
        let most = logits.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let weights: Vec<f32> = logits.iter().map(|x| libm::expf(x - most)).collect();
        let sum: f32 = weights.iter().sum();
        weights.iter().map(|weight| weight / sum).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clear_text_takes_the_latent_of_its_material_and_a_doubtful_one_is_drawn_in_part() {
        let material = |value: f32| MaterialLatent {
            material: 0,
            mean: [value; LATENT],
            caption: Vec::new(),
        };
        let materials = [material(1.0), material(3.0)];
        let recall = Recall {
            temperature: 0.02,
            codes: vec![100, 0, 0, 100],
            scales: vec![0.01; 2],
            owners: vec![0, 1],
        };
        let directions = [vec![1.0, 0.0], vec![0.7, 0.7]];
        let mut latents = [[0.0; LATENT]; 2];
        recall.draw(&materials, &directions, &mut latents);
        assert!((latents[0][5] - 1.0).abs() < 1e-6);
        let part = 2.0 * 0.5_f32.sqrt();
        assert!(
            (latents[1][5] - part).abs() < 1e-5,
            "‖(½, ½)‖ of their mean, 2"
        );
    }
}
