//! Clusters of segments in the plane of speed and force.

use asperity_recording::segments::Segment;

/// Speed and force in parts of the corner, and height.
type Place = [f64; 3];
/// A segment with its weight.
type Point = (Place, f64);

/// Centres of clusters in the plane of speed and force. The first ones are far apart, and Lloyd's
/// steps move them to the middle of their segments.
///
/// Segments are as far apart as their places are, in parts of the `corner`, and their `heights`: a level that
/// is steep takes more clusters.
pub(super) fn centres(
    segments: &[&Segment],
    heights: &[f64],
    count: usize,
    corner: (f64, f64),
) -> Vec<(f64, f64)> {
    let points: Vec<Point> = segments
        .iter()
        .zip(heights)
        .map(|(s, height)| {
            let place = [s.speed_mm_s / corner.0, s.force_n / corner.1, *height];
            (place, s.length as f64)
        })
        .collect();
    let distance =
        |p: &Point, c: &Place| -> f64 { p.0.iter().zip(c).map(|(x, y)| (x - y).powi(2)).sum() };
    let nearest = |p: &Point, all: &[Place]| {
        all.iter()
            .map(|c| distance(p, c))
            .fold(f64::INFINITY, f64::min)
    };
    let total: f64 = points.iter().map(|p| p.1).sum();
    let middle = [0, 1, 2].map(|axis| points.iter().map(|p| p.1 * p.0[axis]).sum::<f64>() / total);
    let mut found: Vec<Place> = vec![middle];
    while found.len() < count.min(points.len()) {
        let next = points
            .iter()
            .max_by(|a, b| nearest(a, &found).total_cmp(&nearest(b, &found)));
        let Some(next) = next.filter(|p| nearest(p, &found) > 1e-6) else {
            break;
        };
        found.push(next.0);
    }
    for _ in 0..30 {
        let mut sums = vec![([0.0; 3], 0.0); found.len()];
        for p in &points {
            let own = (0..found.len())
                .min_by(|&a, &b| distance(p, &found[a]).total_cmp(&distance(p, &found[b])))
                .unwrap_or(0);
            let (sum, weight) = &mut sums[own];
            for (sum, x) in sum.iter_mut().zip(p.0) {
                *sum += p.1 * x;
            }
            *weight += p.1;
        }
        let next: Vec<Place> = sums
            .iter()
            .zip(&found)
            .map(|((sum, weight), old)| {
                if *weight > 0.0 {
                    sum.map(|x| x / weight)
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
        .map(|[x, y, _]| (x * corner.0, y * corner.1))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_vertices_stand_where_the_level_is_steep() {
        let segments: Vec<Segment> = (0..400)
            .map(|n| Segment {
                start: 0,
                length: 400,
                speed_mm_s: 10.0 + 10.0 * f64::from(n % 20),
                force_n: 0.1 + 0.1 * f64::from(n / 20),
                lags: Vec::new(),
                power: Vec::new(),
                is_steady: true,
                statistic: 0.0,
            })
            .collect();
        let all: Vec<&Segment> = segments.iter().collect();
        let slow = |steepness: f64| {
            let heights: Vec<f64> = segments
                .iter()
                .map(|s| steepness * 4.0 * libm::log(s.speed_mm_s))
                .collect();
            let found = centres(&all, &heights, 16, (200.0, 2.0));
            assert_eq!(found.len(), 16);
            found.iter().filter(|place| place.0 < 60.0).count()
        };
        assert!(slow(0.15) > slow(0.0) + 2, "{} {}", slow(0.15), slow(0.0));
    }
}
