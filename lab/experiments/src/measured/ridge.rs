//! Ridge regression of many targets on few features.

/// Weight of the penalty, of standardised features.
const PENALTY: f64 = 1.0;

/// Predicts the targets of `query` from known pairs of features and targets: features are standardised, the intercept is
/// free, β = (XᵀX + λI)⁻¹Xᵀy (Hoerl and Kennard, 1970). `None` without pairs.
pub(super) fn predict<const N: usize>(
    known: &[([f64; N], Vec<f64>)],
    query: [f64; N],
) -> Option<Vec<f64>> {
    let count = known.len() as f64;
    let targets = known.first()?.1.len();
    let mean: [f64; N] =
        std::array::from_fn(|i| known.iter().map(|(x, _)| x[i]).sum::<f64>() / count);
    let deviation: [f64; N] = std::array::from_fn(|i| {
        let square = |x: &[f64; N]| (x[i] - mean[i]) * (x[i] - mean[i]);
        (known.iter().map(|(x, _)| square(x)).sum::<f64>() / count).sqrt()
    });
    // A feature that is the same everywhere predicts nothing.
    let standard = |x: &[f64; N]| -> [f64; N] {
        std::array::from_fn(|i| match deviation[i] {
            0.0 => 0.0,
            deviation => (x[i] - mean[i]) / deviation,
        })
    };
    let mut normal = [[0.0; N]; N];
    for (x, _) in known {
        let x = standard(x);
        for (i, row) in normal.iter_mut().enumerate() {
            for (sum, xj) in row.iter_mut().zip(x) {
                *sum += x[i] * xj;
            }
        }
    }
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] += PENALTY;
    }
    // The prediction is Σ wₙ·yₙ: weights are solved for once, not a slope for each target.
    let slope = solve(normal, standard(&query));
    let mut predicted = vec![0.0; targets];
    for (x, y) in known {
        let along: f64 = standard(x).iter().zip(slope).map(|(x, s)| x * s).sum();
        let weight = 1.0 / count + along;
        for (sum, y) in predicted.iter_mut().zip(y) {
            *sum += weight * y;
        }
    }
    Some(predicted)
}

/// Solves a·x = b for a positive definite a, by Gaussian elimination.
pub(super) fn solve<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> [f64; N] {
    for pivot in 0..N {
        let (top, known) = (a[pivot], b[pivot]);
        for (row, value) in a.iter_mut().zip(&mut b).skip(pivot + 1) {
            let factor = row[pivot] / top[pivot];
            for (x, above) in row.iter_mut().zip(top).skip(pivot) {
                *x -= factor * above;
            }
            *value -= factor * known;
        }
    }
    for row in (0..N).rev() {
        let known: f64 = (row + 1..N).map(|column| a[row][column] * b[column]).sum();
        b[row] = (b[row] - known) / a[row][row];
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_through_many_points_is_found_and_shrunk_little() {
        let plane = |[x, y]: [f64; 2]| vec![3.0 + 2.0 * x - y, 7.0];
        let known: Vec<_> = (0..400)
            .map(|n| [f64::from(n % 20), f64::from(n / 20)])
            .map(|x| (x, plane(x)))
            .collect();
        let found = predict(&known, [4.0, 11.0]).expect("pairs");
        assert!(
            (found[0] - 0.0).abs() < 0.05 && (found[1] - 7.0).abs() < 1e-9,
            "{found:?}"
        );
        assert_eq!(predict::<2>(&[], [0.0; 2]), None);
    }

    #[test]
    fn features_that_do_not_differ_leave_the_mean() {
        let known = [([1.0], vec![2.0]), ([1.0], vec![4.0])];
        assert_eq!(predict(&known, [5.0]), Some(vec![3.0]));
    }
}
