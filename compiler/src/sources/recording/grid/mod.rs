//! The grid of a recording: how wide a neighbourhood, which form, how many vertices.
//!
//! Each choice is the one that predicts best, by Whittle's measure, the segments that it has not seen.
//! Half a hundredth of it is some 0.5 dB RMS.
//!
//! | file | holds |
//! |---|---|
//! | `clusters` | where vertices stand |
//! | `band`, `lags`, `local` | what the segments near a place say, under the sensors' noise: an autocorrelation |
//! | `extrapolation` | vertices beyond what was visited |
//! | `vertex` | from an autocorrelation to a model |
//! | `whittle` | how well a model predicts segments |
//! | `shape`, `blocks`, `refine` | all vertices moved at once, so that their mixtures explain all segments |

mod band;
mod blocks;
mod clusters;
mod extrapolation;
mod lags;
mod local;
mod refine;
mod shape;
#[cfg(test)]
mod simulated;
mod vertex;
mod whittle;

use asperity_recording::{
    segments::{Segment, Segments},
    timeline::RATE_HZ,
};
use asperity_texture::model::triangulate;
use asperity_texture::model::{GridVertex, ModelGrid, Numerator};
use clusters::centres;
pub use extrapolation::Slopes;
use extrapolation::{Visited, ring};
use local::Local;
use rayon::prelude::*;
use refine::refine;
use serde::Serialize;
use vertex::{Form, vertex};

/// Widths that are tried, standard deviations of what was visited.
const WIDTHS: [f64; 6] = [0.25, 0.35, 0.5, 0.7, 1.0, 2.0];
/// Numbers of vertices that are tried.
const COUNTS: [usize; 8] = [1, 3, 5, 8, 12, 16, 20, 25];
/// Distances that are tried for a level e times as high, beside a way across the whole plane: vertices
/// stand where the level is steep.
const STEEPNESSES: [f64; 3] = [0.0, 0.05, 0.15];
/// AR orders that are tried.
const ORDERS: [usize; 6] = [4, 8, 12, 16, 20, 24];
/// Parts that are held out in turn, and the time that stays together, s.
const FOLDS: usize = 4;
const BLOCK_S: f64 = 3.0;
/// Seconds of vibration that the neighbourhood of a vertex counts as, where all vertices are moved to
/// explain the segments together.
const PRIORS_S: [f64; 3] = [0.1, 0.5, 2.0];
/// Minimum gain of another vertex or coefficient, in Whittle's measure.
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
    /// Vertices that are measured.
    pub vertices: usize,
    /// Weight of a difference in level in the placement of vertices.
    pub steepness: f64,
    /// Seconds that the neighbourhood of a vertex counts as beside the segments that its mixtures meet;
    /// `None` where it alone counts.
    pub prior_s: Option<f64>,
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
    vertices: usize,
    steepness: f64,
    prior_s: Option<f64>,
    beyond: Slopes,
}

/// The grid of the segments; `None` of fewer than two.
#[must_use]
pub fn fit(strokes: &Segments) -> Option<GridFit> {
    if strokes.segments.len() < 2 {
        return None;
    }
    let beyond = Slopes::of(strokes);
    let mut tried = Vec::new();
    let mut best = Choice {
        form: Form {
            order: 16,
            numerator: Numerator::Nyquist,
        },
        width: 0.5,
        vertices: 12,
        steepness: 0.05,
        prior_s: None,
        beyond,
    };
    let at_most = (strokes.segments.len() / 3).max(1);
    for round in 0..2 {
        let widths = WIDTHS.map(|width| Choice { width, ..best });
        best = least(strokes, widths.into_iter(), 0.0, &mut tried);
        let counts: Vec<Choice> = COUNTS
            .into_iter()
            .filter(|count| *count <= at_most)
            .map(|vertices| Choice { vertices, ..best })
            .collect();
        best = least(strokes, counts.into_iter(), LEAST_GAIN, &mut tried);
        let steepnesses = STEEPNESSES.map(|steepness| Choice { steepness, ..best });
        best = least(strokes, steepnesses.into_iter(), 0.0, &mut tried);
        if round == 0 {
            let forms = ORDERS.into_iter().flat_map(|order| {
                [Numerator::None, Numerator::Nyquist].map(|numerator| Form { order, numerator })
            });
            best = least(
                strokes,
                forms.map(|form| Choice { form, ..best }),
                LEAST_GAIN,
                &mut tried,
            );
        }
    }
    let together = COUNTS
        .into_iter()
        .filter(|count| *count <= at_most && *count >= best.vertices.min(12))
        .flat_map(|vertices| {
            PRIORS_S.map(|prior_s| Choice {
                vertices,
                prior_s: Some(prior_s),
                ..best
            })
        });
    let together: Vec<Choice> = [best].into_iter().chain(together).collect();
    best = least(strokes, together.into_iter(), 0.0, &mut tried);
    let (grid, facts) = build(strokes, &strokes.segments.iter().collect::<Vec<_>>(), best)?;
    let chosen = *tried.iter().rev().find(|tried| {
        tried.vertices == best.vertices
            && tried.width == best.width
            && tried.steepness == best.steepness
            && tried.prior_s == best.prior_s
    })?;
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
    choices: impl Iterator<Item = Choice>,
    gain: f64,
    tried: &mut Vec<Tried>,
) -> Choice {
    let choices: Vec<Choice> = choices.collect();
    let errors: Vec<f64> = choices
        .par_iter()
        .map(|choice| held_out(strokes, *choice))
        .collect();
    let record = |(choice, held_out): (&Choice, &f64)| Tried {
        order: choice.form.order,
        nyquist_zero: choice.form.numerator == Numerator::Nyquist,
        width: choice.width,
        vertices: choice.vertices,
        steepness: choice.steepness,
        prior_s: choice.prior_s,
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

/// The logarithm of a segment's power without the sensors' noise, and of a fifth of the noise where
/// there is less.
fn ln_level(strokes: &Segments, segment: &Segment) -> f64 {
    let noise = strokes.noise_lags.as_ref().map_or(0.0, |lags| lags[0]);
    libm::log((segment.lags[0] - noise).max(0.2 * noise).max(1e-300))
}

/// The grid of some segments, and the facts of its measured vertices.
fn build(
    strokes: &Segments,
    segments: &[&Segment],
    choice: Choice,
) -> Option<(ModelGrid, Vec<VertexFacts>)> {
    if segments.is_empty() {
        return None;
    }
    let visited = Visited::new(&strokes.segments.iter().collect::<Vec<_>>());
    let largest = |pick: fn(&Segment) -> f64| strokes.segments.iter().map(pick).fold(0.0, f64::max);
    let corner = (largest(|s| s.speed_mm_s), largest(|s| s.force_n));
    let local = Local::new(strokes, segments.iter().copied());
    let mut seconds = Vec::new();
    let mut interior: Vec<GridVertex> = Vec::new();
    let heights: Vec<f64> = segments
        .iter()
        .map(|segment| choice.steepness * ln_level(strokes, segment))
        .collect();
    for (speed_mm_s, force_n) in centres(segments, &heights, choice.vertices, corner) {
        let estimate = local.at(speed_mm_s, force_n, choice.width)?;
        let Some(vertex) = vertex(speed_mm_s, force_n, &estimate.lags, choice.form) else {
            continue;
        };
        seconds.push(estimate.samples / RATE_HZ);
        interior.push(vertex);
    }
    if interior.is_empty() {
        return None;
    }
    let ring = ring(&visited, &local, &choice.beyond, choice.width, choice.form)?;
    let vertices = [interior, ring.clone()].concat();
    let mut grid = ModelGrid {
        sample_rate_hz: RATE_HZ,
        order: choice.form.order,
        numerator: choice.form.numerator,
        triangles: triangulate::delaunay(&vertices),
        vertices,
    };
    if let Some(prior_s) = choice.prior_s {
        // The places stay, and with them the triangles.
        let interior = refine(&grid, strokes, segments, prior_s);
        grid.vertices = [interior, ring].concat();
    }
    let facts = grid
        .vertices
        .iter()
        .zip(seconds)
        .map(|(vertex, seconds)| VertexFacts {
            speed_mm_s: vertex.speed_mm_s,
            force_n: vertex.force_n,
            seconds,
            residual_db: whittle::residual_db(strokes, segments, vertex, choice.form),
        })
        .collect();
    Some((grid, facts))
}
