//! The grid of a recording: models over speed and force, from the segments of its strokes.
//!
//! Vertices stand where the segments are. Each takes its model from the segments near it. The AR order and the width
//! of the neighbourhood are those that best predict, by Whittle's measure, the segments that were held out: 0.005 of
//! it is some 0.5 dB RMS.
//!
//! | file | contents |
//! |---|---|
//! | `clusters` | places of the vertices |
//! | `band`, `local` | power near a place, under the sensors' noise |
//! | `extrapolation` | vertices beyond what was visited |
//! | `vertex` | from power to a model |
//! | `whittle` | the measure, and the residual of a vertex |

mod ar_model;
mod band;
mod clusters;
mod extrapolation;
mod local;
#[cfg(test)]
mod simulated;
mod whittle;

use crate::{
    segments::{Segment, Segments},
    timeline::RATE_HZ,
};
use ar_model::{Form, Modeller};
use asperity_texture::model::{GridVertex, ModelGrid, Numerator, triangulate};
use clusters::centres;
pub use extrapolation::Slopes;
use extrapolation::{Visited, ring};
use local::Local;
use rayon::prelude::*;
use serde::Serialize;

/// AR orders that are tried.
const ORDERS: [usize; 6] = [4, 8, 12, 16, 20, 24];
/// Widths that are tried, standard deviations of what was visited.
const WIDTHS: [f64; 5] = [0.5, 0.25, 0.35, 0.7, 1.0];
/// Most vertices, and fewest segments of each.
const MOST_VERTICES: usize = 25;
const SEGMENTS_EACH: usize = 3;
/// Parts that are held out in turn, and the time that stays together, s.
const FOLDS: usize = 4;
const BLOCK_S: f64 = 3.0;
/// Minimum gain of another coefficient, in Whittle's measure.
const LEAST_GAIN: f64 = 4e-4;

/// A choice and its held-out error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tried {
    /// AR order.
    pub order: usize,
    /// True if the numerator is 1 + z⁻¹ rather than 1.
    pub nyquist_zero: bool,
    /// Width of the neighbourhood, standard deviations.
    pub width: f64,
    /// Whittle's measure on held-out segments.
    pub held_out: f64,
}

/// Reliability of a vertex.
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
    /// The grid. Its measured vertices come first, then edge models: those beyond what was visited,
    /// and silence.
    pub grid: ModelGrid,
    /// Its measured vertices.
    pub facts: Vec<VertexFacts>,
    /// Part of the power laws with which it goes on beyond what was visited.
    pub beyond: Slopes,
    /// The best choice.
    pub chosen: Tried,
    /// All that was tried.
    pub tried: Vec<Tried>,
}

impl GridFit {
    /// The vertices beyond what was visited, silent ones left out.
    pub fn extrapolated(&self) -> impl Iterator<Item = &GridVertex> {
        let edges = self.grid.vertices.iter().skip(self.facts.len());
        edges.filter(|vertex| vertex.sigma_m_s2 > 0.0)
    }
}

/// A choice before it is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Choice {
    form: Form,
    width: f64,
    beyond: Slopes,
}

/// Fits the grid of the segments; `None` for fewer than two.
#[must_use]
pub fn fit(strokes: &Segments) -> Option<GridFit> {
    if strokes.segments.len() < 2 {
        return None;
    }
    let forms = ORDERS.into_iter().flat_map(|order| {
        [Numerator::None, Numerator::Nyquist].map(|numerator| Form { order, numerator })
    });
    let beyond = Slopes::new(strokes);
    let first = |form| Choice {
        form,
        width: WIDTHS[0],
        beyond,
    };
    let mut tried = Vec::new();
    let best = least(strokes, forms.map(first).collect(), LEAST_GAIN, &mut tried);
    let widths = WIDTHS.map(|width| Choice { width, ..best.0 });
    let (choice, chosen) = least(strokes, widths.to_vec(), 0.0, &mut tried);
    let all: Vec<&Segment> = strokes.segments.iter().collect();
    let (grid, seconds) = build(strokes, &all, choice)?;
    let facts = grid
        .vertices
        .iter()
        .zip(seconds)
        .map(|(vertex, seconds)| VertexFacts {
            speed_mm_s: vertex.speed_mm_s,
            force_n: vertex.force_n,
            seconds,
            residual_db: whittle::residual_db(strokes, &grid, vertex),
        })
        .collect();
    Some(GridFit {
        grid,
        facts,
        beyond,
        chosen,
        tried,
    })
}

/// The first choice that no later one beats by more than `gain`.
fn least(
    strokes: &Segments,
    choices: Vec<Choice>,
    gain: f64,
    tried: &mut Vec<Tried>,
) -> (Choice, Tried) {
    let results: Vec<Tried> = choices
        .par_iter()
        .map(|choice| Tried {
            order: choice.form.order,
            nyquist_zero: choice.form.numerator == Numerator::Nyquist,
            width: choice.width,
            held_out: held_out(strokes, *choice),
        })
        .collect();
    let smallest = results
        .iter()
        .map(|tried| tried.held_out)
        .fold(f64::INFINITY, f64::min);
    let first = results
        .iter()
        .position(|tried| tried.held_out <= smallest + gain)
        .unwrap_or(0);
    tried.extend(&results);
    (choices[first], results[first])
}

fn fold(segment: &Segment) -> usize {
    let middle_s = (segment.start + segment.length / 2) as f64 / RATE_HZ;
    (middle_s / BLOCK_S) as usize % FOLDS
}

/// Whittle's measure of held-out segments; infinite where a grid has no place for one.
fn held_out(strokes: &Segments, choice: Choice) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for part in 0..FOLDS {
        let (out, seen): (Vec<&Segment>, Vec<&Segment>) = strokes
            .segments
            .iter()
            .partition(|segment| fold(segment) == part);
        if out.is_empty() {
            continue;
        }
        let measured = build(strokes, &seen, choice)
            .and_then(|(grid, _)| whittle::measure(strokes, &grid, &out));
        let Some((own, weight)) = measured else {
            return f64::INFINITY;
        };
        sum += own;
        count += weight;
    }
    if count > 0.0 {
        sum / count
    } else {
        f64::INFINITY
    }
}

/// The grid of some segments, and the seconds of vibration behind each of its measured vertices.
fn build(
    strokes: &Segments,
    segments: &[&Segment],
    choice: Choice,
) -> Option<(ModelGrid, Vec<f64>)> {
    if segments.is_empty() {
        return None;
    }
    let local = Local::new(strokes, segments);
    let modeller = Modeller::new(choice.form);
    let count = (strokes.segments.len() / SEGMENTS_EACH).clamp(1, MOST_VERTICES);
    let mut vertices = Vec::new();
    let mut seconds = Vec::new();
    for place in centres(strokes, segments, count) {
        let (power, samples) = local.spectrum(place, choice.width)?;
        if let Some(vertex) = modeller.vertex(place, &power) {
            vertices.push(vertex);
            seconds.push(samples / RATE_HZ);
        }
    }
    if vertices.is_empty() {
        return None;
    }
    let visited = Visited::new(&strokes.segments);
    let ring = ring(&visited, &local, &choice.beyond, choice.width, &modeller)?;
    vertices.extend(ring);
    let grid = ModelGrid {
        sample_rate_hz: RATE_HZ,
        order: choice.form.order,
        numerator: choice.form.numerator,
        triangles: triangulate::delaunay(&vertices),
        vertices,
    };
    Some((grid, seconds))
}
