//! Ridge regression by the normal equations, its penalty chosen by leaving one out.

/// Candidates for the penalty, relative to the mean eigenvalue of the covariance.
const PENALTIES: [f64; 7] = [1e-4, 1e-3, 1e-2, 3e-2, 1e-1, 3e-1, 1.0];

/// `y ≈ offset + direction · x`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    pub(crate) offset: f64,
    pub(crate) direction: Vec<f64>,
    /// Share of the variance explained.
    pub(crate) r_squared: f64,
}

/// The line through points; flat where `y` does not vary or nothing can be solved.
pub(crate) fn fit(points: &[Vec<f64>], y: &[f64]) -> Line {
    let columns = points.first().map_or(0, Vec::len);
    let count = points.len() as f64;
    let mean: Vec<f64> = (0..columns)
        .map(|column| points.iter().map(|x| x[column]).sum::<f64>() / count)
        .collect();
    let y_mean = y.iter().sum::<f64>() / count;
    let x: Vec<Vec<f64>> = points
        .iter()
        .map(|x| x.iter().zip(&mean).map(|(x, mean)| x - mean).collect())
        .collect();
    let y: Vec<f64> = y.iter().map(|y| y - y_mean).collect();
    let total: f64 = y.iter().map(|y| y * y).sum();
    let covariance = gram(&x, columns);
    let trace: f64 = (0..columns).map(|i| covariance[i][i]).sum();
    let moment: Vec<f64> = (0..columns)
        .map(|i| x.iter().zip(&y).map(|(x, y)| x[i] * y).sum())
        .collect();
    let best = PENALTIES
        .iter()
        .filter_map(|penalty| {
            let factor = cholesky(&covariance, penalty * trace / columns as f64)?;
            let direction = solve(&factor, &moment);
            // Leaving one out: the residual over one minus its leverage.
            let left_out: f64 = x
                .iter()
                .zip(&y)
                .map(|(x, y)| {
                    let leverage = dot(x, &solve(&factor, x)) + 1.0 / count;
                    let residual = (y - dot(x, &direction)) / (1.0 - leverage).max(1e-9);
                    residual * residual
                })
                .sum();
            Some((left_out, direction))
        })
        .min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, direction)) = best.filter(|_| total > 0.0) else {
        return Line {
            offset: y_mean,
            direction: vec![0.0; columns],
            r_squared: 0.0,
        };
    };
    let residual: f64 = x
        .iter()
        .zip(&y)
        .map(|(x, y)| (y - dot(x, &direction)) * (y - dot(x, &direction)))
        .sum();
    Line {
        offset: y_mean - dot(&mean, &direction),
        direction,
        r_squared: 1.0 - residual / total,
    }
}

/// Inner product.
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn gram(x: &[Vec<f64>], columns: usize) -> Vec<Vec<f64>> {
    let entry = |i: usize, j: usize| x.iter().map(|x| x[i] * x[j]).sum();
    (0..columns)
        .map(|i| (0..columns).map(|j| entry(i, j)).collect())
        .collect()
}

/// The lower factor of `matrix + penalty·1`; `None` unless that is positive definite.
fn cholesky(matrix: &[Vec<f64>], penalty: f64) -> Option<Vec<Vec<f64>>> {
    let size = matrix.len();
    let mut lower = vec![vec![0.0; size]; size];
    for i in 0..size {
        for j in 0..=i {
            let known = dot(&lower[i][..j], &lower[j][..j]);
            if i == j {
                let pivot = matrix[i][i] + penalty - known;
                if !(pivot > 0.0 && pivot.is_finite()) {
                    return None;
                }
                lower[i][i] = libm::sqrt(pivot);
            } else {
                lower[i][j] = (matrix[i][j] - known) / lower[j][j];
            }
        }
    }
    Some(lower)
}

fn solve(lower: &[Vec<f64>], right: &[f64]) -> Vec<f64> {
    let mut x = right.to_vec();
    for i in 0..x.len() {
        let known = dot(&lower[i][..i], &x[..i]);
        x[i] = (x[i] - known) / lower[i][i];
    }
    for i in (0..x.len()).rev() {
        let known: f64 = (i + 1..x.len()).map(|j| lower[j][i] * x[j]).sum();
        x[i] = (x[i] - known) / lower[i][i];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, Stream};

    fn points(count: usize) -> Vec<Vec<f64>> {
        let mut stream = Stream::new(1, Purpose::Epoch, 0);
        (0..count)
            .map(|_| (0..5).map(|_| f64::from(stream.normal())).collect())
            .collect()
    }

    #[test]
    fn a_line_is_found() {
        let x = points(200);
        let y: Vec<f64> = x.iter().map(|x| 7.0 + 3.0 * x[1] - 2.0 * x[4]).collect();
        let line = fit(&x, &y);
        assert!((line.offset - 7.0).abs() < 1e-2 && line.r_squared > 0.9999);
        assert!((line.direction[1] - 3.0).abs() < 1e-2);
        assert!((line.direction[4] + 2.0).abs() < 1e-2);
    }

    #[test]
    fn noise_alone_is_not_explained_by_much() {
        let x = points(200);
        let y: Vec<f64> = points(200).iter().map(|x| x[0] * x[1]).collect();
        assert!(fit(&x, &y).r_squared < 0.1);
    }

    #[test]
    fn a_constant_has_no_direction() {
        let line = fit(&points(8), &[2.0; 8]);
        assert_eq!((line.offset, line.r_squared), (2.0, 0.0));
    }
}
