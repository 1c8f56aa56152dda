//! Vertices beyond what was visited.
//!
//! A recording ends at its slowest, fastest, lightest and hardest strokes. Beyond them stand vertices of their own: the
//! power of every band at the nearest visited place goes on with its power law of speed and force. A law of a whole
//! plane need not hold at its ends, so it goes on with that part of the slopes that best predicts the outermost quarter
//! of the segments from the others. Silence is left to rest itself, and to no touch.

use super::{ar_model::Modeller, local::Local, whittle};
use crate::{
    segments::{Segment, Segments},
    signal::quantile::quantile,
};
use asperity_formats::limits::{MAX_FORCE_N, MAX_SPEED_MM_S};
use asperity_texture::model::{GridVertex, VertexKind};
use serde::Serialize;

/// Lines of vertices below what was visited, in parts of its least value. The level falls linearly from the
/// lowest of them to silence.
const BELOW: [f64; 2] = [0.25, 0.5];
/// The border above what was visited, in parts of its largest value: half an octave.
const ABOVE: f64 = std::f64::consts::SQRT_2;
/// An axis that was visited over less than this ratio tells no slope, and has one line in its middle;
/// otherwise it has two.
const NARROW: f64 = 1.5;
/// The visited range of an axis is taken to begin no lower than this part of its largest value.
const LEAST_PART: f64 = 0.01;
/// Parts of the slopes that are tried.
const PARTS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
/// Part of the segments that are held out at an end, how many of them are predicted, and the fewest on either side.
const OUTERMOST: f64 = 0.25;
const PREDICTED: usize = 32;
const FEWEST: usize = 6;
/// Widths of the neighbourhood at the visited border, standard deviations: between them lies that of the
/// grid. It is doubled, so often at most, until it holds so many samples: a corner of the rectangle may be
/// far from any stroke.
const WIDTHS: (f64, f64) = (0.25, 0.5);
const DOUBLINGS: i32 = 5;
const ENOUGH: f64 = 1000.0;
/// Mean power of a vertex over that of the loudest place at the visited border, at most: 6 dB.
const LOUDEST: f64 = 4.0;

/// Part of the slopes that is kept at each end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Slopes {
    /// Below and above the visited speeds.
    pub speed: [f64; 2],
    /// Below and above the visited forces.
    pub force: [f64; 2],
}

impl Slopes {
    pub(super) fn new(strokes: &Segments) -> Self {
        // Where too few segments can be held out, the law is followed half way.
        let end = |of, above| kept(strokes, of, above).unwrap_or(0.5);
        let ends = |of| [end(of, false), end(of, true)];
        Self {
            speed: ends(|s| s.speed_mm_s),
            force: ends(|s| s.force_n),
        }
    }
}

/// The part of the slopes that best predicts the outermost segments of an end; `None` for too few.
fn kept(strokes: &Segments, of: fn(&Segment) -> f64, above: bool) -> Option<f64> {
    let (least, largest) = range(&strokes.segments, of);
    if largest < NARROW * least {
        return Some(0.0);
    }
    let at = if above { 1.0 - OUTERMOST } else { OUTERMOST };
    let cut = quantile(strokes.segments.iter().map(of), at);
    let (out, rest): (Vec<Segment>, Vec<Segment>) = strokes
        .segments
        .iter()
        .cloned()
        .partition(|s| if above { of(s) > cut } else { of(s) < cut });
    if out.len() < FEWEST || rest.len() < FEWEST {
        return None;
    }
    let local = Local::new(strokes, &rest.iter().collect::<Vec<_>>());
    let visited = Visited::new(&rest);
    let mut errors = [0.0; PARTS.len()];
    for segment in out.iter().step_by(out.len().div_ceil(PREDICTED)) {
        let to = (segment.speed_mm_s, segment.force_n);
        let from = visited.nearest(to);
        let power = at_border(&local, from, WIDTHS.0)?;
        for (sum, part) in errors.iter_mut().zip(PARTS) {
            let power = local.moved(&power, from, to, [part; 2]);
            *sum += whittle::of_segment(strokes, &power, segment).0;
        }
    }
    let best = (0..PARTS.len()).min_by(|&a, &b| errors[a].total_cmp(&errors[b]));
    best.map(|best| PARTS[best])
}

/// The least and the largest speed and force of segments.
#[derive(Debug, Clone, Copy)]
pub(super) struct Visited {
    speed_mm_s: (f64, f64),
    force_n: (f64, f64),
}

impl Visited {
    pub(super) fn new(segments: &[Segment]) -> Self {
        Self {
            speed_mm_s: range(segments, |s| s.speed_mm_s),
            force_n: range(segments, |s| s.force_n),
        }
    }

    fn nearest(&self, (speed_mm_s, force_n): (f64, f64)) -> (f64, f64) {
        (
            speed_mm_s.clamp(self.speed_mm_s.0, self.speed_mm_s.1),
            force_n.clamp(self.force_n.0, self.force_n.1),
        )
    }
}

fn range(segments: &[Segment], of: fn(&Segment) -> f64) -> (f64, f64) {
    let values = || segments.iter().map(of);
    let largest = values().fold(0.0, f64::max);
    let least = values().fold(largest, f64::min);
    (least.max(LEAST_PART * largest), largest)
}

/// The spectrum at a place of the visited border.
fn at_border(local: &Local, place: (f64, f64), width: f64) -> Option<Vec<f64>> {
    let width = width.clamp(WIDTHS.0, WIDTHS.1);
    let mut widths = (0..=DOUBLINGS).map(|n| width * f64::from(1 << n));
    let widest = width * f64::from(1 << DOUBLINGS);
    let enough = widths.find(|&width| local.weight(place, width) >= ENOUGH);
    Some(local.spectrum(place, enough.unwrap_or(widest))?.0)
}

/// The vertices that close the rectangle around what all segments visited, as some of them have it. They
/// count as edge models.
pub(super) fn ring(
    visited: &Visited,
    local: &Local,
    slopes: &Slopes,
    width: f64,
    modeller: &Modeller,
) -> Option<Vec<GridVertex>> {
    let speeds = lines(visited.speed_mm_s, f64::from(MAX_SPEED_MM_S));
    let forces = lines(visited.force_n, f64::from(MAX_FORCE_N));
    let places = |silent: bool| {
        let forces = &forces;
        speeds.iter().flat_map(move |&speed_mm_s| {
            forces
                .iter()
                .map(move |&force_n| (speed_mm_s, force_n))
                .filter(move |place| (place.0 == 0.0 || place.1 == 0.0) == silent)
        })
    };
    // Many places have the same nearest one.
    let mut known: Vec<((f64, f64), Vec<f64>)> = Vec::new();
    for place in places(false) {
        let from = visited.nearest(place);
        if from != place && known.iter().all(|(at, _)| *at != from) {
            known.push((from, at_border(local, from, width)?));
        }
    }
    let mean = |power: &[f64]| power.iter().sum::<f64>() / power.len() as f64;
    let loudest = known.iter().map(|(_, p)| mean(p)).fold(0.0, f64::max);
    let mut ring = Vec::new();
    for to in places(false) {
        let from = visited.nearest(to);
        let Some((_, power)) = known.iter().find(|(at, _)| *at == from && from != to) else {
            continue;
        };
        let parts = [
            slopes.speed[usize::from(to.0 > from.0)],
            slopes.force[usize::from(to.1 > from.1)],
        ];
        let mut power = local.moved(power, from, to, parts);
        let lower = (LOUDEST * loudest / mean(&power)).min(1.0);
        power.iter_mut().for_each(|p| *p *= lower);
        ring.push(GridVertex {
            kind: VertexKind::Edge,
            ..modeller.vertex(to, &power)?
        });
    }
    let distance = |v: &GridVertex, place: (f64, f64)| {
        let x = (v.speed_mm_s - place.0) / visited.speed_mm_s.1;
        let y = (v.force_n - place.1) / visited.force_n.1;
        x * x + y * y
    };
    let silence: Option<Vec<GridVertex>> = places(true)
        .map(|place| {
            let like = ring
                .iter()
                .min_by(|a, b| distance(a, place).total_cmp(&distance(b, place)))?;
            Some(GridVertex {
                speed_mm_s: place.0,
                force_n: place.1,
                sigma_m_s2: 0.0,
                ..like.clone()
            })
        })
        .collect();
    ring.extend(silence?);
    Some(ring)
}

/// Where vertices stand along an axis of which a range was visited.
fn lines((least, largest): (f64, f64), limit: f64) -> Vec<f64> {
    let ratio = largest / least;
    let middle = if ratio < NARROW {
        vec![(least * largest).sqrt()]
    } else {
        vec![least * libm::cbrt(ratio), largest / libm::cbrt(ratio)]
    };
    [0.0]
        .into_iter()
        .chain(BELOW.map(|part| part * least))
        .chain(middle)
        .chain([(ABOVE * largest).min(limit)])
        .collect()
}

#[cfg(test)]
mod tests;
