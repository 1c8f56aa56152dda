//! Friction from the neighbours of a latent.

use super::description::{Anchor, FrictionDescription};

/// An anchor near a latent, and its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbour {
    /// Index of the anchor.
    pub index: usize,
    /// Cosine between its latent and the query.
    pub cosine: f64,
    /// Its weight, 0..=1; the weights of all neighbours sum to one.
    pub weight: f64,
}

/// The top-k anchors of z with the paper's weights,
/// `w_i = exp(cos(z, z_i)/τ) / Σ_top-k exp(cos(z, z_j)/τ)`, heaviest first.
///
/// Anchors of equal cosine keep their order. A latent of length zero is equally far from all
/// anchors, so the first k have equal weights.
#[must_use]
pub fn neighbours(z: &[f32], anchors: &[Anchor], how: FrictionDescription) -> Vec<Neighbour> {
    let mut all: Vec<Neighbour> = anchors
        .iter()
        .enumerate()
        .map(|(index, anchor)| Neighbour {
            index,
            cosine: cosine(z, &anchor.z),
            weight: 0.0,
        })
        .collect();
    all.sort_by(|a, b| b.cosine.total_cmp(&a.cosine).then(a.index.cmp(&b.index)));
    all.truncate(how.top_k.max(1));
    let best = all.first().map_or(0.0, |first| first.cosine);
    let mut sum = 0.0;
    for neighbour in &mut all {
        neighbour.weight = libm::exp((neighbour.cosine - best) / how.temperature);
        sum += neighbour.weight;
    }
    for neighbour in &mut all {
        neighbour.weight /= sum;
    }
    all
}

/// Σ w_i μ_i: the mean coefficient of friction.
#[must_use]
pub fn mu(neighbours: &[Neighbour], anchors: &[Anchor]) -> f64 {
    neighbours
        .iter()
        .map(|n| n.weight * anchors[n.index].mu)
        .sum()
}

/// Σ w_i k_i: the mean stiffness of the walls, N/m.
#[must_use]
pub fn stiffness_n_m(neighbours: &[Neighbour], anchors: &[Anchor]) -> f64 {
    neighbours
        .iter()
        .map(|n| n.weight * anchors[n.index].stiffness_n_m)
        .sum()
}

/// Cosine of the angle between two vectors; 0 where one has no length.
#[must_use]
pub fn cosine(x: &[f32], y: &[f32]) -> f64 {
    let dot = |a: &[f32], b: &[f32]| -> f64 {
        a.iter()
            .zip(b)
            .map(|(a, b)| f64::from(*a) * f64::from(*b))
            .sum()
    };
    let length = (dot(x, x) * dot(y, y)).sqrt();
    if length > 0.0 && length.is_finite() {
        dot(x, y) / length
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn anchor(z: [f32; 2], mu: f64) -> Anchor {
        Anchor {
            name: "a".into(),
            family: "f".into(),
            mu,
            stiffness_n_m: 500.0,
            z: z.to_vec(),
        }
    }

    #[test]
    fn mu_follows_the_softmax_over_the_nearest() {
        let anchors = [
            anchor([1.0, 0.0], 0.2),
            anchor([0.0, 2.0], 0.8),
            anchor([-1.0, 0.0], 5.0),
        ];
        let how = FrictionDescription {
            top_k: 2,
            temperature: 0.5,
        };
        let found = neighbours(&[3.0, 0.0], &anchors, how);
        let expected = (0.2 * libm::exp(2.0) + 0.8) / (libm::exp(2.0) + 1.0);
        assert!((mu(&found, &anchors) - expected).abs() < 1e-12);
        assert_eq!(found.iter().map(|n| n.index).collect::<Vec<_>>(), [0, 1]);
    }

    #[test]
    fn a_latent_without_direction_still_has_a_mu_within_the_anchors() {
        let anchors = [anchor([1.0, 0.0], 0.2), anchor([0.0, 1.0], 0.8)];
        let how = FrictionDescription {
            top_k: 5,
            temperature: 0.05,
        };
        for z in [[0.0, 0.0], [f32::NAN, 1.0], [f32::INFINITY, 0.0]] {
            assert!((mu(&neighbours(&z, &anchors, how), &anchors) - 0.5).abs() < 1e-12);
        }
    }
}
