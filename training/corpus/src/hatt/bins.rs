//! The unified grid: clusters of the samples of all materials.

use super::kmeans::{self, Point};
use crate::{BINS, Bin, UnifiedGrid};

/// Margin of the grid beyond the largest sample, relative to it.
const BEYOND: f64 = 0.02;
/// Starts of the clustering, of which the best one counts, and their seed.
const RESTARTS: usize = 32;
const SEED: u64 = 1;

/// The unified grid, and the scales on which distances to its bins are measured.
#[derive(Debug, Clone)]
pub(super) struct Bins {
    pub grid: UnifiedGrid,
    mean: Point,
    deviation: Point,
    /// Standardised centres, in the order of the grid.
    centroids: Vec<Point>,
}

impl Bins {
    /// Clusters samples at [`BINS`] or more distinct places: both coordinates are standardised to
    /// zero mean and unit deviation, then k-means runs.
    pub(super) fn of(samples: &[Bin]) -> Self {
        let count = samples.len() as f64;
        let axis = |of: fn(&Bin) -> f64| {
            let mean = samples.iter().map(of).sum::<f64>() / count;
            let variance = samples
                .iter()
                .map(|s| (of(s) - mean) * (of(s) - mean))
                .sum::<f64>()
                / count;
            // If all samples have one speed or one force, that axis does not count.
            let deviation = if variance > 0.0 { variance.sqrt() } else { 1.0 };
            (mean, deviation, samples.iter().map(of).fold(0.0, f64::max))
        };
        let (speed, force) = (axis(|s| s.speed_mm_s), axis(|s| s.force_n));
        let (mean, deviation) = ([speed.0, force.0], [speed.1, force.1]);
        let points: Vec<Point> = samples
            .iter()
            .map(|s| standardised(s.speed_mm_s, s.force_n, mean, deviation))
            .collect();
        let mut centroids = kmeans::centroids(&points, BINS, RESTARTS, SEED);
        centroids.sort_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
        let bins = centroids
            .iter()
            .map(|c| Bin {
                speed_mm_s: c[0] * deviation[0] + mean[0],
                force_n: c[1] * deviation[1] + mean[1],
            })
            .collect();
        Self {
            grid: UnifiedGrid {
                bins,
                max_speed_mm_s: speed.2 * (1.0 + BEYOND),
                max_force_n: force.2 * (1.0 + BEYOND),
            },
            mean,
            deviation,
            centroids,
        }
    }

    /// The bin that a place falls in.
    pub(super) fn nearest(&self, speed_mm_s: f64, force_n: f64) -> usize {
        let point = standardised(speed_mm_s, force_n, self.mean, self.deviation);
        kmeans::nearest(&point, &self.centroids)
    }
}

fn standardised(speed_mm_s: f64, force_n: f64, mean: Point, deviation: Point) -> Point {
    [
        (speed_mm_s - mean[0]) / deviation[0],
        (force_n - mean[1]) / deviation[1],
    ]
}
