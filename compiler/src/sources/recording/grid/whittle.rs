//! Whittle's measure: the mean of ln S + P/S over segments and frequencies, where S is the spectrum of the
//! model with that of the sensors' noise, and P the power of the segment.

use super::vertex::Form;
use asperity_recording::{
    segments::{POINTS, Segment, Segments, frequencies_hz},
    timeline::RATE_HZ,
};
use asperity_texture::{
    model::{GridVertex, ModelGrid, Numerator, mixture::Field},
    signal::spectrum::Angles,
};
use std::f64::consts::TAU;

/// The sum over segments and frequencies, and its weight; `None` where the grid has no place for a
/// segment.
pub(super) fn measure(
    strokes: &Segments,
    grid: &ModelGrid,
    segments: &[&Segment],
) -> Option<(f64, f64)> {
    let field = Field::new(grid);
    let angles = angles();
    let (mut sum, mut count) = (0.0, 0.0);
    for segment in segments {
        let model = powers(&field, &angles, segment.speed_mm_s, segment.force_n)?;
        let weight = segment.length as f64;
        for (n, (model, power)) in model.iter().zip(&segment.power).enumerate() {
            let s = model + noise(strokes, n, *power);
            sum += weight * (libm::log(s) + power / s);
            count += weight;
        }
    }
    Some((sum, count))
}

/// The mean over frequencies of one segment, of a power that is known at each of them.
pub(super) fn of_power(strokes: &Segments, model: &[f64], segment: &Segment) -> f64 {
    let sum: f64 = model
        .iter()
        .zip(&segment.power)
        .enumerate()
        .map(|(n, (model, power))| {
            let s = model + noise(strokes, n, *power);
            libm::log(s) + power / s
        })
        .sum();
    sum / model.len() as f64
}

fn angles() -> Angles {
    Angles::new(
        frequencies_hz()
            .into_iter()
            .map(|freq_hz| TAU * freq_hz / RATE_HZ),
    )
}

/// Power of the sensors' noise at a frequency, and never nothing.
pub(super) fn noise(strokes: &Segments, n: usize, power: f64) -> f64 {
    strokes.noise_power.as_ref().map_or(0.0, |noise| noise[n]) + 1e-9 * power + 1e-15
}

fn powers(field: &Field<'_>, angles: &Angles, speed_mm_s: f64, force_n: f64) -> Option<Vec<f64>> {
    let model = field.model(&field.locate(speed_mm_s, force_n)?);
    let level = model.level_m_s2 * model.level_m_s2;
    let below = angles.squared_magnitudes(&model.a);
    Some(
        angles
            .squared_magnitudes(&model.b)
            .into_iter()
            .zip(below)
            .map(|(b, a)| level * b / a)
            .collect(),
    )
}

/// RMS over bands of the power of the nearest segments over the model, dB.
pub(super) fn residual_db(
    strokes: &Segments,
    segments: &[&Segment],
    vertex: &GridVertex,
    form: Form,
) -> f64 {
    const BANDS: usize = 8;
    const NEAREST: usize = 12;
    let mut near: Vec<&&Segment> = segments.iter().collect();
    let away = |s: &Segment| {
        (s.speed_mm_s / vertex.speed_mm_s - 1.0).powi(2)
            + (s.force_n / vertex.force_n - 1.0).powi(2)
    };
    near.sort_by(|a, b| away(a).total_cmp(&away(b)));
    near.truncate(NEAREST);
    let angles = angles();
    let cosines: Vec<f64> = vertex.lsf_rad.iter().map(|w| libm::cos(*w)).collect();
    let below = angles.squared_magnitudes_of_lsf(&cosines);
    let above = match form.numerator {
        Numerator::Nyquist => angles.squared_magnitudes(&[1.0, 1.0]),
        _ => vec![1.0; POINTS],
    };
    let band = POINTS / BANDS;
    let shares: Vec<f64> = (0..BANDS)
        .map(|index| {
            let span = index * band..(index + 1) * band;
            let ratio = |s: &Segment| {
                let level = s.lags[0];
                span.clone()
                    .map(|n| {
                        s.power[n]
                            / (level
                                * (vertex.sigma_m_s2.powi(2) * above[n] / below[n]
                                    + noise(strokes, n, 0.0)))
                    })
                    .sum::<f64>()
            };
            near.iter().map(|s| ratio(s)).sum::<f64>()
        })
        .collect();
    let db: Vec<f64> = shares
        .iter()
        .map(|share| 10.0 * libm::log10(share.max(1e-300)))
        .collect();
    let mean = db.iter().sum::<f64>() / BANDS as f64;
    (db.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / BANDS as f64).sqrt()
}
