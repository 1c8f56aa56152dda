//! Inputs of the network in a step.

use crate::{
    captions::{Captions, unit},
    config::Augmentation,
    loss::Pairing,
    network::matrix,
    normaliser::{AR, Coded, TAP_VALUES},
    rng::Stream,
};
use asperity::learned::description::LATENT;
use burn_tensor::{Device, Int, Tensor};

/// The training instances, normalised, and whose they are.
pub(crate) struct Instances {
    pub(crate) coded: Coded,
    /// Material of each, an index into the corpus.
    pub(crate) material: Vec<usize>,
    /// Friction of each: ln μ, standardised.
    pub(crate) friction: Vec<f32>,
}

/// Inputs of a step.
pub(crate) struct Batch {
    /// [B, 396], normalised.
    pub(crate) ar: Tensor<2>,
    /// [B, 1300], normalised.
    pub(crate) taps: Tensor<2>,
    /// [B, 2], ones for the modalities that the encoder sees.
    pub(crate) present: Tensor<2>,
    /// [B, W], a caption each.
    pub(crate) text: Tensor<2>,
    /// [B], the material of each.
    pub(crate) material: Tensor<1, Int>,
    /// [B, 1], ln μ, standardised.
    pub(crate) friction: Tensor<2>,
    /// B·64 standard normals.
    pub(crate) epsilon: Vec<f32>,
    /// Which rows match.
    pub(crate) pairing: Pairing,
    /// [B, B], the shares of the rows in each that the AR decoder gets; `None` where it gets them as they are.
    pub(crate) mixing: Option<Tensor<2>>,
}

impl Batch {
    /// Gathers instances and draws what is random about them.
    pub(crate) fn draw(
        instances: &Instances,
        captions: &Captions,
        chosen: &[usize],
        augmentation: &Augmentation,
        stream: &mut Stream,
        device: &Device,
    ) -> Self {
        let gather = |rows: &[f32], columns: usize| {
            let mut values = Vec::with_capacity(chosen.len() * columns);
            for &row in chosen {
                values.extend_from_slice(&rows[row * columns..(row + 1) * columns]);
            }
            matrix(values, columns, device)
        };
        let materials: Vec<usize> = chosen.iter().map(|&row| instances.material[row]).collect();
        let mut text = Vec::with_capacity(chosen.len() * captions.width);
        let mut present = Vec::with_capacity(chosen.len() * 2);
        for &material in &materials {
            text.extend(caption(&captions.training[material], augmentation, stream));
            present.extend(modalities(augmentation.modality_dropout, stream));
        }
        Self {
            ar: gather(&instances.coded.ar, AR),
            taps: gather(&instances.coded.taps, TAP_VALUES),
            present: matrix(present, 2, device),
            text: matrix(text, captions.width, device),
            material: Tensor::from_data(
                materials
                    .iter()
                    .map(|&m| m as i64)
                    .collect::<Vec<_>>()
                    .as_slice(),
                device,
            ),
            friction: matrix(
                chosen.iter().map(|&row| instances.friction[row]).collect(),
                1,
                device,
            ),
            epsilon: stream.normals(chosen.len() * LATENT),
            pairing: Pairing::new(&materials, device),
            mixing: mixing(chosen.len(), augmentation.latent_mixup, stream)
                .map(|shares| matrix(shares, chosen.len(), device)),
        }
    }
}

/// Ones for what an encoder sees: one of two is withheld at times, never both.
fn modalities(withheld: f64, stream: &mut Stream) -> [f32; 2] {
    match (stream.happens(withheld), stream.happens(0.5)) {
        (false, _) => [1.0, 1.0],
        (true, false) => [1.0, 0.0],
        (true, true) => [0.0, 1.0],
    }
}

/// Shares of `rows` in each of them: with this probability a row is mixed with another, evenly over all mixtures.
fn mixing(rows: usize, probability: f64, stream: &mut Stream) -> Option<Vec<f32>> {
    if probability <= 0.0 {
        return None;
    }
    let mut shares = vec![0.0; rows * rows];
    for row in 0..rows {
        let other = if stream.happens(probability) {
            stream.uniform()
        } else {
            0.0
        };
        shares[row * rows + row] += 1.0 - other;
        shares[row * rows + stream.below(rows)] += other;
    }
    Some(shares)
}

/// Draws a caption of a material, perhaps mixed with another, perhaps with noise.
fn caption(captions: &[Vec<f32>], augmentation: &Augmentation, stream: &mut Stream) -> Vec<f32> {
    let mut vector = captions[stream.below(captions.len())].clone();
    if stream.happens(augmentation.caption_mixup) {
        let other = &captions[stream.below(captions.len())];
        let share = stream.uniform();
        for (x, y) in vector.iter_mut().zip(other) {
            *x += share * (y - *x);
        }
        unit(&mut vector);
    }
    add_noise(&mut vector, augmentation.caption_noise, stream);
    vector
}

/// Adds Gaussian noise of this expected norm to a unit vector, and scales it back.
pub(crate) fn add_noise(vector: &mut [f32], norm: f64, stream: &mut Stream) {
    if norm > 0.0 {
        let deviation = (norm / libm::sqrt(vector.len() as f64)) as f32;
        vector
            .iter_mut()
            .for_each(|x| *x += deviation * stream.normal());
        unit(vector);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Purpose;

    #[test]
    fn never_are_both_modalities_withheld() {
        let mut stream = Stream::new(1, Purpose::Epoch, 0);
        let drawn: Vec<_> = (0..4000).map(|_| modalities(0.5, &mut stream)).collect();
        assert!(drawn.iter().all(|present| present != &[0.0, 0.0]));
        let count = |what| drawn.iter().filter(|present| **present == what).count();
        assert!((count([1.0, 1.0]) as f64 / 4000.0 - 0.5).abs() < 0.04);
        assert!((count([0.0, 1.0]) as f64 / 4000.0 - 0.25).abs() < 0.04);
    }

    #[test]
    fn a_mixture_has_the_whole_of_two_rows() {
        let mut stream = Stream::new(1, Purpose::Epoch, 0);
        assert_eq!(mixing(8, 0.0, &mut stream), None);
        let shares = mixing(64, 0.5, &mut stream).unwrap();
        let mut mixed = 0;
        for row in shares.chunks(64) {
            assert!((row.iter().sum::<f32>() - 1.0).abs() < 1e-6);
            let parts = row.iter().filter(|share| **share > 0.0).count();
            assert!((1..=2).contains(&parts));
            mixed += parts - 1;
        }
        assert!((16..48).contains(&mixed), "{mixed}");
    }

    #[test]
    fn noise_has_the_norm_it_says() {
        let mut stream = Stream::new(1, Purpose::Epoch, 0);
        let mut vector = vec![0.0; 4000];
        vector[0] = 1.0;
        add_noise(&mut vector, 0.5, &mut stream);
        // Scaled back by √(1 + 0.5²).
        assert!((vector[0] - 1.0 / 1.25_f32.sqrt()).abs() < 0.02);
    }
}
