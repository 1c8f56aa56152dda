//! The directions that tell classes apart: Fisher's linear discriminant analysis.
//!
//! Vectors of one class differ by what is said, those of different classes by what is spoken of.
//! The scatter within the classes is shrunk towards a multiple of the unit matrix (Friedman, 1989)
//! and whitened; of the class means, the directions of largest variance λ are kept, each as long as
//! √(λ/(1 + λ)).

use crate::{eigen, ridge::dot};

/// A fitted projection.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Discriminant {
    /// Directions, a column each: `width × kept`.
    pub(crate) basis: Vec<f32>,
    /// Offset added per direction: the projected mean, negative.
    pub(crate) offset: Vec<f32>,
}

impl Discriminant {
    /// Fits at most `kept` directions to vectors of one width and the classes that they belong to,
    /// counted from 0.
    pub(crate) fn fit(
        vectors: &[Vec<f32>],
        classes: &[usize],
        kept: usize,
        shrinkage: f64,
    ) -> Self {
        let width = vectors.first().map_or(0, Vec::len);
        let kept = kept.min(width);
        let means = means(vectors, classes, width);
        let mean = overall(vectors, width);
        let mut within = vec![0.0; width * width];
        let share = 1.0 / vectors.len().max(1) as f64;
        for (vector, &class) in vectors.iter().zip(classes) {
            let pairs = vector.iter().zip(&means[class]);
            let off: Vec<f64> = pairs.map(|(&x, mean)| f64::from(x) - mean).collect();
            add_square(&mut within, &off, share);
        }
        let trace: f64 = (0..width).map(|k| within[k * width + k]).sum();
        let floor = (shrinkage * trace / width.max(1) as f64).max(f64::MIN_POSITIVE);
        (0..width).for_each(|k| within[k * width + k] += floor);
        let whitening = scaled(eigen::symmetric(within, width), |variance| {
            1.0 / variance.max(floor).sqrt()
        });
        let mut between = vec![0.0; width * width];
        for class in &means {
            let off: Vec<f64> = class.iter().zip(&mean).map(|(x, mean)| x - mean).collect();
            let white: Vec<f64> = whitening.iter().map(|column| dot(column, &off)).collect();
            add_square(&mut between, &white, 1.0 / means.len().max(1) as f64);
        }
        let mut directions = scaled(eigen::symmetric(between, width), |variance| {
            (variance.max(0.0) / (1.0 + variance.max(0.0))).sqrt()
        });
        directions.truncate(kept);
        let mut basis = vec![0.0; width * kept];
        let mut offset = vec![0.0; kept];
        for (column, direction) in directions.iter().enumerate() {
            for row in 0..width {
                let parts = whitening.iter().zip(direction);
                let x: f64 = parts.map(|(white, share)| white[row] * share).sum();
                basis[row * kept + column] = x as f32;
                offset[column] -= (x * mean[row]) as f32;
            }
        }
        Self { basis, offset }
    }

    /// A vector on the directions, of length one.
    pub(crate) fn place(&self, vector: &[f32]) -> Vec<f32> {
        let kept = self.offset.len();
        let mut placed = self.offset.clone();
        for (row, x) in self.basis.chunks(kept.max(1)).zip(vector) {
            let pairs = placed.iter_mut().zip(row);
            pairs.for_each(|(sum, direction)| *sum += direction * x);
        }
        let norm = placed.iter().map(|x| x * x).sum::<f32>().sqrt();
        let norm = norm + f32::MIN_POSITIVE;
        placed.iter_mut().for_each(|x| *x /= norm);
        placed
    }
}

fn overall(vectors: &[Vec<f32>], width: usize) -> Vec<f64> {
    let mut mean = vec![0.0; width];
    for vector in vectors {
        let pairs = mean.iter_mut().zip(vector);
        pairs.for_each(|(sum, &x)| *sum += f64::from(x) / vectors.len() as f64);
    }
    mean
}

/// The mean of each class; zero for one without a vector.
fn means(vectors: &[Vec<f32>], classes: &[usize], width: usize) -> Vec<Vec<f64>> {
    let count = classes.iter().max().map_or(0, |last| last + 1);
    let mut means = vec![vec![0.0; width]; count];
    let mut members = vec![0.0; count];
    for (vector, &class) in vectors.iter().zip(classes) {
        members[class] += 1.0;
        let pairs = means[class].iter_mut().zip(vector);
        pairs.for_each(|(sum, &x)| *sum += f64::from(x));
    }
    for (mean, members) in means.iter_mut().zip(members) {
        mean.iter_mut().for_each(|x| *x /= f64::max(members, 1.0));
    }
    means
}

/// Adds `share·x·xᵀ`.
fn add_square(matrix: &mut [f64], x: &[f64], share: f64) {
    for (row, a) in matrix.chunks_mut(x.len().max(1)).zip(x) {
        let a = a * share;
        row.iter_mut().zip(x).for_each(|(sum, b)| *sum += a * b);
    }
}

/// Eigenvectors, each as long as `length` says of its eigenvalue.
fn scaled(pairs: Vec<(f64, Vec<f64>)>, length: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
    let scale = |(value, vector): (f64, Vec<f64>)| {
        let length = length(value);
        vector.into_iter().map(|x| x * length).collect()
    };
    pairs.into_iter().map(scale).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Classes differ along the second axis, members far more along the first.
    #[test]
    fn what_tells_classes_apart_outweighs_what_varies_within_them() {
        let at = |x: f32, y: f32| vec![x, y, 0.3];
        let vectors = [at(-3.0, 1.0), at(3.0, 1.1), at(-3.0, -1.1), at(3.0, -1.0)];
        let found = Discriminant::fit(&vectors, &[0, 0, 1, 1], 2, 1e-3);
        let (one, other) = (found.place(&at(3.0, 1.0)), found.place(&at(-3.0, 1.0)));
        let cosine: f32 = one.iter().zip(&other).map(|(x, y)| x * y).sum();
        assert!(cosine > 0.99, "{cosine}");
        let across = found.place(&at(3.0, -1.0));
        let cosine: f32 = one.iter().zip(&across).map(|(x, y)| x * y).sum();
        assert!(cosine < -0.9, "{cosine}");
    }

    #[test]
    fn one_class_has_no_direction_and_no_number_is_lost() {
        let vectors = [vec![1.0, 0.0], vec![0.0, 1.0]];
        let found = Discriminant::fit(&vectors, &[0, 0], 2, 1.0);
        assert!(found.place(&[0.6, 0.8]).iter().all(|x| x.abs() < 1e-6));
        assert!(Discriminant::fit(&[], &[], 4, 1.0).place(&[]).is_empty());
    }
}
