//! Clusters of segments in the plane of speed and force.

use asperity_recording::steady::Segment;

/// Centres of clusters in the plane of speed and force. The first ones are far apart, and Lloyd's
/// steps move them to the middle of their segments.
pub(super) fn centres(segments: &[&Segment], count: usize, corner: (f64, f64)) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64, f64)> = segments
        .iter()
        .map(|s| {
            (
                s.speed_mm_s / corner.0,
                s.force_n / corner.1,
                s.length as f64,
            )
        })
        .collect();
    let distance = |p: &(f64, f64, f64), c: &(f64, f64)| (p.0 - c.0).powi(2) + (p.1 - c.1).powi(2);
    let nearest = |p: &(f64, f64, f64), all: &[(f64, f64)]| {
        all.iter()
            .map(|c| distance(p, c))
            .fold(f64::INFINITY, f64::min)
    };
    let total: f64 = points.iter().map(|p| p.2).sum();
    let mean = |pick: fn(&(f64, f64, f64)) -> f64| {
        points.iter().map(|p| p.2 * pick(p)).sum::<f64>() / total
    };
    let mut found = vec![(mean(|p| p.0), mean(|p| p.1))];
    while found.len() < count.min(points.len()) {
        let next = points
            .iter()
            .max_by(|a, b| nearest(a, &found).total_cmp(&nearest(b, &found)));
        let Some(next) = next.filter(|p| nearest(p, &found) > 1e-6) else {
            break;
        };
        found.push((next.0, next.1));
    }
    for _ in 0..30 {
        let mut sums = vec![(0.0, 0.0, 0.0); found.len()];
        for p in &points {
            let own = (0..found.len())
                .min_by(|&a, &b| distance(p, &found[a]).total_cmp(&distance(p, &found[b])))
                .unwrap_or(0);
            sums[own] = (
                sums[own].0 + p.2 * p.0,
                sums[own].1 + p.2 * p.1,
                sums[own].2 + p.2,
            );
        }
        let next: Vec<(f64, f64)> = sums
            .iter()
            .zip(&found)
            .map(|(s, old)| {
                if s.2 > 0.0 {
                    (s.0 / s.2, s.1 / s.2)
                } else {
                    *old
                }
            })
            .collect();
        if next == found {
            break;
        }
        found = next;
    }
    found
        .into_iter()
        .map(|(x, y)| (x * corner.0, y * corner.1))
        .collect()
}
