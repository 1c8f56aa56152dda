//! Vertices that explain all segments together.
//!
//! Between vertices the runtime mixes cos ω and the level. The vertex that best fits the vibration at its
//! own place is not the one whose mixtures best fit the vibration between the places. So all vertices are
//! moved at once to the least sum over segments of Whittle's measure, ln S + P/S, where S is the
//! spectrum of the mixture with the sensors' noise. What the neighbourhood of a vertex says counts
//! as some further seconds of vibration. Vertices beyond what was visited stay where they are.
//!
//! One step is Fisher's scoring: a Gauss–Newton step with the expected curvature. Only vertices of one
//! triangle share a block of it, so it is solved by conjugate gradients over blocks.

use super::{
    blocks::{Block, Point, add_outer, dot, product, solve},
    shape::Shape,
    whittle::noise,
};
use asperity_recording::{
    segments::{Segment, Segments, frequencies_hz},
    timeline::RATE_HZ,
};
use asperity_texture::model::{GridVertex, ModelGrid, VertexKind, mixture::Field};
use std::{collections::BTreeMap, f64::consts::TAU};

/// Steps of Fisher's scoring.
const STEPS: usize = 6;
/// A step that gains less than this, nats a second of vibration, is the last one.
const LEAST_GAIN: f64 = 1e-5;
/// Times that a step is halved.
const HALVINGS: usize = 6;
/// Part of the distance between neighbouring cosines that a step may take away.
const CLOSER: f64 = 0.4;
/// Largest step of ln σ.
const LARGEST_LN: f64 = 0.5;
/// Part of the seconds of a segment that count: neighbours overlap by half.
const OVERLAP: f64 = 0.5;

/// The measured vertices of a grid, which come first in it, moved to where the mixtures explain the
/// segments best. What each was before counts as `prior_s` seconds.
pub(super) fn refine(
    grid: &ModelGrid,
    strokes: &Segments,
    segments: &[&Segment],
    prior_s: f64,
) -> Vec<GridVertex> {
    let problem = Problem::new(grid, strokes, segments, prior_s);
    let mut at = problem.start.clone();
    let mut error = problem.error(&at);
    for _ in 0..STEPS {
        let (gradient, curvature) = problem.slope(&at);
        let step = solve(&curvature, &gradient, problem.size);
        let mut scale = 1.0;
        let mut moved = None;
        for _ in 0..HALVINGS {
            let next = problem.stepped(&at, &step, scale);
            let next_error = problem.error(&next);
            if next_error < error {
                moved = Some((next, next_error));
                break;
            }
            scale *= 0.5;
        }
        let Some((next, next_error)) = moved else {
            break;
        };
        let gain = error - next_error;
        (at, error) = (next, next_error);
        if gain < LEAST_GAIN * problem.seconds {
            break;
        }
    }
    problem.vertices(grid, &at)
}

/// A segment as the mixture sees it.
struct Seen<'a> {
    /// Measured vertices with their parts.
    parts: Vec<(usize, f64)>,
    /// Contribution of the fixed vertices to cos ω and to the level.
    fixed: (Vec<f64>, f64),
    seconds: f64,
    power: &'a [f64],
}

struct Problem<'a> {
    order: usize,
    /// Parameters of a vertex: the order, and one.
    size: usize,
    /// cos ω and ln σ of every measured vertex.
    start: Point,
    segments: Vec<Seen<'a>>,
    seconds: f64,
    /// Curvature of a second of vibration at every vertex where it starts, times the prior's seconds.
    prior: Vec<Block>,
    shape: Shape,
    /// The sensors' noise at every frequency.
    noise: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(grid: &ModelGrid, strokes: &Segments, segments: &[&'a Segment], prior_s: f64) -> Self {
        let interior = grid
            .vertices
            .iter()
            .take_while(|v| v.kind == VertexKind::Interior)
            .count();
        let start: Point = grid.vertices[..interior]
            .iter()
            .map(|v| {
                let cosines = v.lsf_rad.iter().map(|w| libm::cos(*w));
                cosines.chain([libm::log(v.sigma_m_s2)]).collect()
            })
            .collect();
        let field = Field::new(grid);
        let segments: Vec<Seen<'a>> = segments
            .iter()
            .filter_map(|segment| {
                let place = field.locate(segment.speed_mm_s, segment.force_n)?;
                let mut parts = Vec::new();
                let mut fixed = (vec![0.0; grid.order], 0.0);
                for (index, weight) in place.vertices.into_iter().zip(place.weights) {
                    if index < interior {
                        parts.push((index, weight));
                        continue;
                    }
                    let vertex = &grid.vertices[index];
                    for (sum, w) in fixed.0.iter_mut().zip(&vertex.lsf_rad) {
                        *sum += weight * libm::cos(*w);
                    }
                    fixed.1 += weight * vertex.sigma_m_s2;
                }
                let audible = parts.iter().any(|part| part.1 > 1e-6);
                audible.then(|| Seen {
                    parts,
                    fixed,
                    seconds: OVERLAP * segment.length as f64 / RATE_HZ,
                    power: &segment.power,
                })
            })
            .collect();
        let omegas: Vec<f64> = frequencies_hz()
            .into_iter()
            .map(|freq_hz| TAU * freq_hz / RATE_HZ)
            .collect();
        let mut problem = Self {
            order: grid.order,
            size: grid.order + 1,
            start,
            seconds: segments.iter().map(|segment| segment.seconds).sum(),
            segments,
            prior: Vec::new(),
            shape: Shape::new(&omegas, grid.numerator),
            noise: (0..omegas.len()).map(|n| noise(strokes, n, 0.0)).collect(),
        };
        problem.prior = problem
            .start
            .iter()
            .map(|vertex| {
                let (_, rows) = problem.shape.spectrum_and_rows(&vertex[..problem.order]);
                let mut block = vec![0.0; problem.size * problem.size];
                for row in &rows {
                    add_outer(&mut block, row, prior_s / rows.len() as f64);
                }
                // Cosines that no frequency of the band shows stay where they are.
                for k in 0..problem.size {
                    block[k * problem.size + k] += 1e-6 + 1e-9 * prior_s;
                }
                block
            })
            .collect();
        problem
    }

    /// cos ω and level of the mixture that a segment hears.
    fn mixed(&self, at: &Point, seen: &Seen<'_>) -> (Vec<f64>, f64) {
        let (mut c, mut level) = seen.fixed.clone();
        for &(vertex, weight) in &seen.parts {
            for (sum, x) in c.iter_mut().zip(&at[vertex]) {
                *sum += weight * x;
            }
            level += weight * libm::exp(at[vertex][self.order]);
        }
        (c, level)
    }

    /// Seconds times nats.
    fn error(&self, at: &Point) -> f64 {
        let mut sum = 0.0;
        for seen in &self.segments {
            let (c, level) = self.mixed(at, seen);
            let mut own = 0.0;
            for ((shape, power), noise) in self.shape.spectrum(&c).zip(seen.power).zip(&self.noise)
            {
                let s = level * level * shape + noise;
                own += libm::log(s) + power / s;
            }
            sum += seen.seconds * own / self.noise.len() as f64;
        }
        for ((at, start), prior) in at.iter().zip(&self.start).zip(&self.prior) {
            let away: Vec<f64> = at.iter().zip(start).map(|(x, y)| x - y).collect();
            sum += 0.5 * dot(&away, &product(prior, &away));
        }
        sum
    }

    /// Gradient and expected curvature.
    fn slope(&self, at: &Point) -> (Point, BTreeMap<(usize, usize), Block>) {
        let size = self.size;
        let mut gradient = vec![vec![0.0; size]; at.len()];
        let mut curvature: BTreeMap<(usize, usize), Block> = BTreeMap::new();
        for (index, ((at, start), prior)) in at.iter().zip(&self.start).zip(&self.prior).enumerate()
        {
            let away: Vec<f64> = at.iter().zip(start).map(|(x, y)| x - y).collect();
            gradient[index] = product(prior, &away);
            curvature.insert((index, index), prior.clone());
        }
        for seen in &self.segments {
            let (c, level) = self.mixed(at, seen);
            let (shapes, rows) = self.shape.spectrum_and_rows(&c);
            let scale = seen.seconds / shapes.len() as f64;
            let mut own_gradient = vec![0.0; size];
            let mut own = vec![0.0; size * size];
            for (((shape, row), power), noise) in
                shapes.iter().zip(&rows).zip(seen.power).zip(&self.noise)
            {
                let s = level * level * shape + noise;
                let signal = level * level * shape / s;
                let slope = scale * signal * (1.0 - power / s);
                for (sum, x) in own_gradient.iter_mut().zip(row) {
                    *sum += slope * x;
                }
                add_outer(&mut own, row, scale * signal * signal);
            }
            let chain = |&(vertex, weight): &(usize, f64)| -> (usize, Vec<f64>) {
                let mut chain = vec![weight; size];
                chain[self.order] = weight * libm::exp(at[vertex][self.order]) / level;
                (vertex, chain)
            };
            let chains: Vec<(usize, Vec<f64>)> = seen.parts.iter().map(chain).collect();
            for (i, of_i) in &chains {
                for ((sum, x), w) in gradient[*i].iter_mut().zip(&own_gradient).zip(of_i) {
                    *sum += w * x;
                }
                for (j, of_j) in &chains {
                    let block = curvature
                        .entry((*i, *j))
                        .or_insert_with(|| vec![0.0; size * size]);
                    for (row, w) in of_i.iter().enumerate() {
                        let span = row * size..(row + 1) * size;
                        for ((sum, x), v) in
                            block[span.clone()].iter_mut().zip(&own[span]).zip(of_j)
                        {
                            *sum += w * x * v;
                        }
                    }
                }
            }
        }
        (gradient, curvature)
    }

    /// A step against the gradient, for every vertex no longer than keeps its cosines in order.
    fn stepped(&self, at: &Point, step: &Point, scale: f64) -> Point {
        at.iter()
            .zip(step)
            .map(|(at, step)| {
                let mut most = scale;
                let mut keep = |room: f64, closer: f64| {
                    if closer > 0.0 {
                        most = most.min(CLOSER * room / closer);
                    }
                };
                keep(1.0 - at[0], -step[0]);
                for k in 1..self.order {
                    keep(at[k - 1] - at[k], step[k - 1] - step[k]);
                }
                keep(at[self.order - 1] + 1.0, step[self.order - 1]);
                let last = step[self.order].abs();
                if last > 0.0 {
                    most = most.min(LARGEST_LN / last);
                }
                at.iter().zip(step).map(|(x, s)| x - most * s).collect()
            })
            .collect()
    }

    fn vertices(&self, grid: &ModelGrid, at: &Point) -> Vec<GridVertex> {
        grid.vertices
            .iter()
            .zip(at)
            .map(|(vertex, at)| {
                let lsf_rad = at[..self.order].iter().map(|c| libm::acos(*c)).collect();
                GridVertex {
                    lsf_rad: super::vertex::apart(lsf_rad),
                    sigma_m_s2: libm::exp(at[self.order]),
                    ..vertex.clone()
                }
            })
            .collect()
    }
}
