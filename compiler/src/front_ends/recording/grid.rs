//! The grid of a recording: how wide a neighbourhood, which form, how many vertices.
//!
//! Each choice is the one that predicts best the segments that it has not seen. The measure is
//! Whittle's: the mean of ln S + P/S over segments and frequencies, where S is the spectrum of the
//! model with that of the sensors' noise, and P the power of the segment. Half a hundredth of it is
//! some 0.5 dB RMS.

use super::{
    local::Local,
    vertex::{Form, vertex},
};
use crate::{
    front_ends::learned::edges,
    model::{GridVertex, ModelGrid, Numerator, mixture::Field},
    passes::triangulate,
    signal::spectrum::Angles,
};
use asperity_recording::{
    steady::{POINTS, Segment, Steady, frequencies_hz},
    timeline::RATE_HZ,
};
use rayon::prelude::*;
use serde::Serialize;
use std::f64::consts::TAU;

/// Widths that are tried, standard deviations of what was visited.
const WIDTHS: [f64; 6] = [0.25, 0.35, 0.5, 0.7, 1.0, 2.0];
/// Numbers of vertices that are tried.
const COUNTS: [usize; 8] = [1, 3, 5, 8, 12, 16, 20, 25];
/// AR orders that are tried.
const ORDERS: [usize; 6] = [4, 8, 12, 16, 20, 24];
/// Parts that are held out in turn, and the time that stays together, s.
const FOLDS: usize = 4;
const BLOCK_S: f64 = 3.0;
/// What another vertex or coefficient must gain, in Whittle's measure.
const LEAST_GAIN: f64 = 4e-4;
/// The rectangle of the grid reaches beyond what was visited by this factor.
const BEYOND: f64 = 1.05;

/// A choice and its held-out error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tried {
    /// AR order.
    pub order: usize,
    /// Whether the numerator is 1 + z⁻¹ rather than 1.
    pub nyquist_zero: bool,
    /// Width of the neighbourhood, standard deviations.
    pub width: f64,
    /// Vertices that are measured.
    pub vertices: usize,
    /// Whittle's measure on held-out segments.
    pub held_out: f64,
}

/// How sure a vertex is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VertexFacts {
    /// Its speed, mm/s.
    pub speed_mm_s: f64,
    /// Its force, N.
    pub force_n: f64,
    /// Seconds of vibration that it rests on.
    pub seconds: f64,
    /// RMS over eight bands of the mean power of the segments near it over its model, dB: how far
    /// from white the residual is.
    pub residual_db: f64,
}

/// The grid and how it was chosen.
#[derive(Debug, Clone)]
pub struct GridFit {
    /// The grid, edge models included.
    pub grid: ModelGrid,
    /// Its measured vertices.
    pub facts: Vec<VertexFacts>,
    /// What was chosen.
    pub chosen: Tried,
    /// All that was tried.
    pub tried: Vec<Tried>,
}

/// A choice before it is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Choice {
    form: Form,
    width: f64,
    vertices: usize,
}

/// The grid of the segments; `None` of fewer than two.
#[must_use]
pub fn fit(steady: &Steady) -> Option<GridFit> {
    if steady.segments.len() < 2 {
        return None;
    }
    let mut tried = Vec::new();
    let mut best = Choice {
        form: Form {
            order: 16,
            numerator: Numerator::Nyquist,
        },
        width: 0.5,
        vertices: 12,
    };
    let at_most = (steady.segments.len() / 3).max(1);
    for round in 0..2 {
        let widths = WIDTHS.map(|width| Choice { width, ..best });
        best = least(steady, widths.into_iter(), 0.0, &mut tried);
        let counts: Vec<Choice> = COUNTS
            .into_iter()
            .filter(|count| *count <= at_most)
            .map(|vertices| Choice { vertices, ..best })
            .collect();
        best = least(steady, counts.into_iter(), LEAST_GAIN, &mut tried);
        if round == 0 {
            let forms = ORDERS.into_iter().flat_map(|order| {
                [Numerator::None, Numerator::Nyquist].map(|numerator| Form { order, numerator })
            });
            best = least(
                steady,
                forms.map(|form| Choice { form, ..best }),
                LEAST_GAIN,
                &mut tried,
            );
        }
    }
    let (grid, facts) = build(steady, &steady.segments.iter().collect::<Vec<_>>(), best)?;
    let chosen = *tried
        .iter()
        .rev()
        .find(|tried| tried.vertices == best.vertices && tried.width == best.width)?;
    Some(GridFit {
        grid,
        facts,
        chosen,
        tried,
    })
}

/// The first choice that no later one beats by more than `gain`.
fn least(
    steady: &Steady,
    choices: impl Iterator<Item = Choice>,
    gain: f64,
    tried: &mut Vec<Tried>,
) -> Choice {
    let choices: Vec<Choice> = choices.collect();
    let errors: Vec<f64> = choices
        .par_iter()
        .map(|choice| held_out(steady, *choice))
        .collect();
    let record = |(choice, held_out): (&Choice, &f64)| Tried {
        order: choice.form.order,
        nyquist_zero: choice.form.numerator == Numerator::Nyquist,
        width: choice.width,
        vertices: choice.vertices,
        held_out: *held_out,
    };
    tried.extend(choices.iter().zip(&errors).map(record));
    let smallest = errors.iter().copied().fold(f64::INFINITY, f64::min);
    let first = errors
        .iter()
        .position(|error| *error <= smallest + gain)
        .unwrap_or(0);
    choices[first]
}

fn fold(segment: &Segment) -> usize {
    let middle_s = (segment.start + segment.length / 2) as f64 / RATE_HZ;
    (middle_s / BLOCK_S) as usize % FOLDS
}

/// Whittle's measure of held-out segments.
fn held_out(steady: &Steady, choice: Choice) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for part in 0..FOLDS {
        let (out, seen): (Vec<&Segment>, Vec<&Segment>) = steady
            .segments
            .iter()
            .partition(|segment| fold(segment) == part);
        if out.is_empty() {
            continue;
        }
        let Some((grid, _)) = build(steady, &seen, choice) else {
            return f64::INFINITY;
        };
        let field = Field::new(&grid);
        let angles = angles();
        for segment in out {
            let Some(model) = powers(&field, &angles, segment.speed_mm_s, segment.force_n) else {
                return f64::INFINITY;
            };
            let weight = segment.length as f64;
            for (n, (model, power)) in model.iter().zip(&segment.power).enumerate() {
                let s = model + noise(steady, n, *power);
                sum += weight * (libm::log(s) + power / s);
                count += weight;
            }
        }
    }
    if count > 0.0 {
        sum / count
    } else {
        f64::INFINITY
    }
}

fn angles() -> Angles {
    Angles::new(
        frequencies_hz()
            .into_iter()
            .map(|freq_hz| TAU * freq_hz / RATE_HZ),
    )
}

/// Power of the sensors' noise at a frequency, and never nothing.
fn noise(steady: &Steady, n: usize, power: f64) -> f64 {
    steady.noise_power.as_ref().map_or(0.0, |noise| noise[n]) + 1e-9 * power + 1e-15
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

/// The grid of some segments, and the facts of its measured vertices.
fn build(
    steady: &Steady,
    segments: &[&Segment],
    choice: Choice,
) -> Option<(ModelGrid, Vec<VertexFacts>)> {
    if segments.is_empty() {
        return None;
    }
    let largest =
        |pick: fn(&Segment) -> f64| steady.segments.iter().map(pick).fold(0.0, f64::max) * BEYOND;
    let corner = (largest(|s| s.speed_mm_s), largest(|s| s.force_n));
    let local = Local::new(steady, segments.iter().copied());
    let mut facts = Vec::new();
    let mut interior: Vec<GridVertex> = Vec::new();
    for (speed_mm_s, force_n) in centres(segments, choice.vertices, corner) {
        let estimate = local.at(speed_mm_s, force_n, choice.width)?;
        let Some(vertex) = vertex(speed_mm_s, force_n, &estimate.lags, choice.form) else {
            continue;
        };
        facts.push(VertexFacts {
            speed_mm_s,
            force_n,
            seconds: estimate.samples / RATE_HZ,
            residual_db: residual_db(steady, segments, &vertex, choice.form),
        });
        interior.push(vertex);
    }
    if interior.is_empty() {
        return None;
    }
    let vertices = edges::close(interior, corner.0, corner.1);
    let grid = ModelGrid {
        sample_rate_hz: RATE_HZ,
        order: choice.form.order,
        numerator: choice.form.numerator,
        triangles: triangulate::delaunay(&vertices),
        vertices,
    };
    Some((grid, facts))
}

/// Centres of clusters in the plane of speed and force. The first ones are far apart, and Lloyd's
/// steps move them to the middle of their segments.
fn centres(segments: &[&Segment], count: usize, corner: (f64, f64)) -> Vec<(f64, f64)> {
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

/// RMS over bands of the power of the nearest segments over the model, dB.
fn residual_db(steady: &Steady, segments: &[&Segment], vertex: &GridVertex, form: Form) -> f64 {
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
                                    + noise(steady, n, 0.0)))
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
