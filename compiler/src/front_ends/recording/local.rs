//! What the segments near a speed and a force say: local regression of levels and autocorrelations.
//!
//! Both are linear in ln v and ln F over a neighbourhood: the level as a logarithm, so that a power
//! law is met exactly, the normalised autocorrelation as it is. The width of the neighbourhood is
//! that which predicts held-out segments best.

use asperity_recording::steady::{LAGS, Segment, Steady};

/// Offsets of the logarithms: below them, speed and force count linearly.
const OFFSETS: (f64, f64) = (10.0, 0.1);
/// Least part of the power that is believed to be signal where the sensors' noise is subtracted.
const LEAST_SIGNAL: f64 = 0.02;
/// Ridge of the regression, in units of the weight of one mean segment: with few neighbours the
/// slopes are small.
const RIDGE: f64 = 0.3;

/// A segment, ready to be regressed.
#[derive(Debug, Clone)]
struct Row {
    place: [f64; 2],
    weight: f64,
    ln_power: f64,
    shape: Vec<f64>,
}

/// The segments of a recording, in coordinates of unit variance.
#[derive(Debug, Clone)]
pub(super) struct Local {
    rows: Vec<Row>,
    centre: [f64; 2],
    scale: [f64; 2],
}

/// What is so at a speed and a force.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Estimate {
    /// Autocorrelation at lags 0..=[`LAGS`], (m/s²)².
    pub(super) lags: Vec<f64>,
    /// Samples that it rests on.
    pub(super) samples: f64,
}

fn coordinates(speed_mm_s: f64, force_n: f64) -> [f64; 2] {
    [
        libm::log(speed_mm_s + OFFSETS.0),
        libm::log(force_n.max(0.0) + OFFSETS.1),
    ]
}

impl Local {
    /// Of segments, with the sensors' noise taken away.
    pub(super) fn new<'a>(steady: &Steady, segments: impl Iterator<Item = &'a Segment>) -> Self {
        let silent = vec![0.0; LAGS + 1];
        let noise = steady.noise_lags.as_ref().unwrap_or(&silent);
        let mut rows: Vec<Row> = segments
            .map(|segment| {
                let share =
                    (noise[0] / segment.lags[0]).min(1.0 - LEAST_SIGNAL) / noise[0].max(1e-300);
                let lags: Vec<f64> = segment
                    .lags
                    .iter()
                    .zip(noise)
                    .map(|(r, n)| r - share * segment.lags[0] * n)
                    .collect();
                Row {
                    place: coordinates(segment.speed_mm_s, segment.force_n),
                    weight: segment.length as f64,
                    ln_power: libm::log(lags[0]),
                    shape: lags.iter().map(|r| r / lags[0]).collect(),
                }
            })
            .collect();
        let total: f64 = rows.iter().map(|row| row.weight).sum();
        let moment = |about: [f64; 2], power: i32, axis: usize| {
            rows.iter()
                .map(|row| row.weight * libm::pow(row.place[axis] - about[axis], f64::from(power)))
                .sum::<f64>()
                / total
        };
        let centre = [0, 1].map(|axis| moment([0.0; 2], 1, axis));
        let scale = [0, 1].map(|axis| moment(centre, 2, axis).sqrt().max(0.05));
        for row in &mut rows {
            row.place = [0, 1].map(|axis| (row.place[axis] - centre[axis]) / scale[axis]);
        }
        Self {
            rows,
            centre,
            scale,
        }
    }

    /// The estimate at a place from a neighbourhood of a width in standard deviations; `None` of no
    /// segments.
    pub(super) fn at(&self, speed_mm_s: f64, force_n: f64, width: f64) -> Option<Estimate> {
        let place = coordinates(speed_mm_s, force_n);
        let place = [0, 1].map(|axis| (place[axis] - self.centre[axis]) / self.scale[axis]);
        let mean_weight =
            self.rows.iter().map(|row| row.weight).sum::<f64>() / self.rows.len() as f64;
        let mut near: Vec<(&Row, [f64; 2], f64)> = self
            .rows
            .iter()
            .map(|row| {
                let away = [0, 1].map(|axis| row.place[axis] - place[axis]);
                let distance = (away[0] * away[0] + away[1] * away[1]) / (width * width);
                (row, away, row.weight * libm::exp(-0.5 * distance))
            })
            .collect();
        let samples: f64 = near.iter().map(|(.., w)| w).sum();
        if samples <= 1e-6 * mean_weight {
            return None;
        }
        near.retain(|(.., w)| *w > 1e-4 * mean_weight);
        // The same regression for every quantity: a row of the solution gives the value at the place.
        let mut normal = [[0.0; 3]; 3];
        for (_, [x, y], w) in &near {
            let row = [1.0, *x, *y];
            for i in 0..3 {
                for j in 0..3 {
                    normal[i][j] += w * row[i] * row[j];
                }
            }
        }
        normal[1][1] += RIDGE * mean_weight;
        normal[2][2] += RIDGE * mean_weight;
        let first = first_row_of_inverse(&normal)?;
        let shares: Vec<f64> = near
            .iter()
            .map(|(_, [x, y], w)| w * (first[0] + first[1] * x + first[2] * y))
            .collect();
        let power = libm::exp(
            near.iter()
                .zip(&shares)
                .map(|((row, ..), s)| s * row.ln_power)
                .sum(),
        );
        let lags = (0..=LAGS)
            .map(|lag| {
                power
                    * near
                        .iter()
                        .zip(&shares)
                        .map(|((row, ..), s)| s * row.shape[lag])
                        .sum::<f64>()
            })
            .collect();
        // The variance of the value is Σ s²/length.
        let variance: f64 = near
            .iter()
            .zip(&shares)
            .map(|((row, ..), s)| s * s / row.weight)
            .sum();
        Some(Estimate {
            lags,
            samples: 1.0 / variance,
        })
    }
}

fn first_row_of_inverse(m: &[[f64; 3]; 3]) -> Option<[f64; 3]> {
    let cofactor = |i: usize, j: usize| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let (c, d) = ((j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let row = [cofactor(0, 0), cofactor(1, 0), cofactor(2, 0)];
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    (determinant.abs() > 1e-300).then(|| row.map(|x| x / determinant))
}
