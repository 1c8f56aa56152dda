//! A text that is clearly about one material is drawn to that material's latent.
//!
//! `p = softmax(cos(e, c_m)/τ)` over the materials' mean captions c_m, and
//! `z ← z + ‖p‖·(Σ_m p_m·z_m − z)`: a name comes out as its material, and what is like many
//! materials, or like none, stays nearly where it was.

use crate::{captions::cosine, trained::MaterialLatent};
use asperity::learned::description::LATENT;

/// Draws the latents of text vectors.
pub(crate) fn recall(
    materials: &[MaterialLatent],
    temperature: f32,
    vectors: &[&[f32]],
    latents: &mut [[f32; LATENT]],
) {
    if temperature <= 0.0 {
        return;
    }
    for (vector, z) in vectors.iter().zip(latents) {
        let shares = shares(materials, temperature, vector);
        let clarity = shares.iter().map(|share| share * share).sum::<f32>().sqrt();
        let mut recalled = [0.0; LATENT];
        for (share, material) in shares.iter().zip(materials) {
            let pairs = recalled.iter_mut().zip(&material.mean);
            pairs.for_each(|(sum, x)| *sum += share * x);
        }
        let pairs = z.iter_mut().zip(&recalled);
        pairs.for_each(|(z, recalled)| *z += clarity * (recalled - *z));
    }
}

fn shares(materials: &[MaterialLatent], temperature: f32, vector: &[f32]) -> Vec<f32> {
    let logits: Vec<f32> = materials
        .iter()
        .map(|material| cosine(vector, &material.caption) / temperature)
        .collect();
    let most = logits.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let weights: Vec<f32> = logits.iter().map(|x| libm::expf(x - most)).collect();
    let sum: f32 = weights.iter().sum();
    weights.iter().map(|weight| weight / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(caption: [f32; 2], value: f32) -> MaterialLatent {
        MaterialLatent {
            material: 0,
            mean: [value; LATENT],
            caption: caption.to_vec(),
        }
    }

    #[test]
    fn a_clear_text_takes_the_latent_of_its_material_and_a_doubtful_one_is_drawn_in_part() {
        let materials = [material([1.0, 0.0], 1.0), material([0.0, 1.0], 3.0)];
        let vectors: [&[f32]; 2] = [&[1.0, 0.0], &[1.0, 1.0]];
        let mut latents = [[0.0; LATENT]; 2];
        recall(&materials, 0.02, &vectors, &mut latents);
        assert!((latents[0][5] - 1.0).abs() < 1e-6);
        let part = 2.0 * 0.5_f32.sqrt();
        assert!((latents[1][5] - part).abs() < 1e-5, "‖(½, ½)‖ of their mean, 2");
        let mut still = [[0.25; LATENT]; 2];
        recall(&materials, 0.0, &vectors, &mut still);
        assert_eq!(still, [[0.25; LATENT]; 2]);
    }
}
