//! Which triangle of the speed–force grid a query falls into, and its weights.
//!
//! Every triangle is looked at every time: bounded, branch-free work with no path
//! to walk, so nothing can hang on an edge. The winner is the triangle whose
//! smallest barycentric weight is largest; on a shared edge or vertex either
//! neighbour wins and both give the same mixture. Weights that rounding left below
//! zero are cut, so the mixture is convex whatever the query.
//!
//! Outside the measured range the query is moved to the nearest point of the border
//! (edge model): constant extrapolation, continuous with the inside.

use crate::{
    lanes::F4,
    math::{clamp_from_zero, max},
};
use asperity_formats::limits::MAX_TRIANGLES;
use core::ops::Range;

/// Triangles evaluated side by side.
const LANES: usize = 4;
/// Change of the weights over the whole grid beyond which a triangle is too thin: f32
/// rounding would move them by 1 % and more. It is 1e-5 of the grid thin, so its points
/// are within 1e-5 of a neighbour. One triangle in 128 that tile the grid always is wider.
const MAX_REACH: f64 = 1.0e5;

/// A convex mixture of three vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Barycentric {
    /// Vertex indices.
    pub vertices: [u8; 3],
    /// Weights in [0, 1] that sum to 1 within rounding.
    pub weights: [f32; 3],
    /// Whether the query lay outside the grid and was moved to its border.
    pub outside: bool,
}

impl Barycentric {
    /// No vertex at all.
    pub(crate) const NONE: Self = Self {
        vertices: [0; 3],
        weights: [0.0; 3],
        outside: false,
    };
}

/// The triangles, prepared for queries; at most `T`, a multiple of 4.
#[derive(Debug, Clone)]
pub(crate) struct Locator<const T: usize> {
    pub(crate) max_speed_mm_s: f32,
    pub(crate) max_force_n: f32,
    triangles: usize,
    corners: [[u8; 3]; T],
    rows: Rows<T>,
}

/// Six numbers a triangle, in blocks of four triangles: four times each of first corner's
/// speed and force, and the rows of the inverse of the edge matrix. Weights of the second
/// and third corner are linear in the offset from the first, which keeps slivers accurate.
#[derive(Debug, Clone)]
#[repr(align(16))]
struct Rows<const T: usize>([[f32; 6]; T]);

impl<const T: usize> Rows<T> {
    /// No triangle: its weights are far below zero for every query.
    const NEVER: Self = {
        let mut flat = [[0.0; 6]; T];
        let mut at = 0;
        while at < T {
            let mut lane = 0;
            while lane < 6 {
                // Row after row of a block of four: a corner far off, and a steep weight.
                flat[at][lane] = match (at % LANES * 6 + lane) / LANES {
                    0 => 1.0e6,
                    2 => 1.0e3,
                    _ => 0.0,
                };
                lane += 1;
            }
            at += 1;
        }
        Self(flat)
    };
}

/// The best triangle so far in each lane: its smallest weight, whose last bits are replaced
/// by the index of its block. Neighbours that differ by so little mix the same.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
pub(crate) struct Search([f32; LANES]);

impl Search {
    pub(crate) const START: Self = Self([-1.0e30; LANES]);
}

/// Bits that hold an index.
const INDEX: u32 = MAX_TRIANGLES.next_power_of_two() as u32 - 1;

impl<const T: usize> Locator<T> {
    pub(crate) const EMPTY: Self = Self {
        max_speed_mm_s: 0.0,
        max_force_n: 0.0,
        triangles: 0,
        corners: [[0; 3]; T],
        rows: Rows::NEVER,
    };

    /// Prepares `count` triangles; `corner` gives (speed, force) of a vertex.
    pub(crate) fn load(
        &mut self,
        triangles: impl ExactSizeIterator<Item = [u8; 3]>,
        corner: impl Fn(u8) -> (f32, f32),
        max_speed_mm_s: f32,
        max_force_n: f32,
    ) {
        *self = Self::EMPTY;
        self.max_speed_mm_s = max_speed_mm_s;
        self.max_force_n = max_force_n;
        self.triangles = triangles.len();
        let flat = self.rows.0.as_flattened_mut();
        for (t, (triangle, place)) in triangles.zip(&mut self.corners).enumerate() {
            let point = |v| {
                let (speed, force) = corner(v);
                (f64::from(speed), f64::from(force))
            };
            let ((x0, y0), (x1, y1), (x2, y2)) =
                (point(triangle[0]), point(triangle[1]), point(triangle[2]));
            let per_twice_area = 1.0 / ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0));
            *place = triangle;
            let inverse = [y2 - y0, x0 - x2, y0 - y1, x1 - x0].map(|side| side * per_twice_area);
            let reach = (inverse[0].abs() + inverse[2].abs()) * f64::from(max_speed_mm_s)
                + (inverse[1].abs() + inverse[3].abs()) * f64::from(max_force_n);
            // A triangle with no area, or too thin for f32 to weigh, is left out
            // and never chosen: its points belong to its neighbours.
            if reach < MAX_REACH {
                let row = [x0, y0, inverse[0], inverse[1], inverse[2], inverse[3]];
                for (k, x) in row.into_iter().enumerate() {
                    if let Some(place) = flat.get_mut(Self::index(t, k)) {
                        *place = x as f32;
                    }
                }
            }
        }
    }

    /// Where number `k` of triangle `t` stands.
    const fn index(t: usize, k: usize) -> usize {
        t / LANES * (6 * LANES) + k * LANES + t % LANES
    }

    /// Blocks of four triangles in use.
    pub(crate) const fn blocks(&self) -> usize {
        self.triangles.div_ceil(LANES)
    }

    /// Inside the grid: the nearest point of its border where the query lies outside.
    #[inline]
    pub(crate) fn clamp(&self, speed_mm_s: f32, force_n: f32) -> (f32, f32) {
        (
            clamp_from_zero(speed_mm_s, self.max_speed_mm_s),
            clamp_from_zero(force_n, self.max_force_n),
        )
    }

    /// Looks at the triangles of some blocks; the query lies in the grid.
    #[inline]
    pub(crate) fn look(&self, search: &mut Search, speed: f32, force: f32, blocks: Range<usize>) {
        let mut mark = (blocks.start * LANES) as u32;
        let (speed, force) = (F4::splat(speed), F4::splat(force));
        let mut best = F4::load(&search.0);
        let all = self.rows.0.as_flattened().as_chunks::<LANES>().0;
        let all = all.as_chunks::<6>().0;
        for [speed0, force0, w1s, w1f, w2s, w2f] in all.get(blocks).unwrap_or_default() {
            let ds = speed - F4::load(speed0);
            let df = force - F4::load(force0);
            let w1 = F4::load(w1s) * ds + F4::load(w1f) * df;
            let w2 = F4::load(w2s) * ds + F4::load(w2f) * df;
            // Zeros lose their sign, which platforms compare differently.
            let smallest = (F4::splat(1.0) - w1 - w2).min(w1).min(w2) + F4::splat(0.0);
            best = smallest.mark(INDEX, mark).max(best);
            mark += LANES as u32;
        }
        search.0 = best.to_array();
    }

    /// The mixture of the best triangle; finite and convex for every query in the grid.
    #[inline]
    pub(crate) fn choose(&self, search: &Search, speed: f32, force: f32) -> Barycentric {
        let lane = |lane: usize| f32::from_bits(search.0[lane].to_bits() | lane as u32);
        let best = max(max(lane(0), lane(1)), max(lane(2), lane(3)));
        let t = (best.to_bits() & INDEX) as usize;
        let flat = self.rows.0.as_flattened();
        let number = |k: usize| flat.get(Self::index(t, k)).copied().unwrap_or_default();
        let (ds, df) = (speed - number(0), force - number(1));
        let w1 = number(2) * ds + number(3) * df;
        let w2 = number(4) * ds + number(5) * df;
        let cut = [1.0 - w1 - w2, w1, w2].map(|w| max(w, 0.0));
        let sum = cut[0] + cut[1] + cut[2];
        // Without a triangle there are no weights.
        let scale = if sum > 0.0 { 1.0 / sum } else { 0.0 };
        Barycentric {
            vertices: self.corners.get(t).copied().unwrap_or_default(),
            weights: cut.map(|w| w * scale),
            outside: false,
        }
    }

    /// The mixture at a speed and a force; finite and convex for every input.
    pub(crate) fn locate(&self, speed_mm_s: f32, force_n: f32) -> Barycentric {
        let (speed, force) = self.clamp(speed_mm_s, force_n);
        let mut search = Search::START;
        self.look(&mut search, speed, force, 0..self.blocks());
        Barycentric {
            outside: !(speed == speed_mm_s && force == force_n),
            ..self.choose(&search, speed, force)
        }
    }
}
