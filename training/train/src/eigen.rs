//! Eigenvalues and eigenvectors of a small symmetric matrix.

/// Sweeps after which the rotations have converged for any matrix met here.
const SWEEPS: usize = 60;

/// Eigenvalues in descending order, each with its unit eigenvector, by Jacobi's
/// rotations. `matrix` is symmetric, row by row, `size × size`.
pub(crate) fn symmetric(mut matrix: Vec<f64>, size: usize) -> Vec<(f64, Vec<f64>)> {
    let mut vectors = vec![0.0; size * size];
    for index in 0..size {
        vectors[index * size + index] = 1.0;
    }
    let scale: f64 = matrix.iter().map(|x| x * x).sum();
    for _ in 0..SWEEPS {
        let off: f64 = (0..size)
            .flat_map(|p| (p + 1..size).map(move |q| p * size + q))
            .map(|at| matrix[at] * matrix[at])
            .sum();
        if off <= 1e-24 * scale {
            break;
        }
        for p in 0..size {
            for q in p + 1..size {
                rotate(&mut matrix, &mut vectors, size, p, q);
            }
        }
    }
    let mut pairs: Vec<(f64, Vec<f64>)> = (0..size)
        .map(|k| {
            let vector = (0..size).map(|row| vectors[row * size + k]).collect();
            (matrix[k * size + k], vector)
        })
        .collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs
}

fn rotate(matrix: &mut [f64], vectors: &mut [f64], size: usize, p: usize, q: usize) {
    let off = matrix[p * size + q];
    if off == 0.0 {
        return;
    }
    let theta = (matrix[q * size + q] - matrix[p * size + p]) / (2.0 * off);
    let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
    let tangent = if theta == 0.0 { 1.0 } else { tangent };
    let cos = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sin = tangent * cos;
    for k in 0..size {
        let (a, b) = (matrix[k * size + p], matrix[k * size + q]);
        matrix[k * size + p] = cos * a - sin * b;
        matrix[k * size + q] = sin * a + cos * b;
    }
    for k in 0..size {
        let (a, b) = (matrix[p * size + k], matrix[q * size + k]);
        matrix[p * size + k] = cos * a - sin * b;
        matrix[q * size + k] = sin * a + cos * b;
        let (a, b) = (vectors[k * size + p], vectors[k * size + q]);
        vectors[k * size + p] = cos * a - sin * b;
        vectors[k * size + q] = sin * a + cos * b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vector_times_its_value_is_the_matrix_times_the_vector() {
        let size = 7;
        let entry = |i: usize, j: usize| 1.0 / (1.0 + i as f64 + j as f64) + f64::from(i == j);
        let matrix: Vec<f64> = (0..size * size)
            .map(|at| entry(at / size, at % size))
            .collect();
        let pairs = symmetric(matrix, size);
        assert!(pairs.windows(2).all(|pair| pair[0].0 >= pair[1].0));
        for (value, vector) in pairs {
            for i in 0..size {
                let product: f64 = (0..size).map(|j| entry(i, j) * vector[j]).sum();
                assert!((product - value * vector[i]).abs() < 1e-10);
            }
        }
    }
}
