//! The retrieval-augmented projection: a text is placed by everything ever said that is
//! like it.
//!
//! Kernel ridge regression, `z(e) = z̄ + Σ_i a_i·exp(γ(cos(e, e_i) − 1))` over the captions
//! and the phrases of the lexicon, the coefficients a solving `(K + λI)·a = z_i − z̄`. Where
//! nothing is like a text, it falls back to the mean. Vectors are kept in 8 bits, and the
//! coefficients are fitted to what is kept.

use crate::{config::Memory, network::matrix, parameters::numbers};
use asperity::learned::description::LATENT;
use burn_tensor::{Device, Tensor};

/// Share of the first residual at which the solver stops.
const TOLERANCE: f32 = 2e-4;
/// Largest code of a kept vector.
const FULL_SCALE: f32 = 127.0;

/// A fitted projection.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TextMemory {
    /// γ.
    pub(crate) concentration: f32,
    /// Width of the vectors.
    pub(crate) width: usize,
    /// Codes, an example a row.
    pub(crate) codes: Vec<i8>,
    /// What a code is worth, one an example.
    pub(crate) scales: Vec<f32>,
    /// a, an example a row.
    pub(crate) coefficients: Vec<f32>,
    /// z̄.
    pub(crate) mean: [f32; LATENT],
}

impl TextMemory {
    /// Fits unit vectors to their latents. `done` is told of every step of the solver,
    /// with the largest residual left, relative to the first.
    pub(crate) fn fit(
        vectors: &[&[f32]],
        targets: &[[f32; LATENT]],
        how: &Memory,
        mut done: impl FnMut(usize, usize, f32),
    ) -> Self {
        let count = vectors.len();
        let width = vectors.first().map_or(0, |vector| vector.len());
        let (mut codes, mut scales) = (Vec::with_capacity(count * width), Vec::new());
        for vector in vectors {
            let peak = vector
                .iter()
                .fold(f32::MIN_POSITIVE, |peak, x| peak.max(x.abs()));
            let scale = peak / FULL_SCALE;
            codes.extend(vector.iter().map(|x| libm::roundf(x / scale) as i8));
            scales.push(scale);
        }
        let mut mean = [0.0; LATENT];
        for target in targets {
            mean.iter_mut()
                .zip(target)
                .for_each(|(sum, x)| *sum += x / count as f32);
        }
        let mut memory = Self {
            concentration: how.concentration as f32,
            width,
            codes,
            scales,
            coefficients: Vec::new(),
            mean,
        };
        let device = Device::flex();
        let gram = {
            let kept = memory.vectors(&device);
            let likeness = kept.clone().matmul(kept.transpose());
            memory.kernel(likeness)
        };
        let centred = targets
            .iter()
            .flat_map(|z| z.iter().zip(&mean).map(|(x, mean)| x - mean));
        let wanted = matrix(centred.collect(), LATENT, &device);
        let found = conjugate_gradients(gram, wanted, how, &mut done);
        memory.coefficients = numbers(found);
        memory
    }

    /// Latents of text vectors.
    pub(crate) fn project(&self, vectors: &[&[f32]]) -> Vec<[f32; LATENT]> {
        if vectors.is_empty() {
            return Vec::new();
        }
        let device = Device::flex();
        let units: Vec<f32> = vectors
            .iter()
            .flat_map(|vector| {
                let norm = vector.iter().map(|x| x * x).sum::<f32>().sqrt();
                vector.iter().map(move |x| x / norm.max(f32::MIN_POSITIVE))
            })
            .collect();
        let asked = matrix(units, self.width, &device);
        let likeness = asked.matmul(self.vectors(&device).transpose());
        let coefficients = matrix(self.coefficients.clone(), LATENT, &device);
        let mean = matrix(self.mean.to_vec(), LATENT, &device);
        let z = self.kernel(likeness).matmul(coefficients) + mean;
        let numbers = numbers(z);
        numbers
            .chunks_exact(LATENT)
            .map(|row| std::array::from_fn(|k| row[k]))
            .collect()
    }

    /// Kept vectors [n, W].
    fn vectors(&self, device: &Device) -> Tensor<2> {
        let values = self
            .codes
            .chunks(self.width.max(1))
            .zip(&self.scales)
            .flat_map(|(row, scale)| row.iter().map(move |&code| f32::from(code) * scale));
        matrix(values.collect(), self.width, device)
    }

    fn kernel(&self, likeness: Tensor<2>) -> Tensor<2> {
        ((likeness - 1.0) * self.concentration).exp()
    }
}

/// Solves `(K + λI)·a = y` for all columns of y at once.
fn conjugate_gradients(
    gram: Tensor<2>,
    wanted: Tensor<2>,
    how: &Memory,
    done: &mut impl FnMut(usize, usize, f32),
) -> Tensor<2> {
    let dot = |x: &Tensor<2>, y: &Tensor<2>| (x.clone() * y.clone()).sum_dim(0);
    let mut found = wanted.clone() * 0.0;
    let mut residual = wanted;
    let mut direction = residual.clone();
    let mut square = dot(&residual, &residual);
    let first = square.clone().clamp_min(f32::MIN_POSITIVE);
    for step in 0..how.iterations {
        let image = gram.clone().matmul(direction.clone()) + direction.clone() * how.ridge;
        let curvature = dot(&direction, &image).clamp_min(f32::MIN_POSITIVE);
        let length = square.clone() / curvature;
        found = found + direction.clone() * length.clone();
        residual = residual - image * length;
        let next = dot(&residual, &residual);
        let left = (next.clone() / first.clone())
            .max()
            .into_scalar::<f32>()
            .sqrt();
        done(step + 1, how.iterations, left);
        if left < TOLERANCE {
            break;
        }
        let turn = next.clone() / square.clamp_min(f32::MIN_POSITIVE);
        direction = residual.clone() + direction * turn;
        square = next;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn examples() -> (Vec<Vec<f32>>, Vec<[f32; LATENT]>) {
        let vectors: Vec<Vec<f32>> = (0..12)
            .map(|n| {
                let angle = 0.5 * n as f32;
                vec![angle.cos(), angle.sin(), 0.3]
            })
            .map(|v| {
                let norm = v.iter().map(|x| x * x).sum::<f32>().sqrt();
                v.into_iter().map(|x| x / norm).collect()
            })
            .collect();
        let targets = (0..12)
            .map(|n| std::array::from_fn(|k| ((n * k) as f32).sin()))
            .collect();
        (vectors, targets)
    }

    fn fitted(ridge: f64) -> (TextMemory, Vec<Vec<f32>>, Vec<[f32; LATENT]>) {
        let (vectors, targets) = examples();
        let how = Memory {
            concentration: 8.0,
            ridge,
            iterations: 200,
        };
        let views: Vec<&[f32]> = vectors.iter().map(Vec::as_slice).collect();
        (
            TextMemory::fit(&views, &targets, &how, |_, _, _| ()),
            vectors,
            targets,
        )
    }

    #[test]
    fn without_a_ridge_it_goes_through_its_examples() {
        let (memory, vectors, targets) = fitted(1e-6);
        let views: Vec<&[f32]> = vectors.iter().map(Vec::as_slice).collect();
        for (found, wanted) in memory.project(&views).iter().zip(&targets) {
            for (x, y) in found.iter().zip(wanted) {
                assert!((x - y).abs() < 0.05, "{x} {y}");
            }
        }
    }

    #[test]
    fn with_a_large_ridge_all_that_is_left_is_the_mean() {
        let (memory, vectors, _) = fitted(1e6);
        let found = memory.project(&[&vectors[3]]);
        for (x, mean) in found[0].iter().zip(&memory.mean) {
            assert!((x - mean).abs() < 1e-3);
        }
    }
}
