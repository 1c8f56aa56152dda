//! Whittle's measure: the mean of ln S + P/S over segments and frequencies, where S is the spectrum of the
//! model with that of the sensors' noise, and P the power of the segment.

use crate::{
    segments::{POINTS, Segment, Segments, frequencies_hz},
    timeline::RATE_HZ,
};
use asperity_texture::{
    model::{GridVertex, ModelGrid, mixture::Field},
    signal::spectrum::Angles,
};
use std::f64::consts::TAU;

/// Bands of the residual, and segments near a vertex that it is taken over.
const BANDS: usize = 8;
const NEAREST: usize = 12;

/// The spectra of a grid's mixtures, (m/s²)².
struct Spectra<'a> {
    field: Field<'a>,
    angles: Angles,
}

impl<'a> Spectra<'a> {
    fn new(grid: &'a ModelGrid) -> Self {
        let omegas = frequencies_hz()
            .into_iter()
            .map(|freq_hz| TAU * freq_hz / RATE_HZ);
        Self {
            field: Field::new(grid),
            angles: Angles::new(omegas),
        }
    }

    /// Power at the frequencies of a segment; `None` where the grid has no place.
    fn at(&self, speed_mm_s: f64, force_n: f64) -> Option<Vec<f64>> {
        let model = self.field.model(&self.field.locate(speed_mm_s, force_n)?);
        let level = model.level_m_s2 * model.level_m_s2;
        let above = self.angles.squared_magnitudes(&model.b);
        let below = self.angles.squared_magnitudes(&model.a);
        Some(
            above
                .iter()
                .zip(below)
                .map(|(b, a)| level * b / a)
                .collect(),
        )
    }
}

/// The sum over segments and frequencies, and its weight; `None` where the grid has no place for a
/// segment.
pub(super) fn measure(
    strokes: &Segments,
    grid: &ModelGrid,
    segments: &[&Segment],
) -> Option<(f64, f64)> {
    let spectra = Spectra::new(grid);
    let (mut sum, mut count) = (0.0, 0.0);
    for segment in segments {
        let model = spectra.at(segment.speed_mm_s, segment.force_n)?;
        let (own, weight) = of_segment(strokes, &model, segment);
        sum += own;
        count += weight;
    }
    Some((sum, count))
}

/// The sum over the frequencies of a segment under a power of the model at each of them, and its weight.
pub(super) fn of_segment(strokes: &Segments, model: &[f64], segment: &Segment) -> (f64, f64) {
    let weight = segment.length as f64;
    let measure = |(n, (model, power)): (usize, (&f64, &f64))| {
        let s = model + noise(strokes, n, *power);
        libm::log(s) + power / s
    };
    let powers = model.iter().zip(&segment.power).enumerate();
    (
        weight * powers.map(measure).sum::<f64>(),
        weight * model.len() as f64,
    )
}

/// Power of the sensors' noise at a frequency, and never nothing.
fn noise(strokes: &Segments, n: usize, power: f64) -> f64 {
    strokes.noise_power.as_ref().map_or(0.0, |noise| noise[n]) + 1e-9 * power + 1e-15
}

/// RMS over bands of the power of the nearest segments over the model, dB, without their mean: the level of a segment
/// is its own.
pub(super) fn residual_db(strokes: &Segments, grid: &ModelGrid, vertex: &GridVertex) -> f64 {
    let place = (vertex.speed_mm_s, vertex.force_n);
    let Some(model) = Spectra::new(grid).at(place.0, place.1) else {
        return f64::NAN;
    };
    let mut near: Vec<&Segment> = strokes.segments.iter().collect();
    let away =
        |s: &Segment| (s.speed_mm_s / place.0 - 1.0).powi(2) + (s.force_n / place.1 - 1.0).powi(2);
    near.sort_by(|a, b| away(a).total_cmp(&away(b)));
    near.truncate(NEAREST);
    let band = POINTS / BANDS;
    let db: Vec<f64> = (0..BANDS)
        .map(|index| {
            let ratio = |n: usize| -> f64 {
                let s = model[n] + noise(strokes, n, 0.0);
                near.iter()
                    .map(|segment| segment.power[n] / (segment.lags[0] * s))
                    .sum()
            };
            let share: f64 = (index * band..(index + 1) * band).map(ratio).sum();
            10.0 * libm::log10(share.max(1e-300))
        })
        .collect();
    let mean = db.iter().sum::<f64>() / BANDS as f64;
    (db.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / BANDS as f64).sqrt()
}
