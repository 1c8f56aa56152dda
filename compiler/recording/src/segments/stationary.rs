//! Stationarity test of a stretch against its speed and load: a knock or a landing is no texture.

use super::Segment;
use crate::{least_squares::solve, signal::quantile::mean, timeline::Timeline};
use asperity_texture::signal::levinson;

/// Parts of a stretch whose energies are compared.
pub(super) const PARTS: usize = 4;
/// Order of the filter that whitens before the comparison.
pub(super) const WHITENER: usize = 10;
/// Bartlett's statistic above which a stretch is not stationary. Its 10⁻⁵ quantile is 25.9; a speed
/// within its bounds adds some.
pub(super) const LARGEST_STATISTIC: f64 = 34.0;
/// Speed and load count linearly below these, mm/s and N.
const OFFSETS: [f64; 2] = [3.0, 0.03];
/// Ridge of the regression, samples: where all segments lie at one place, the exponents stay small.
const RIDGE: f64 = 300.0;

/// Power law of a recording's level against speed and load, by least squares over its segments.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Law {
    /// Exponents of speed and load.
    exponents: [f64; 2],
}

impl Law {
    /// Fits the law to segments, weighted by their lengths.
    pub(super) fn of(segments: &[Segment]) -> Self {
        let rows = || {
            segments.iter().filter(|s| s.lags[0] > 0.0).map(|s| {
                let [v, f] = coordinates(s.speed_mm_s, s.force_n);
                ([1.0, v, f], libm::log(s.lags[0]), s.length as f64)
            })
        };
        let total: f64 = rows().map(|row| row.2).sum();
        let centre =
            [0, 1, 2].map(|k| rows().map(|(x, _, w)| w * x[k]).sum::<f64>() / total.max(1.0));
        let mut normal = vec![vec![RIDGE, 0.0], vec![0.0, RIDGE]];
        let mut right = vec![0.0; 2];
        for (x, level, weight) in rows() {
            let away = [x[1] - centre[1], x[2] - centre[2]];
            for i in 0..2 {
                right[i] += weight * away[i] * level;
                for j in 0..2 {
                    normal[i][j] += weight * away[i] * away[j];
                }
            }
        }
        let exponents = solve(normal, right).and_then(|found| found.try_into().ok());
        Self {
            exponents: exponents.unwrap_or_default(),
        }
    }

    /// The level of every part of a segment over that of its mean speed and load.
    pub(super) fn levels(&self, timeline: &Timeline, segment: &Segment) -> [f64; PARTS] {
        let middle = coordinates(segment.speed_mm_s, segment.force_n);
        let part = segment.length / PARTS;
        std::array::from_fn(|index| {
            let from = segment.start + index * part;
            let here = coordinates(
                mean(&timeline.speed_mm_s[from..from + part]),
                mean(&timeline.load_n[from..from + part]),
            );
            let ln: f64 = (0..2)
                .map(|axis| self.exponents[axis] * (here[axis] - middle[axis]))
                .sum();
            libm::exp(ln)
        })
    }
}

fn coordinates(speed_mm_s: f64, force_n: f64) -> [f64; 2] {
    [
        libm::log(speed_mm_s + OFFSETS[0]),
        libm::log(force_n.max(0.0) + OFFSETS[1]),
    ]
}

/// A filter that makes the mean spectrum of all segments flat.
pub(super) fn whitener(segments: &[Segment]) -> Vec<f64> {
    let mut mean = vec![0.0; WHITENER + 1];
    for segment in segments.iter().filter(|segment| segment.lags[0] > 0.0) {
        for (sum, r) in mean.iter_mut().zip(&segment.lags) {
            *sum += r / segment.lags[0];
        }
    }
    if mean[0] > 0.0 {
        mean[0] *= 1.0 + 1e-6;
        levinson::recursion(&mean).0
    } else {
        vec![1.0]
    }
}

/// Bartlett's statistic of the energies of the parts of a whitened stretch, each over the level that it
/// should have: χ² with three degrees of freedom for noise of these levels.
pub(super) fn bartlett(
    axes: &[Vec<f64>],
    start: usize,
    length: usize,
    whitener: &[f64],
    levels: [f64; PARTS],
) -> f64 {
    let part = length / PARTS;
    let energies: Vec<f64> = (0..PARTS)
        .map(|index| {
            let from = start + index * part;
            let energy = |axis: &Vec<f64>| -> f64 {
                (from..from + part)
                    .map(|n| {
                        let e: f64 = whitener
                            .iter()
                            .enumerate()
                            .map(|(k, a)| a * axis[n.saturating_sub(k)])
                            .sum();
                        e * e
                    })
                    .sum()
            };
            axes.iter().map(energy).sum::<f64>() / (part as f64 * levels[index])
        })
        .collect();
    let pooled = mean(&energies);
    if pooled <= 0.0 {
        return f64::INFINITY;
    }
    let freedom = part as f64;
    let sum: f64 = energies
        .iter()
        .map(|e| libm::log(pooled / e.max(1e-300)))
        .sum();
    let correction = 1.0 + (PARTS as f64 + 1.0) / (3.0 * PARTS as f64 * freedom);
    freedom * sum / correction
}
