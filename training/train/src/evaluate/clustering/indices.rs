//! Indices of how well labels fit the places of points, as scikit-learn defines them.

use super::kmeans::{centre, square_distance};
use asperity::learned::Latent;
use rayon::prelude::*;

/// Members of every label, 0..count.
pub(super) fn members(labels: &[usize]) -> Vec<Vec<usize>> {
    let count = labels.iter().max().map_or(0, |most| most + 1);
    let mut members = vec![Vec::new(); count];
    for (index, &label) in labels.iter().enumerate() {
        members[label].push(index);
    }
    members
}

/// Mean over points of (b − a)/max(a, b): a the mean distance to the others of the own
/// label, b the smallest to those of another (Rousseeuw, 1987). −1 to 1, more is better.
pub(super) fn silhouette(points: &[Latent], labels: &[usize]) -> f64 {
    let members = members(labels);
    let total: f64 = points
        .par_iter()
        .zip(labels)
        .map(|(x, &own)| {
            if members[own].len() < 2 {
                return 0.0;
            }
            let distance = |label: &[usize]| -> f64 {
                label
                    .iter()
                    .map(|&m| f64::from(square_distance(x, &points[m])).sqrt())
                    .sum()
            };
            let a = distance(&members[own]) / (members[own].len() - 1) as f64;
            let b = members
                .iter()
                .enumerate()
                .filter(|(label, members)| *label != own && !members.is_empty())
                .map(|(_, members)| distance(members) / members.len() as f64)
                .fold(f64::INFINITY, f64::min);
            if b.is_finite() && a.max(b) > 0.0 {
                (b - a) / a.max(b)
            } else {
                0.0
            }
        })
        .collect::<Vec<f64>>()
        .iter()
        .sum();
    total / points.len().max(1) as f64
}

/// Sums of squares about the own label's mean and, of those means, about the whole's.
pub(super) fn sums_of_squares(points: &[Latent], labels: &[usize]) -> (f64, f64) {
    let all: Vec<usize> = (0..points.len()).collect();
    let whole = centre(points, &all);
    let (mut within, mut between) = (0.0, 0.0);
    for members in members(labels) {
        let own = centre(points, &members);
        between += members.len() as f64 * f64::from(square_distance(&own, &whole));
        for &m in &members {
            within += f64::from(square_distance(&points[m], &own));
        }
    }
    (within, between)
}

/// Variance between labels over that within, each over its degrees of freedom
/// (Caliński and Harabasz, 1974). More is better.
pub(super) fn calinski_harabasz(points: &[Latent], labels: &[usize]) -> f64 {
    let (within, between) = sums_of_squares(points, labels);
    let (n, k) = (points.len() as f64, members(labels).len() as f64);
    if within > 0.0 && k > 1.0 {
        (between / (k - 1.0)) / (within / (n - k))
    } else {
        0.0
    }
}

/// Mean over labels of the largest (s_i + s_j)/d_ij, s the mean distance from the label's
/// mean, d between means (Davies and Bouldin, 1979). Less is better.
pub(super) fn davies_bouldin(points: &[Latent], labels: &[usize]) -> f64 {
    let clouds: Vec<(Latent, f64)> = members(labels)
        .iter()
        .map(|members| {
            let own = centre(points, members);
            let away = members
                .iter()
                .map(|&m| f64::from(square_distance(&points[m], &own)).sqrt());
            (own, away.sum::<f64>() / members.len().max(1) as f64)
        })
        .collect();
    let worst = |i: usize| {
        (0..clouds.len())
            .filter(|&j| j != i)
            .map(|j| {
                let apart = f64::from(square_distance(&clouds[i].0, &clouds[j].0)).sqrt();
                (clouds[i].1 + clouds[j].1) / apart.max(f64::MIN_POSITIVE)
            })
            .fold(0.0, f64::max)
    };
    (0..clouds.len()).map(worst).sum::<f64>() / clouds.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four points on a line: 0, 1 | 10, 12.
    fn line() -> (Vec<Latent>, Vec<usize>) {
        let at = |x: f32| {
            let mut z = [0.0; 64];
            z[0] = x;
            z
        };
        (vec![at(0.0), at(1.0), at(10.0), at(12.0)], vec![0, 0, 1, 1])
    }

    #[test]
    fn indices_are_those_worked_out_by_hand() {
        let (points, labels) = line();
        let expected =
            ((11.0 - 1.0) / 11.0 + (10.0 - 1.0) / 10.0 + (9.5 - 2.0) / 9.5 + (11.5 - 2.0) / 11.5)
                / 4.0;
        assert!((silhouette(&points, &labels) - expected).abs() < 1e-6);
        // Within 0.5 + 2, between 4 · 5.25².
        assert!((calinski_harabasz(&points, &labels) - 110.25 / 1.25).abs() < 1e-4);
        assert!((davies_bouldin(&points, &labels) - 1.5 / 10.5).abs() < 1e-6);
    }
}
