//! Places of the vertices: clusters of segments in the plane of speed and force.

use crate::segments::{Segment, Segments};

/// Distance of a level e times as high, beside a way across the whole plane: vertices stand where the level is steep.
const STEEPNESS: f64 = 0.15;
/// Most of Lloyd's steps.
const STEPS: usize = 30;

/// Speed and force in parts of their largest, and height.
type ClusterPoint = [f64; 3];

/// Centres of at most `count` clusters, mm/s and N. The first ones are far apart, and Lloyd's steps move them to the
/// middle of their segments.
pub(super) fn centres(strokes: &Segments, segments: &[&Segment], count: usize) -> Vec<(f64, f64)> {
    let largest = |pick: fn(&Segment) -> f64| strokes.segments.iter().map(pick).fold(0.0, f64::max);
    let (speed, force) = (largest(|s| s.speed_mm_s), largest(|s| s.force_n));
    let points: Vec<(ClusterPoint, f64)> = segments
        .iter()
        .map(|s| {
            let height = STEEPNESS * ln_level(strokes, s);
            let place = [s.speed_mm_s / speed, s.force_n / force, height];
            (place, s.length as f64)
        })
        .collect();
    let mean = |points: &mut dyn Iterator<Item = &(ClusterPoint, f64)>| {
        let (mut sum, mut total) = ([0.0; 3], 0.0);
        for (place, weight) in points {
            total += weight;
            for (sum, x) in sum.iter_mut().zip(place) {
                *sum += weight * x;
            }
        }
        (total > 0.0).then(|| sum.map(|x| x / total))
    };
    let distance = |p: &ClusterPoint, c: &ClusterPoint| -> f64 {
        p.iter().zip(c).map(|(x, y)| (x - y).powi(2)).sum()
    };
    let nearest = |p: &ClusterPoint, all: &[ClusterPoint]| {
        let distances = all.iter().map(|c| distance(p, c)).enumerate();
        distances
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .unwrap_or((0, 0.0))
    };
    let mut found: Vec<ClusterPoint> = mean(&mut points.iter()).into_iter().collect();
    while found.len() < count {
        let farthest = points
            .iter()
            .map(|(place, _)| (place, nearest(place, &found).1))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        match farthest {
            Some((place, distance)) if distance > 1e-6 => found.push(*place),
            _ => break,
        }
    }
    for _ in 0..STEPS {
        let own: Vec<usize> = points.iter().map(|(p, _)| nearest(p, &found).0).collect();
        let next: Vec<ClusterPoint> = (0..found.len())
            .map(|n| {
                let mut near = points
                    .iter()
                    .zip(&own)
                    .filter(|(_, own)| **own == n)
                    .map(|p| p.0);
                mean(&mut near).unwrap_or(found[n])
            })
            .collect();
        if next == found {
            break;
        }
        found = next;
    }
    found
        .into_iter()
        .map(|[x, y, _]| (x * speed, y * force))
        .collect()
}

/// The logarithm of a segment's power without the sensors' noise, and of a fifth of the noise where there is less.
fn ln_level(strokes: &Segments, segment: &Segment) -> f64 {
    let noise = strokes.noise_lags.as_ref().map_or(0.0, |lags| lags[0]);
    libm::log((segment.lags[0] - noise).max(0.2 * noise).max(1e-300))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_vertices_stand_where_the_level_is_steep() {
        let slow = |exponent: f64| {
            let segment = |n| {
                let speed_mm_s = 10.0 + 10.0 * f64::from(n % 20);
                Segment {
                    start: 0,
                    length: 400,
                    speed_mm_s,
                    force_n: 0.1 + 0.1 * f64::from(n / 20),
                    lags: vec![libm::pow(speed_mm_s, exponent)],
                    power: Vec::new(),
                    is_steady: true,
                    statistic: 0.0,
                }
            };
            let strokes = Segments {
                segments: (0..400).map(segment).collect(),
                ..Segments::default()
            };
            let all: Vec<&Segment> = strokes.segments.iter().collect();
            let found = centres(&strokes, &all, 16);
            assert_eq!(found.len(), 16);
            found.iter().filter(|place| place.0 < 60.0).count()
        };
        assert!(slow(4.0) > slow(0.0) + 2, "{} {}", slow(4.0), slow(0.0));
    }
}
