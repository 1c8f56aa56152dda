//! k-means on the speed–force plane: k-means++ seeding (Arthur and Vassilvitskii, 2007), Lloyd's
//! iterations, the best of several starts.
//!
//! We wrote it ourselves because the available crates need nightly SIMD or an array library, and
//! none promises the same centroids for a seed in its next version.

use crate::augment::Draws;

/// Largest number of iterations of a start; some tens usually suffice.
const ITERATIONS: usize = 300;

/// A point in standardised coordinates.
pub(super) type Point = [f64; 2];

/// Squared distance.
pub(super) fn distance(x: &Point, y: &Point) -> f64 {
    let (a, b) = (x[0] - y[0], x[1] - y[1]);
    a * a + b * b
}

/// Index of the nearest centroid; the first if several are equally near.
pub(super) fn nearest(point: &Point, centroids: &[Point]) -> usize {
    let mut best = (0, f64::INFINITY);
    for (index, centroid) in centroids.iter().enumerate() {
        let squared = distance(point, centroid);
        if squared < best.1 {
            best = (index, squared);
        }
    }
    best.0
}

/// `count` centroids of at least as many distinct points.
///
/// Of `restarts` starts (at least one) the one of least inertia counts. The same seed gives the
/// same centroids.
pub(super) fn centroids(points: &[Point], count: usize, restarts: usize, seed: u64) -> Vec<Point> {
    let mut best = (f64::INFINITY, Vec::new());
    for restart in 0..restarts.max(1) {
        let mut centroids = seeded(points, count, &mut Draws::new(seed, 0, restart));
        for _ in 0..ITERATIONS {
            let moved = means(points, &centroids);
            if moved == centroids {
                break;
            }
            centroids = moved;
        }
        let inertia: f64 = points
            .iter()
            .map(|point| distance(point, &centroids[nearest(point, &centroids)]))
            .sum();
        if inertia < best.0 {
            best = (inertia, centroids);
        }
    }
    best.1
}

/// Draws each further centre with a probability proportional to its squared distance from the
/// centres so far.
fn seeded(points: &[Point], count: usize, draws: &mut Draws) -> Vec<Point> {
    let mut centres = vec![points[draws.below(points.len())]];
    let mut squared = vec![f64::INFINITY; points.len()];
    while centres.len() < count {
        let latest = centres[centres.len() - 1];
        for (squared, point) in squared.iter_mut().zip(points) {
            *squared = squared.min(distance(point, &latest));
        }
        let mut left = draws.uniform() * squared.iter().sum::<f64>();
        // Rounding may leave a remainder: then the last point that is not yet a centre is drawn.
        let mut chosen = latest;
        for (squared, point) in squared
            .iter()
            .zip(points)
            .filter(|(squared, _)| **squared > 0.0)
        {
            chosen = *point;
            left -= squared;
            if left <= 0.0 {
                break;
            }
        }
        centres.push(chosen);
    }
    centres
}

/// Means of the points that are nearest to each centroid. A centroid without points stays.
fn means(points: &[Point], centroids: &[Point]) -> Vec<Point> {
    let mut sums = vec![[0.0; 3]; centroids.len()];
    for point in points {
        let sum = &mut sums[nearest(point, centroids)];
        *sum = [sum[0] + point[0], sum[1] + point[1], sum[2] + 1.0];
    }
    sums.iter()
        .zip(centroids)
        .map(|(sum, stays)| {
            if sum[2] > 0.0 {
                [sum[0] / sum[2], sum[1] / sum[2]]
            } else {
                *stays
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blobs around the nodes of a 3 × 6 lattice.
    fn blobs() -> (Vec<Point>, Vec<Point>) {
        let centres: Vec<Point> = (0..18)
            .map(|n| [f64::from(n % 6), 2.0 * f64::from(n / 6)])
            .collect();
        let mut draws = Draws::new(3, 0, 0);
        let points = centres
            .iter()
            .flat_map(|c| (0..20).map(|_| [c[0], c[1]]).collect::<Vec<_>>())
            .map(|[x, y]| [x + 0.05 * draws.normal(), y + 0.05 * draws.normal()])
            .collect();
        (points, centres)
    }

    #[test]
    fn separated_blobs_are_found() {
        let (points, centres) = blobs();
        let found = centroids(&points, 18, 16, 1);
        for centre in &centres {
            let near = distance(centre, &found[nearest(centre, &found)]).sqrt();
            assert!(near < 0.05, "{centre:?}: {near}");
        }
    }

    #[test]
    fn every_centroid_is_the_mean_of_its_points() {
        let mut draws = Draws::new(5, 0, 0);
        let points: Vec<Point> = (0..400).map(|_| [draws.normal(), draws.normal()]).collect();
        let found = centroids(&points, 18, 4, 1);
        assert_eq!(means(&points, &found), found);
        assert_eq!(centroids(&points, 18, 4, 1), found);
    }

    #[test]
    fn as_many_points_as_centroids_are_their_own_centroids() {
        let points: Vec<Point> = (0..18).map(|n| [f64::from(n), f64::from(n * n)]).collect();
        let mut found = centroids(&points, 18, 1, 9);
        found.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert_eq!(found, points);
    }
}
