//! What the segments near a speed and a force say: local regression of spectra.
//!
//! In every band the logarithm of the power is linear in ln v and ln F over a neighbourhood, so that a power
//! law is met exactly; within a band the power over the band's is linear. The width of the neighbourhood
//! is that which predicts held-out segments best.
//!
//! The sensors' noise N adds to the power L of a band, and what is measured varies as (L + N)². A
//! logarithm of what is left after N is subtracted would be biased where L is small, and may not exist.
//! So L is the generalised linear model E\[P\] = exp(β·x) + N (McCullagh and Nelder, 1989) by
//! Fisher's scoring, in which a segment weighs (L/(L + N))² of its time. Where the noise hides a band,
//! the louder segments of the neighbourhood say how it goes on.

use asperity_recording::{
    steady::{BAND_HZ, LAGS, POINTS, Segment, Steady, frequencies_hz},
    timeline::RATE_HZ,
};
use std::f64::consts::TAU;

/// Offsets of the logarithms: below them, speed and force count linearly.
const OFFSETS: (f64, f64) = (3.0, 0.03);
/// Bands of the regression, some 31 Hz each.
const BANDS: usize = 14;
/// Least part of the noise that the power of a band is believed to be.
const LEAST_SIGNAL: f64 = 0.003;
/// Least power of a frequency relative to its band.
const LEAST_SHAPE: f64 = 0.02;
/// Ridge of the regression, in units of the weight of one mean segment: with few neighbours the
/// slopes are small.
const RIDGE: f64 = 0.3;
/// Spread of the power of a frequency about that of its band, as a part of it.
const CONTRAST: f64 = 0.5;
/// Spread of the power of a band about a power law over the whole plane, nepers.
const SPREAD: f64 = 0.7;
/// Steps of Fisher's scoring, and the largest change of a coefficient in one.
const STEPS: usize = 12;
const LARGEST_STEP: f64 = 2.0;

/// A segment, ready to be regressed.
#[derive(Debug, Clone)]
struct Row {
    place: [f64; 2],
    weight: f64,
    /// Power at every frequency and of every band, noise included.
    power: Vec<f64>,
    bands: Vec<f64>,
}

/// The segments of a recording, in coordinates of unit variance.
#[derive(Debug, Clone)]
pub(super) struct Local {
    rows: Vec<Row>,
    /// Power of the sensors' noise at every frequency and of every band.
    noise: Vec<f64>,
    noise_bands: Vec<f64>,
    centre: [f64; 2],
    scale: [f64; 2],
    /// Power law of every band over the whole plane, about its centre.
    everywhere: Vec<[f64; 3]>,
    /// From powers to an autocorrelation.
    transform: Transform,
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

/// A segment near a place, the way to it, and its weight in samples.
type Near<'a> = (&'a Row, [f64; 2], f64);

impl Local {
    /// Of segments, under the sensors' noise.
    pub(super) fn new<'a>(steady: &Steady, segments: impl Iterator<Item = &'a Segment>) -> Self {
        let mut rows: Vec<Row> = segments
            .map(|segment| Row {
                place: coordinates(segment.speed_mm_s, segment.force_n),
                weight: segment.length as f64,
                power: segment.power.clone(),
                bands: bands(&segment.power),
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
        let noise = steady
            .noise_power
            .clone()
            .unwrap_or_else(|| vec![0.0; POINTS]);
        let noise_bands = bands(&noise);
        let all: Vec<Near<'_>> = rows
            .iter()
            .map(|row| (row, row.place, row.weight))
            .collect();
        let slopes = RIDGE * total / rows.len().max(1) as f64;
        let everywhere = noise_bands
            .iter()
            .enumerate()
            .map(|(band, noise)| {
                Fit::new(&all, band, *noise, slopes, None).map_or([0.0; 3], |fit| fit.beta)
            })
            .collect();
        Self {
            rows,
            noise_bands,
            noise,
            centre,
            scale,
            everywhere,
            transform: Transform::new(),
        }
    }

    /// The estimate at a place from a neighbourhood of a width in standard deviations; `None` of no
    /// segments.
    pub(super) fn at(&self, speed_mm_s: f64, force_n: f64, width: f64) -> Option<Estimate> {
        let place = coordinates(speed_mm_s, force_n);
        let place = [0, 1].map(|axis| (place[axis] - self.centre[axis]) / self.scale[axis]);
        let mean_weight =
            self.rows.iter().map(|row| row.weight).sum::<f64>() / self.rows.len() as f64;
        let mut near: Vec<Near<'_>> = self
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
        let slopes = RIDGE * mean_weight;
        // Where the noise hides a band, it is as loud as the power law of the plane says, beside the
        // other bands.
        let laws: Vec<[f64; 3]> = self
            .everywhere
            .iter()
            .map(|[value, x, y]| [value + x * place[0] + y * place[1], *x, *y])
            .collect();
        let (mut offset, mut weight) = (0.0, 0.0);
        for (band, law) in laws.iter().enumerate() {
            let noise = self.noise_bands[band];
            let fit = Fit::new(&near, band, noise, slopes, Some(*law))?;
            offset += fit.weight * (fit.beta[0] - law[0]);
            weight += fit.weight;
        }
        offset /= weight;
        let mut power = vec![0.0; POINTS];
        let mut variance = 0.0;
        for (band, power) in power.chunks_exact_mut(POINTS / BANDS).enumerate() {
            let [value, x, y] = laws[band];
            let law = [value + offset, x, y];
            variance += self.band(&near, band, slopes, law, power)? / BANDS as f64;
        }
        Some(Estimate {
            lags: self.transform.lags(&power),
            samples: 1.0 / variance,
        })
    }

    /// The powers of a band at the place; returns the relative variance of its level, 1/samples.
    fn band(
        &self,
        near: &[Near<'_>],
        band: usize,
        slopes: f64,
        law: [f64; 3],
        power: &mut [f64],
    ) -> Option<f64> {
        let noise = self.noise_bands[band];
        let fit = Fit::new(near, band, noise, slopes, Some(law))?;
        let parts: Vec<(f64, f64)> = near
            .iter()
            .map(|(_, away, _)| {
                let level = fit.level(*away);
                (level, level / (level + noise))
            })
            .collect();
        let mut normal = ridge(slopes, 0.0);
        for ((_, [x, y], w), (_, part)) in near.iter().zip(&parts) {
            add(&mut normal, [1.0, *x, *y], w * part * part);
        }
        let first = inverse(&normal)?[0];
        let (mut variance, mut of_shape) = (0.0, 0.0);
        let mut shape = vec![0.0; power.len()];
        for ((row, [x, y], w), (level, part)) in near.iter().zip(&parts) {
            let share = w * part * part * (first[0] + first[1] * x + first[2] * y);
            let own = (share / part).powi(2);
            variance += own / row.weight;
            of_shape += own;
            let from = band * power.len();
            for (k, sum) in shape.iter_mut().enumerate() {
                *sum += share * (row.power[from + k] - self.noise[from + k]) / level;
            }
        }
        // A frequency of a segment varies as much as it is strong. What noise makes of the shape is no
        // shape, and does not change the power of the band.
        let kept = CONTRAST * CONTRAST / (CONTRAST * CONTRAST + of_shape);
        for x in &mut shape {
            *x = (1.0 + kept * (*x - 1.0)).max(LEAST_SHAPE);
        }
        let scale = fit.level([0.0; 2]) * shape.len() as f64 / shape.iter().sum::<f64>();
        for (power, shape) in power.iter_mut().zip(shape) {
            *power = scale * shape;
        }
        Some(variance)
    }
}

fn bands(power: &[f64]) -> Vec<f64> {
    let size = POINTS / BANDS;
    power
        .chunks_exact(size)
        .map(|band| band.iter().sum::<f64>() / size as f64)
        .collect()
}

/// The power of a band around a place: its logarithm there and the slopes.
struct Fit {
    beta: [f64; 3],
    least: f64,
    /// Samples without noise that know as much of the value.
    weight: f64,
}

impl Fit {
    /// `law` is what the value and the slopes are without any segment.
    fn new(
        near: &[Near<'_>],
        band: usize,
        noise: f64,
        slopes: f64,
        law: Option<[f64; 3]>,
    ) -> Option<Self> {
        let samples: f64 = near.iter().map(|(.., w)| w).sum();
        let mean = near
            .iter()
            .map(|(row, _, w)| w * row.bands[band])
            .sum::<f64>()
            / samples;
        let least = (LEAST_SIGNAL * noise).max(1e-9 * mean).max(1e-300);
        let start = libm::log((mean - noise).max(least));
        let prior = law.unwrap_or([start, 0.0, 0.0]);
        // A band of 1/14 of the width tells its level to 1/√(samples/14).
        let held = law.map_or(1e-6 * samples, |_| BANDS as f64 / (SPREAD * SPREAD));
        let mut fit = Self {
            beta: [start, prior[1], prior[2]],
            least,
            weight: 0.0,
        };
        for _ in 0..STEPS {
            let mut normal = ridge(slopes, held);
            let mut gradient = [0, 1, 2].map(|k| normal[k][k] * (prior[k] - fit.beta[k]));
            fit.weight = 0.0;
            for (row, away, w) in near {
                let level = fit.level(*away);
                let weight = w * (level / (level + noise)).powi(2);
                let terms = [1.0, away[0], away[1]];
                add(&mut normal, terms, weight);
                fit.weight += weight;
                let residual = (row.bands[band] - level - noise) / level;
                for (sum, x) in gradient.iter_mut().zip(terms) {
                    *sum += weight * residual * x;
                }
            }
            let step = inverse(&normal)?
                .map(|row| row.iter().zip(gradient).map(|(x, y)| x * y).sum::<f64>());
            for (x, step) in fit.beta.iter_mut().zip(step) {
                *x += step.clamp(-LARGEST_STEP, LARGEST_STEP);
            }
            if step.iter().all(|step| step.abs() < 1e-3) {
                break;
            }
        }
        Some(fit)
    }

    /// Power at a place this far away, (m/s²)².
    fn level(&self, [x, y]: [f64; 2]) -> f64 {
        let [value, slope_x, slope_y] = self.beta;
        libm::exp((value + slope_x * x + slope_y * y).clamp(-100.0, 100.0)).max(self.least)
    }
}

/// The inverse cosine transform of a spectrum that goes on at its ends.
#[derive(Debug, Clone)]
struct Transform {
    /// Frequencies below and above those of a segment.
    beyond: (usize, usize),
    /// Cosines of every lag at every frequency.
    cosines: Vec<Vec<f64>>,
}

/// Frequencies at each end whose mean goes on.
const ENDS: usize = 12;

impl Transform {
    fn new() -> Self {
        let inner = frequencies_hz();
        let step_hz = (BAND_HZ.1 - BAND_HZ.0) / (POINTS - 1) as f64;
        let below = (BAND_HZ.0 / step_hz) as usize;
        let above = ((0.5 * RATE_HZ - BAND_HZ.1) / step_hz) as usize;
        let all = (0..below)
            .map(|n| (n as f64 + 0.5) * BAND_HZ.0 / below as f64)
            .chain(inner)
            .chain((1..=above).map(|n| BAND_HZ.1 + n as f64 * step_hz));
        let cosines = all
            .map(|freq_hz| {
                (0..=LAGS)
                    .map(|lag| libm::cos(TAU * freq_hz / RATE_HZ * lag as f64))
                    .collect()
            })
            .collect();
        Self {
            beyond: (below, above),
            cosines,
        }
    }

    fn lags(&self, power: &[f64]) -> Vec<f64> {
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (low, high) = (mean(&power[..ENDS]), mean(&power[POINTS - ENDS..]));
        let all = std::iter::repeat_n(low, self.beyond.0)
            .chain(power.iter().copied())
            .chain(std::iter::repeat_n(high, self.beyond.1));
        let mut lags = vec![0.0; LAGS + 1];
        for (power, cosines) in all.zip(&self.cosines) {
            for (sum, cosine) in lags.iter_mut().zip(cosines) {
                *sum += power * cosine;
            }
        }
        let count = self.cosines.len() as f64;
        lags.into_iter().map(|lag| lag / count).collect()
    }
}

/// The normal equations before any segment.
fn ridge(slopes: f64, value: f64) -> [[f64; 3]; 3] {
    [[value, 0.0, 0.0], [0.0, slopes, 0.0], [0.0, 0.0, slopes]]
}

fn add(normal: &mut [[f64; 3]; 3], terms: [f64; 3], weight: f64) {
    for (row, x) in normal.iter_mut().zip(terms) {
        for (sum, y) in row.iter_mut().zip(terms) {
            *sum += weight * x * y;
        }
    }
}

/// The inverse of a symmetric matrix.
fn inverse(m: &[[f64; 3]; 3]) -> Option<[[f64; 3]; 3]> {
    let cofactor = |i: usize, j: usize| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        let (c, d) = ((j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    (determinant.abs() > 1e-300)
        .then(|| [0, 1, 2].map(|i| [0, 1, 2].map(|j| cofactor(j, i) / determinant)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        front_ends::recording::vertex::{Form, vertex},
        model::Numerator,
        signal::{lsf, spectrum::squared_magnitude},
    };

    const NOISE: f64 = 1.0;
    const A: [f64; 3] = [1.0, -0.9, 0.5];

    /// Power of an AR model whose level is a power law.
    fn truth(speed_mm_s: f64, force_n: f64, freq_hz: f64) -> f64 {
        let level = 4.0 * libm::pow(speed_mm_s / 100.0, 1.4) * libm::pow(force_n, 0.8);
        level / squared_magnitude(&A, TAU * freq_hz / RATE_HZ)
    }

    /// Segments of half a second at irregular places, under white noise.
    fn steady(noise_is_known: bool) -> Steady {
        let mut state = 9_u64;
        let mut unit = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as f64 + 0.5) / f64::from(1_u32 << 31)
        };
        let segments = (0..150)
            .map(|n| {
                let speed_mm_s = 12.0 * libm::pow(16.0, unit());
                let force_n = 0.25 * libm::pow(8.0, unit());
                let power: Vec<f64> = frequencies_hz()
                    .into_iter()
                    .map(|f| -libm::log(unit()) * (truth(speed_mm_s, force_n, f) + NOISE))
                    .collect();
                Segment {
                    start: 500 * n,
                    length: 500,
                    speed_mm_s,
                    force_n,
                    lags: vec![power.iter().sum::<f64>() / POINTS as f64; LAGS + 1],
                    power,
                    statistic: 0.0,
                }
            })
            .collect();
        Steady {
            segments,
            noise_lags: None,
            noise_power: noise_is_known.then(|| vec![NOISE; POINTS]),
            rejected: 0,
        }
    }

    /// Mean and RMS of the model over the truth, dB.
    fn error_db(steady: &Steady, speed_mm_s: f64, force_n: f64) -> (f64, f64) {
        let local = Local::new(steady, steady.segments.iter());
        let lags = local.at(speed_mm_s, force_n, 0.5).expect("segments").lags;
        let form = Form {
            order: 6,
            numerator: Numerator::None,
        };
        let found = vertex(speed_mm_s, force_n, &lags, form).expect("a model");
        let a = lsf::to_polynomial(&found.lsf_rad);
        let db: Vec<f64> = frequencies_hz()
            .into_iter()
            .map(|freq_hz| {
                let power = found.sigma_m_s2 * found.sigma_m_s2
                    / squared_magnitude(&a, TAU * freq_hz / RATE_HZ);
                10.0 * libm::log10(power / truth(speed_mm_s, force_n, freq_hz))
            })
            .collect();
        let mean = db.iter().sum::<f64>() / POINTS as f64;
        let square = db.iter().map(|x| x * x).sum::<f64>() / POINTS as f64;
        (mean, square.sqrt())
    }

    #[test]
    fn an_ar_model_under_white_noise_of_known_power_comes_back_without_bias() {
        // The mean power is 4 dB above the noise, and 5 dB below it.
        for (speed_mm_s, force_n) in [(80.0, 0.8), (25.0, 0.5)] {
            let (mean, rms) = error_db(&steady(true), speed_mm_s, force_n);
            assert!(mean.abs() < 0.7 && rms < 1.2, "{mean} {rms}");
        }
        let (mean, _) = error_db(&steady(false), 25.0, 0.5);
        assert!(
            mean > 5.0,
            "noise that is not known counts as signal: {mean}"
        );
    }

    #[test]
    fn the_lags_of_a_spectrum_are_those_of_its_model() {
        let power: Vec<f64> = frequencies_hz()
            .into_iter()
            .map(|freq_hz| 1.0 / squared_magnitude(&[1.0, -0.5], TAU * freq_hz / RATE_HZ))
            .collect();
        // r_k = 0.5^k/(1 − 0.25).
        let lags = Transform::new().lags(&power);
        for (k, r) in lags.iter().take(5).enumerate() {
            let expected = libm::pow(0.5, k as f64) / 0.75;
            assert!((r - expected).abs() < 0.02, "{k}: {r} {expected}");
        }
    }
}
