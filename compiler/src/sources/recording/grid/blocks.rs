//! Symmetric systems of blocks, of which most are nothing: conjugate gradients.

use std::collections::BTreeMap;

/// A square matrix of one vertex with another, by rows.
pub(super) type Block = Vec<f64>;

/// Parameters of every vertex.
pub(super) type Point = Vec<Vec<f64>>;

/// Steps of the conjugate gradients.
const GRADIENTS: usize = 40;

/// `block += scale·row·rowᵀ`.
pub(super) fn add_outer(block: &mut [f64], row: &[f64], scale: f64) {
    for (sums, x) in block.chunks_exact_mut(row.len()).zip(row) {
        let x = scale * x;
        for (sum, y) in sums.iter_mut().zip(row) {
            *sum += x * y;
        }
    }
}

pub(super) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

pub(super) fn product(block: &[f64], x: &[f64]) -> Vec<f64> {
    block.chunks_exact(x.len()).map(|row| dot(row, x)).collect()
}

/// Solves the symmetric system by conjugate gradients, after the blocks on its diagonal.
pub(super) fn solve(
    curvature: &BTreeMap<(usize, usize), Block>,
    right: &Point,
    size: usize,
) -> Point {
    let factors: Vec<Block> = (0..right.len())
        .map(|v| cholesky(&curvature[&(v, v)], size))
        .collect();
    let eased = |r: &Point| -> Point {
        r.iter()
            .zip(&factors)
            .map(|(r, factor)| back_and_forth(factor, r))
            .collect()
    };
    let times = |x: &Point| -> Point {
        let mut sum = vec![vec![0.0; size]; x.len()];
        for ((i, j), block) in curvature {
            for (sum, y) in sum[*i].iter_mut().zip(product(block, &x[*j])) {
                *sum += y;
            }
        }
        sum
    };
    let inner = |x: &Point, y: &Point| -> f64 { x.iter().zip(y).map(|(x, y)| dot(x, y)).sum() };
    let add = |x: &mut Point, scale: f64, y: &Point| {
        for (x, y) in x.iter_mut().flatten().zip(y.iter().flatten()) {
            *x += scale * y;
        }
    };
    let mut x = vec![vec![0.0; size]; right.len()];
    let mut r = right.clone();
    let mut z = eased(&r);
    let mut p = z.clone();
    let mut rz = inner(&r, &z);
    let first = rz;
    for _ in 0..GRADIENTS {
        if rz.is_nan() || rz <= 1e-8 * first {
            break;
        }
        let ap = times(&p);
        let along = rz / inner(&p, &ap);
        add(&mut x, along, &p);
        add(&mut r, -along, &ap);
        z = eased(&r);
        let next = inner(&r, &z);
        let keep = next / rz;
        rz = next;
        for (p, z) in p.iter_mut().flatten().zip(z.iter().flatten()) {
            *p = z + keep * *p;
        }
    }
    x
}

/// The lower triangle of a positive matrix.
fn cholesky(block: &[f64], size: usize) -> Block {
    let mut l = vec![0.0; size * size];
    for i in 0..size {
        for j in 0..=i {
            let sum =
                block[i * size + j] - dot(&l[i * size..i * size + j], &l[j * size..j * size + j]);
            l[i * size + j] = if i == j {
                sum.max(1e-12 * block[i * size + i]).max(1e-300).sqrt()
            } else {
                sum / l[j * size + j]
            };
        }
    }
    l
}

/// `(L·Lᵀ)⁻¹·x`.
fn back_and_forth(l: &[f64], x: &[f64]) -> Vec<f64> {
    let size = x.len();
    let mut y = x.to_vec();
    for i in 0..size {
        y[i] = (y[i] - dot(&l[i * size..i * size + i], &y[..i])) / l[i * size + i];
    }
    for i in (0..size).rev() {
        let sum: f64 = (i + 1..size).map(|k| l[k * size + i] * y[k]).sum();
        y[i] = (y[i] - sum) / l[i * size + i];
    }
    y
}
