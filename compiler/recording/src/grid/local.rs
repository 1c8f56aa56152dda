//! Local regression of the segments' spectra around a speed and a force.
//!
//! In every band the logarithm of the power is linear in ln v and ln F over a neighbourhood, so that a power
//! law is met exactly; within a band the power over the band's is linear. The width of the neighbourhood
//! is that which predicts held-out segments best.
//!
//! Where the sensors' noise hides a band, the louder segments of the neighbourhood say how it goes on, and
//! beyond them the power law of the whole plane. What noise makes of the shape within a band is shrunk
//! towards a flat one.

use super::band::{BANDS, Fit, Measured, add, inverse, ridge};
use crate::segments::{POINTS, Segment, Segments};

/// Offsets of the logarithms: below them, speed and force count linearly.
const OFFSETS: (f64, f64) = (3.0, 0.03);
/// Least power of a frequency relative to its band.
const LEAST_SHAPE: f64 = 0.02;
/// Ridge of the regression, in units of the weight of one mean segment: with few neighbours the
/// slopes are small.
const RIDGE: f64 = 0.3;
/// Spread of the power of a frequency about that of its band, as a part of it.
const CONTRAST: f64 = 0.5;

/// Exponents of speed and force in the power of a band beyond what was visited.
const EXPONENTS: [f64; 2] = [-1.0, 4.0];

/// A segment, ready to be regressed.
#[derive(Debug, Clone)]
struct RegressionRow {
    place: [f64; 2],
    weight: f64,
    /// Power at every frequency and of every band, noise included.
    power: Vec<f64>,
    bands: Vec<f64>,
}

impl RegressionRow {
    /// Its weight at a place, Gaussian of a width.
    fn near(&self, place: [f64; 2], width: f64) -> f64 {
        let away = [0, 1].map(|axis| self.place[axis] - place[axis]);
        let distance = (away[0] * away[0] + away[1] * away[1]) / (width * width);
        self.weight * libm::exp(-0.5 * distance)
    }
}

/// The segments of a recording, in coordinates of unit variance.
#[derive(Debug, Clone)]
pub(super) struct Local {
    rows: Vec<RegressionRow>,
    /// Power of the sensors' noise at every frequency and of every band.
    noise: Vec<f64>,
    noise_bands: Vec<f64>,
    centre: [f64; 2],
    scale: [f64; 2],
    /// Power law of every band over the whole plane, about its centre.
    everywhere: Vec<[f64; 3]>,
}

fn coordinates(speed_mm_s: f64, force_n: f64) -> [f64; 2] {
    [
        libm::log(speed_mm_s + OFFSETS.0),
        libm::log(force_n.max(0.0) + OFFSETS.1),
    ]
}

/// A segment near a place, the way to it, and its weight in samples.
type Near<'a> = (&'a RegressionRow, [f64; 2], f64);

impl Local {
    /// Fits the segments, under the sensors' noise.
    pub(super) fn new(strokes: &Segments, segments: &[&Segment]) -> Self {
        let mut rows: Vec<RegressionRow> = segments
            .iter()
            .map(|segment| RegressionRow {
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
        let noise = strokes
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
                Fit::new(&measured(&all, band), *noise, slopes, None)
                    .map_or([0.0; 3], |fit| fit.beta)
            })
            .collect();
        Self {
            rows,
            noise_bands,
            noise,
            centre,
            scale,
            everywhere,
        }
    }

    /// Samples in the neighbourhood of a place, each by how near it is.
    pub(super) fn weight(&self, place: (f64, f64), width: f64) -> f64 {
        let place = self.place(place);
        let near = self.rows.iter().map(|row| row.near(place, width));
        near.sum()
    }

    /// A spectrum from one speed and force at another one, where every band goes on with a part of its
    /// slopes over the whole plane.
    pub(super) fn moved(
        &self,
        power: &[f64],
        from: (f64, f64),
        to: (f64, f64),
        parts: [f64; 2],
    ) -> Vec<f64> {
        let (from, to) = (self.place(from), self.place(to));
        power
            .chunks_exact(POINTS / BANDS)
            .zip(&self.everywhere)
            .flat_map(|(power, law)| {
                let ln = [0, 1].map(|axis| {
                    let [low, high] = EXPONENTS.map(|x| x * self.scale[axis]);
                    parts[axis] * law[1 + axis].clamp(low, high) * (to[axis] - from[axis])
                });
                let factor = libm::exp(ln[0] + ln[1]);
                power.iter().map(move |p| factor * p)
            })
            .collect()
    }

    /// A speed and a force in coordinates of unit variance.
    fn place(&self, (speed_mm_s, force_n): (f64, f64)) -> [f64; 2] {
        let place = coordinates(speed_mm_s, force_n);
        [0, 1].map(|axis| (place[axis] - self.centre[axis]) / self.scale[axis])
    }

    /// Power at the frequencies of a segment, (m/s²)², from a neighbourhood of a width in standard deviations, and the
    /// samples that it rests on; `None` for no segments.
    pub(super) fn spectrum(&self, place: (f64, f64), width: f64) -> Option<(Vec<f64>, f64)> {
        let place = self.place(place);
        let mean_weight =
            self.rows.iter().map(|row| row.weight).sum::<f64>() / self.rows.len() as f64;
        let mut near: Vec<Near<'_>> = self
            .rows
            .iter()
            .map(|row| {
                let away = [0, 1].map(|axis| row.place[axis] - place[axis]);
                (row, away, row.near(place, width))
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
            let fit = Fit::new(&measured(&near, band), noise, slopes, Some(*law))?;
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
        Some((power, 1.0 / variance))
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
        let fit = Fit::new(&measured(near, band), noise, slopes, Some(law))?;
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

/// Collects the power of a band in the segments near a place.
fn measured(near: &[Near<'_>], band: usize) -> Vec<Measured> {
    let one = |(row, away, weight): &Near<'_>| Measured {
        power: row.bands[band],
        away: *away,
        weight: *weight,
    };
    near.iter().map(one).collect()
}

fn bands(power: &[f64]) -> Vec<f64> {
    let size = POINTS / BANDS;
    power
        .chunks_exact(size)
        .map(|band| band.iter().sum::<f64>() / size as f64)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        grid::{
            ar_model::{Form, Modeller},
            simulated::segments,
        },
        segments::frequencies_hz,
        timeline::RATE_HZ,
    };
    use asperity_texture::{
        model::Numerator,
        signal::{lsf, spectrum::squared_magnitude},
    };
    use std::f64::consts::TAU;

    const NOISE: f64 = 1.0;
    const A: [f64; 3] = [1.0, -0.9, 0.5];

    /// Power of an AR model whose level is a power law.
    fn truth(speed_mm_s: f64, force_n: f64, freq_hz: f64) -> f64 {
        let level = 4.0 * libm::pow(speed_mm_s / 100.0, 1.4) * libm::pow(force_n, 0.8);
        level / squared_magnitude(&A, TAU * freq_hz / RATE_HZ)
    }

    /// Segments of half a second at irregular places, under white noise.
    fn strokes(noise_is_known: bool) -> Segments {
        let ranges = ((12.0, 192.0), (0.25, 2.0));
        let segments = segments(9, 150, ranges, |v, f, hz| truth(v, f, hz) + NOISE);
        Segments {
            segments,
            noise_lags: None,
            noise_power: noise_is_known.then(|| vec![NOISE; POINTS]),
            rejected: 0,
        }
    }

    /// Mean and RMS of the model over the truth, dB.
    fn error_db(strokes: &Segments, speed_mm_s: f64, force_n: f64) -> (f64, f64) {
        let all: Vec<&Segment> = strokes.segments.iter().collect();
        let place = (speed_mm_s, force_n);
        let (power, _) = Local::new(strokes, &all)
            .spectrum(place, 0.5)
            .expect("segments");
        let form = Form {
            order: 6,
            numerator: Numerator::None,
        };
        let found = Modeller::new(form).vertex(place, &power).expect("a model");
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
            let (mean, rms) = error_db(&strokes(true), speed_mm_s, force_n);
            assert!(mean.abs() < 0.7 && rms < 1.2, "{mean} {rms}");
        }
        let (mean, _) = error_db(&strokes(false), 25.0, 0.5);
        assert!(
            mean > 5.0,
            "noise that is not known counts as signal: {mean}"
        );
    }
}
