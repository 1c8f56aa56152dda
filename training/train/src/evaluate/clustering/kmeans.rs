//! k-means by Lloyd's iterations: one deterministic farthest-point start, then restarts
//! seeded by k-means++ (Arthur and Vassilvitskii, 2007); the smallest inertia counts.

use crate::rng::Stream;
use asperity::learned::Latent;
use rayon::prelude::*;

/// Iterations of one start, at most.
const ITERATIONS: usize = 100;

/// Cluster of every point: the best of `restarts` starts, one at least.
pub(super) fn cluster(points: &[Latent], k: usize, restarts: usize, seed: u64) -> Vec<usize> {
    let k = k.clamp(1, points.len().max(1));
    let mut best: Option<(f64, Vec<usize>)> = None;
    for restart in 0..restarts.max(1) {
        let start = if restart == 0 {
            farthest_points(points, k)
        } else {
            plus_plus(
                points,
                k,
                &mut Stream::seeded(seed.wrapping_add(restart as u64)),
            )
        };
        let (inertia, labels) = lloyd(points, start);
        if best.as_ref().is_none_or(|(least, _)| inertia < *least) {
            best = Some((inertia, labels));
        }
    }
    best.map(|(_, labels)| labels).unwrap_or_default()
}

/// Squared Euclidean distance.
pub(super) fn square_distance(x: &Latent, y: &Latent) -> f32 {
    x.iter().zip(y).map(|(x, y)| (x - y) * (x - y)).sum()
}

/// The point farthest from the mean, then always the one farthest from all chosen.
fn farthest_points(points: &[Latent], k: usize) -> Vec<Latent> {
    let all: Vec<usize> = (0..points.len()).collect();
    let mean = centre(points, &all);
    let mut nearest: Vec<f32> = points.iter().map(|x| square_distance(x, &mean)).collect();
    let mut chosen: Vec<Latent> = Vec::with_capacity(k);
    while chosen.len() < k {
        let far = farthest(&nearest);
        if chosen.is_empty() {
            nearest.fill(f32::INFINITY);
        }
        chosen.push(points[far]);
        approach(points, &points[far], &mut nearest);
    }
    chosen
}

fn plus_plus(points: &[Latent], k: usize, draws: &mut Stream) -> Vec<Latent> {
    let first = draws.below(points.len());
    let mut nearest = vec![f32::INFINITY; points.len()];
    let mut chosen = vec![points[first]];
    approach(points, &points[first], &mut nearest);
    while chosen.len() < k {
        let total: f64 = nearest.iter().map(|&x| f64::from(x)).sum();
        let mut left = draws.uniform_f64() * total;
        let next = nearest.iter().position(|&x| {
            left -= f64::from(x);
            left < 0.0
        });
        let next = next.unwrap_or_else(|| farthest(&nearest));
        chosen.push(points[next]);
        approach(points, &points[next], &mut nearest);
    }
    chosen
}

/// Lowers the distance of every point to that of a new centre.
fn approach(points: &[Latent], centre: &Latent, nearest: &mut [f32]) {
    for (x, nearest) in points.iter().zip(nearest) {
        *nearest = nearest.min(square_distance(x, centre));
    }
}

fn farthest(distances: &[f32]) -> usize {
    let ranked = distances.iter().enumerate();
    ranked
        .max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)))
        .map_or(0, |(index, _)| index)
}

fn lloyd(points: &[Latent], mut centres: Vec<Latent>) -> (f64, Vec<usize>) {
    let mut labels = vec![usize::MAX; points.len()];
    let mut inertia = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let nearest: Vec<(usize, f32)> = points.par_iter().map(|x| nearest(x, &centres)).collect();
        let moved = nearest.iter().zip(&labels).any(|(new, old)| new.0 != *old);
        labels = nearest.iter().map(|x| x.0).collect();
        inertia = nearest.iter().map(|x| f64::from(x.1)).sum();
        if !moved {
            break;
        }
        let mut members = vec![Vec::new(); centres.len()];
        for (index, &label) in labels.iter().enumerate() {
            members[label].push(index);
        }
        let mut away: Vec<f32> = nearest.iter().map(|x| x.1).collect();
        for (new, members) in centres.iter_mut().zip(&members) {
            if members.is_empty() {
                // A centre without points goes where it is missed most.
                let far = farthest(&away);
                away[far] = 0.0;
                *new = points[far];
            } else {
                *new = centre(points, members);
            }
        }
    }
    (inertia, labels)
}

fn nearest(x: &Latent, centres: &[Latent]) -> (usize, f32) {
    let mut best = (0, f32::INFINITY);
    for (index, centre) in centres.iter().enumerate() {
        let distance = square_distance(x, centre);
        if distance < best.1 {
            best = (index, distance);
        }
    }
    best
}

/// Mean of some points.
pub(super) fn centre(points: &[Latent], members: &[usize]) -> Latent {
    let count = members.len().max(1) as f64;
    std::array::from_fn(|axis| {
        let sum: f64 = members.iter().map(|&m| f64::from(points[m][axis])).sum();
        (sum / count) as f32
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separate_clouds_are_found_whatever_the_start() {
        let mut draws = Stream::seeded(3);
        let mut points: Vec<Latent> = Vec::new();
        for cloud in 0..6 {
            for _ in 0..10 {
                points.push(std::array::from_fn(|axis| {
                    5.0 * f32::from(u8::from(axis == cloud)) + 0.1 * draws.uniform_f64() as f32
                }));
            }
        }
        for restarts in [1, 4] {
            let labels = cluster(&points, 6, restarts, 1);
            for (index, label) in labels.iter().enumerate() {
                assert_eq!(*label, labels[10 * (index / 10)]);
            }
            let distinct: std::collections::BTreeSet<_> = labels.iter().collect();
            assert_eq!(distinct.len(), 6);
        }
    }
}
