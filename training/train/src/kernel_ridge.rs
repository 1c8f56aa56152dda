//! The retrieval-augmented projection: a text is placed by everything ever said that is
//! like it.
//!
//! Kernel ridge regression, `z(e) = z̄ + Σ_i a_i·exp(γ(e·e_i − 1))` over the captions and the
//! phrases of the lexicon, the coefficients a solving `(K + λ·diag(1/w))·a = z_i − z̄`, w how sure
//! an example is. Where nothing is like a text, it falls back to the mean. Vectors are kept on
//! their principal directions in 8 bits, coefficients in 8 bits; the coefficients are fitted to the
//! vectors that are kept.

use crate::{config::Memory, eigen, network::matrix, parameters::numbers};
use asperity::learned::description::LATENT;
use burn_tensor::{Device, Tensor};

/// Share of the first residual at which the solver stops.
const TOLERANCE: f32 = 2e-4;
/// κ of the soft maximum in [`KernelRidge::familiarity`].
pub(crate) const SHARPNESS: f32 = 20.0;
/// Largest code of a kept vector or coefficient.
const FULL_SCALE: f32 = 127.0;

/// A fitted projection.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KernelRidge {
    /// γ.
    pub(crate) concentration: f32,
    /// Width of the text vectors.
    pub(crate) width: usize,
    /// Principal directions of the examples, a column each: `width × kept`.
    pub(crate) basis: Vec<f32>,
    /// Number of directions kept.
    pub(crate) kept: usize,
    /// Codes, an example a row.
    pub(crate) codes: Vec<i8>,
    /// Quantisation scale of the codes, per example.
    pub(crate) scales: Vec<f32>,
    /// Codes of a, an example a row.
    pub(crate) coefficients: Vec<i8>,
    /// Quantisation scale of a, per component of the latent.
    pub(crate) coefficient_scales: [f32; LATENT],
    /// z̄.
    pub(crate) mean: [f32; LATENT],
}

impl KernelRidge {
    /// Fits unit vectors to their latents, each weighed by how sure it is. `done` is called
    /// after every step of the solver with the largest residual left, relative to the first.
    pub(crate) fn fit(
        vectors: &[&[f32]],
        targets: &[[f32; LATENT]],
        weights: &[f32],
        how: &Memory,
        mut done: impl FnMut(usize, usize, f32),
    ) -> Self {
        let width = vectors.first().map_or(0, |vector| vector.len());
        let device = Device::flex();
        let kept = how.directions.min(width);
        let basis = principal_directions(vectors, width, kept);
        let projected =
            matrix(vectors.concat(), width, &device).matmul(matrix(basis.clone(), kept, &device));
        let (codes, scales) = in_8_bits(&numbers(projected), kept);
        let mut memory = Self {
            concentration: how.concentration as f32,
            width,
            basis,
            kept,
            codes,
            scales,
            coefficients: Vec::new(),
            coefficient_scales: [0.0; LATENT],
            mean: [0.0; LATENT],
        };
        let (mean, found) = memory.solve(memory.concentration, targets, weights, how, &mut done);
        memory.mean = mean;
        let found = found.as_flattened();
        for (row, x) in found.iter().enumerate() {
            let scale = &mut memory.coefficient_scales[row % LATENT];
            *scale = scale.max(x.abs() / FULL_SCALE);
        }
        let scale = |at: usize| memory.coefficient_scales[at % LATENT].max(f32::MIN_POSITIVE);
        let codes = found.iter().enumerate();
        memory.coefficients = codes
            .map(|(at, x)| libm::roundf(x / scale(at)) as i8)
            .collect();
        memory
    }

    /// Regresses values of its examples on their kept vectors: their mean, and the coefficients of
    /// each example.
    pub(crate) fn solve<const N: usize>(
        &self,
        concentration: f32,
        values: &[[f32; N]],
        weights: &[f32],
        how: &Memory,
        done: &mut impl FnMut(usize, usize, f32),
    ) -> ([f32; N], Vec<[f32; N]>) {
        let device = Device::flex();
        let gram = {
            let kept = self.vectors(&device);
            let likeness = kept.clone().matmul(kept.transpose());
            kernel(likeness, concentration)
        };
        let mean = mean(values);
        let ridge = ridge(weights, how, &device);
        let found = conjugate_gradients(gram, centred(values, &mean, &device), ridge, how, done);
        (mean, numbers(found).as_chunks::<N>().0.to_vec())
    }

    /// Applies a regression to text vectors.
    pub(crate) fn apply<const N: usize>(
        &self,
        vectors: &[&[f32]],
        concentration: f32,
        coefficients: &[[f32; N]],
        mean: &[f32; N],
    ) -> Vec<[f32; N]> {
        if vectors.is_empty() {
            return Vec::new();
        }
        let device = Device::flex();
        let asked = self.on_directions(vectors, &device);
        let likeness = asked.matmul(self.vectors(&device).transpose());
        let coefficients = matrix(coefficients.as_flattened().to_vec(), N, &device);
        let mean = matrix(mean.to_vec(), N, &device);
        let said = kernel(likeness, concentration).matmul(coefficients) + mean;
        numbers(said).as_chunks::<N>().0.to_vec()
    }

    /// Text vectors of length one, on the principal directions.
    pub(crate) fn directions(&self, vectors: &[&[f32]]) -> Vec<Vec<f32>> {
        if vectors.is_empty() {
            return Vec::new();
        }
        let asked = self.on_directions(vectors, &Device::flex());
        rows(asked, self.kept)
    }

    fn on_directions(&self, vectors: &[&[f32]], device: &Device) -> Tensor<2> {
        let units: Vec<f32> = vectors
            .iter()
            .flat_map(|vector| {
                let norm = vector.iter().map(|x| x * x).sum::<f32>().sqrt();
                vector.iter().map(move |x| x / norm.max(f32::MIN_POSITIVE))
            })
            .collect();
        matrix(units, self.width, device).matmul(matrix(self.basis.clone(), self.kept, device))
    }

    /// Inner products of text vectors with the examples.
    pub(crate) fn likeness(&self, vectors: &[&[f32]]) -> Vec<Vec<f32>> {
        if vectors.is_empty() {
            return Vec::new();
        }
        let device = Device::flex();
        let asked = self.on_directions(vectors, &device);
        let likeness = asked.matmul(self.vectors(&device).transpose());
        rows(likeness, self.scales.len())
    }

    /// Returns the familiarity of text vectors: `1 + ln(Σ_i exp(κ(e·e_i − 1)))/κ`, a soft maximum of their inner
    /// products with the examples but for one, which `without` names for each vector.
    pub(crate) fn familiarity(&self, vectors: &[&[f32]], without: &[usize]) -> Vec<f64> {
        let rows = self.likeness(vectors).into_iter().enumerate();
        rows.map(|(row, likeness)| {
            let terms = likeness.iter().enumerate();
            let terms = terms.filter(|(i, _)| *i != without[row]);
            let sum: f64 = terms
                .map(|(_, &x)| f64::from(libm::expf(SHARPNESS * (x - 1.0))))
                .sum();
            1.0 + libm::log(sum.max(f64::MIN_POSITIVE)) / f64::from(SHARPNESS)
        })
        .collect()
    }

    /// Latents of text vectors.
    pub(crate) fn project(&self, vectors: &[&[f32]]) -> Vec<[f32; LATENT]> {
        let rows = self.coefficients.as_chunks::<LATENT>().0.iter();
        let coefficients: Vec<[f32; LATENT]> = rows
            .map(|row| std::array::from_fn(|k| f32::from(row[k]) * self.coefficient_scales[k]))
            .collect();
        self.apply(vectors, self.concentration, &coefficients, &self.mean)
    }

    /// Kept vectors [n, K].
    fn vectors(&self, device: &Device) -> Tensor<2> {
        let values = self
            .codes
            .chunks(self.kept.max(1))
            .zip(&self.scales)
            .flat_map(|(row, scale)| row.iter().map(move |&code| f32::from(code) * scale));
        matrix(values.collect(), self.kept, device)
    }
}

fn rows(values: Tensor<2>, columns: usize) -> Vec<Vec<f32>> {
    let values = numbers(values);
    let rows = values.chunks(columns.max(1));
    rows.map(<[f32]>::to_vec).collect()
}

fn kernel(likeness: Tensor<2>, concentration: f32) -> Tensor<2> {
    ((likeness - 1.0) * concentration).exp()
}

fn mean<const N: usize>(values: &[[f32; N]]) -> [f32; N] {
    let mut mean = [0.0; N];
    for value in values {
        let pairs = mean.iter_mut().zip(value);
        pairs.for_each(|(sum, x)| *sum += x / values.len() as f32);
    }
    mean
}

fn centred<const N: usize>(values: &[[f32; N]], mean: &[f32; N], device: &Device) -> Tensor<2> {
    let centred = values
        .iter()
        .flat_map(|v| v.iter().zip(mean).map(|(x, mean)| x - mean));
    matrix(centred.collect(), N, device)
}

/// λ/w of each example, a column.
fn ridge(weights: &[f32], how: &Memory, device: &Device) -> Tensor<2> {
    let ridge = weights.iter().map(|w| how.ridge as f32 / w.max(1e-3));
    matrix(ridge.collect(), 1, device)
}

/// Values at `asked`, by regression on `vectors` and their `values`, with the kernel and the ridge
/// of a memory, and in full precision.
pub(crate) fn regress<const N: usize>(
    vectors: &[&[f32]],
    values: &[[f32; N]],
    weights: &[f32],
    asked: &[&[f32]],
    how: &Memory,
) -> Vec<[f32; N]> {
    let device = Device::flex();
    let width = vectors.first().map_or(0, |vector| vector.len());
    let rows = |vectors: &[&[f32]]| matrix(vectors.concat(), width, &device);
    let kernel = |likeness| kernel(likeness, how.concentration as f32);
    let known = rows(vectors);
    let gram = kernel(known.clone().matmul(known.clone().transpose()));
    let mean = mean(values);
    let wanted = centred(values, &mean, &device);
    let ridge = ridge(weights, how, &device);
    let found = conjugate_gradients(gram, wanted, ridge, how, &mut |_, _, _| ());
    let said = kernel(rows(asked).matmul(known.transpose())).matmul(found);
    let said = numbers(said + matrix(mean.to_vec(), N, &device));
    said.as_chunks::<N>().0.to_vec()
}

/// The directions in which vectors vary most, about zero, a column each: `width × kept`.
fn principal_directions(vectors: &[&[f32]], width: usize, kept: usize) -> Vec<f32> {
    let device = Device::flex();
    let all = matrix(vectors.concat(), width, &device);
    let moments = numbers(all.clone().transpose().matmul(all));
    let moments = moments.iter().map(|&x| f64::from(x)).collect();
    let pairs = eigen::symmetric(moments, width);
    let mut basis = vec![0.0; width * kept];
    for (column, (_, vector)) in pairs.iter().take(kept).enumerate() {
        for (row, x) in vector.iter().enumerate() {
            basis[row * kept + column] = *x as f32;
        }
    }
    basis
}

/// Codes of rows, and what a code of each row is worth.
pub(crate) fn in_8_bits(rows: &[f32], width: usize) -> (Vec<i8>, Vec<f32>) {
    let (mut codes, mut scales) = (Vec::with_capacity(rows.len()), Vec::new());
    for row in rows.chunks(width.max(1)) {
        let peak = row
            .iter()
            .fold(f32::MIN_POSITIVE, |peak, x| peak.max(x.abs()));
        let scale = peak / FULL_SCALE;
        codes.extend(row.iter().map(|x| libm::roundf(x / scale) as i8));
        scales.push(scale);
    }
    (codes, scales)
}

/// Solves `(K + diag(ridge))·a = y` for all columns of y at once; `ridge` is a column.
fn conjugate_gradients(
    gram: Tensor<2>,
    wanted: Tensor<2>,
    ridge: Tensor<2>,
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
        let image = gram.clone().matmul(direction.clone()) + direction.clone() * ridge.clone();
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

    fn fitted(ridge: f64) -> (KernelRidge, Vec<Vec<f32>>, Vec<[f32; LATENT]>) {
        let (vectors, targets) = examples();
        let how = Memory {
            concentration: 8.0,
            ridge,
            iterations: 200,
            directions: 3,
            recall: None,
            caption_weight: 1.0,
            felt_concentration: 4.0,
            felt_caption_weight: 0.02,
        };
        let views: Vec<&[f32]> = vectors.iter().map(Vec::as_slice).collect();
        let weights = vec![1.0; views.len()];
        (
            KernelRidge::fit(&views, &targets, &weights, &how, |_, _, _| ()),
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
