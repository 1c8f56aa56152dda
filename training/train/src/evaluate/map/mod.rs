//! Part 6: the anchors on a plane.

mod picture;
mod tsne;

pub(super) use picture::draw;

use super::subject::Subject;
use crate::eigen;
use asperity::learned::{Latent, description::LATENT};
use serde::{Deserialize, Serialize};

/// Neighbours that count on the t-SNE map.
const PERPLEXITY: f64 = 15.0;

/// An anchor on both maps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Its family.
    pub family: String,
    /// Along the first two principal components.
    pub pca: [f64; 2],
    /// On the t-SNE map.
    pub tsne: [f64; 2],
}

/// Part 6.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Map {
    /// Every anchor.
    pub places: Vec<Place>,
    /// Share of the variance along each of the two components.
    pub explained: [f64; 2],
    /// Share of anchors whose nearest neighbour in the latent is of their family.
    pub family_neighbours: f64,
}

/// Projects the anchors.
pub(super) fn measure(subject: &Subject) -> Map {
    let latents = subject.anchors();
    let points: Vec<Vec<f64>> = latents
        .iter()
        .map(|z| z.iter().map(|&x| f64::from(x)).collect())
        .collect();
    let (pca, explained) = principal(&points);
    let tsne = tsne::embed(&points, &pca, PERPLEXITY);
    let anchors = &subject.description().anchors;
    let alike = (0..latents.len()).filter(|&i| {
        let other = nearest(&latents, i);
        other.is_some_and(|j| anchors[i].family == anchors[j].family)
    });
    Map {
        family_neighbours: alike.count() as f64 / latents.len().max(1) as f64,
        places: anchors
            .iter()
            .zip(pca.into_iter().zip(tsne))
            .map(|(anchor, (pca, tsne))| Place {
                name: anchor.name.clone(),
                family: anchor.family.clone(),
                pca,
                tsne,
            })
            .collect(),
        explained,
    }
}

fn nearest(latents: &[Latent], i: usize) -> Option<usize> {
    let distance = |j: usize| -> f32 {
        let pairs = latents[i].iter().zip(&latents[j]);
        pairs.map(|(x, y)| (x - y) * (x - y)).sum()
    };
    (0..latents.len())
        .filter(|&j| j != i)
        .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
}

/// Places along the first two principal components, and the shares of variance there.
fn principal(points: &[Vec<f64>]) -> (Vec<[f64; 2]>, [f64; 2]) {
    let count = points.len().max(1) as f64;
    let mean: Vec<f64> = (0..LATENT)
        .map(|k| points.iter().map(|p| p[k]).sum::<f64>() / count)
        .collect();
    let centred: Vec<Vec<f64>> = points
        .iter()
        .map(|p| p.iter().zip(&mean).map(|(x, m)| x - m).collect())
        .collect();
    let covariance = (0..LATENT * LATENT)
        .map(|at| {
            let (i, j) = (at / LATENT, at % LATENT);
            centred.iter().map(|p| p[i] * p[j]).sum::<f64>() / count
        })
        .collect();
    let pairs = eigen::symmetric(covariance, LATENT);
    let total: f64 = pairs.iter().map(|pair| pair.0).sum();
    let axes: [(f64, Vec<f64>); 2] = std::array::from_fn(|k| {
        let (value, mut axis) = pairs[k].clone();
        // Either sign is an eigenvector: the largest entry points upwards.
        let largest = axis
            .iter()
            .copied()
            .fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
        axis.iter_mut().for_each(|x| *x *= largest.signum());
        (value, axis)
    });
    let dot = |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(x, y)| x * y).sum() };
    let places = centred
        .iter()
        .map(|p| [dot(p, &axes[0].1), dot(p, &axes[1].1)]);
    let share = |value: f64| if total > 0.0 { value / total } else { 0.0 };
    (places.collect(), [share(axes[0].0), share(axes[1].0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_are_ordered_by_their_variance() {
        let points: Vec<Vec<f64>> = (0..40)
            .map(|n| {
                let mut p = vec![0.0; LATENT];
                p[5] = f64::from(n % 2) * 2.0;
                p[7] = f64::from(n / 20);
                p
            })
            .collect();
        let (places, explained) = principal(&points);
        assert!((explained[0] - 0.8).abs() < 1e-9 && (explained[1] - 0.2).abs() < 1e-9);
        assert!((places[1][0] - places[0][0]).abs() > 1.9);
    }
}
