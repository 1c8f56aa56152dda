//! A text that is clearly about one material is drawn to that material's latent.
//!
//! Prototypes are the mean caption, the name and every synonym of each material. With
//! `w = exp((e·c − 1)/τ)` over the prototypes c and W its sum over the phrases of the lexicon,
//! `z ← (Σ w·z_m + W·z)/(Σ w + W)`: a name comes out as its material, and what is like a phrase of
//! the lexicon stays where the regression put it.

use crate::{captions::Captions, material::MaterialLatent, memory::TextMemory};

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
    /// First of the memory's examples that is a phrase of the lexicon.
    pub(crate) phrases_from: usize,
}

/// Added to W, so that a text like nothing stays where it was.
pub(crate) const LEAST: f32 = 1e-30;

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
        let texts = materials
            .iter()
            .map(|m| captions.training[m.material].len());
        Some(Self {
            temperature: temperature as f32,
            codes,
            scales,
            owners,
            phrases_from: texts.sum(),
        })
    }

    /// Draws what is said of text vectors, given on the memory's directions, to what is so of the
    /// materials.
    pub(crate) fn draw<const N: usize>(
        &self,
        memory: &TextMemory,
        materials: &[[f32; N]],
        directions: &[Vec<f32>],
        said: &mut [[f32; N]],
    ) {
        let phrases = (
            &memory.codes[self.phrases_from * memory.kept..],
            &memory.scales[self.phrases_from..],
        );
        for (direction, said) in directions.iter().zip(said) {
            let prototypes = self.weights(direction, &self.codes, &self.scales);
            let kept: f32 = self.weights(direction, phrases.0, phrases.1).iter().sum();
            let kept = kept + LEAST;
            let mut drawn = said.map(|x| x * kept);
            for (weight, &owner) in prototypes.iter().zip(&self.owners) {
                let pairs = drawn.iter_mut().zip(&materials[owner]);
                pairs.for_each(|(sum, x)| *sum += weight * x);
            }
            let total = prototypes.iter().sum::<f32>() + kept;
            *said = drawn.map(|x| x / total);
        }
    }

    /// `exp((e·c − 1)/τ)` of rows in 8 bits.
    fn weights(&self, direction: &[f32], codes: &[i8], scales: &[f32]) -> Vec<f32> {
        let rows = codes.chunks(direction.len().max(1)).zip(scales);
        rows.map(|(codes, scale)| {
            let pairs = codes.iter().zip(direction);
            let product: f32 = pairs.map(|(&code, x)| f32::from(code) * x).sum();
            libm::expf((product * scale - 1.0) / self.temperature)
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity::learned::description::LATENT;

    #[test]
    fn a_name_takes_the_latent_of_its_material_and_a_phrase_keeps_its_own() {
        let materials = [[1.0; LATENT], [3.0; LATENT]];
        let recall = Recall {
            temperature: 0.02,
            codes: vec![100, 0, 0, 0, 100, 0],
            scales: vec![0.01; 2],
            owners: vec![0, 1],
            phrases_from: 1,
        };
        let memory = TextMemory {
            concentration: 1.0,
            width: 3,
            basis: Vec::new(),
            kept: 3,
            codes: vec![100, 0, 0, 0, 0, 100],
            scales: vec![0.01; 2],
            coefficients: Vec::new(),
            coefficient_scales: [0.0; LATENT],
            mean: [0.0; LATENT],
        };
        let directions = [
            vec![1.0, 0.0, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![0.0, 0.7, 0.7],
        ];
        let mut latents = [[-5.0; LATENT]; 3];
        recall.draw(&memory, &materials, &directions, &mut latents);
        for (z, expected) in latents.iter().zip([1.0, -5.0, -1.0]) {
            assert!((z[5] - expected).abs() < 1e-4, "{} {expected}", z[5]);
        }
    }
}
