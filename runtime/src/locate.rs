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

use crate::math::{clamp_from_zero, max, min};

/// Triangles evaluated side by side.
const LANES: usize = 8;
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

/// The triangles, prepared for queries; at most `T`, a multiple of 8.
#[derive(Debug, Clone)]
pub(crate) struct Locator<const T: usize> {
    pub(crate) max_speed_mm_s: f32,
    pub(crate) max_force_n: f32,
    /// Blocks of eight triangles in use.
    blocks: usize,
    corners: [[u8; 3]; T],
    // First corner, and the rows of the inverse of the edge matrix: weights of the
    // second and third corner are linear in the offset from the first, which keeps
    // slivers accurate.
    speed0: [f32; T],
    force0: [f32; T],
    w1_speed: [f32; T],
    w1_force: [f32; T],
    w2_speed: [f32; T],
    w2_force: [f32; T],
}

impl<const T: usize> Locator<T> {
    pub(crate) const EMPTY: Self = Self {
        max_speed_mm_s: 0.0,
        max_force_n: 0.0,
        blocks: 0,
        corners: [[0; 3]; T],
        speed0: [0.0; T],
        force0: [0.0; T],
        w1_speed: [f32::NAN; T],
        w1_force: [f32::NAN; T],
        w2_speed: [f32::NAN; T],
        w2_force: [f32::NAN; T],
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
        self.blocks = triangles.len().div_ceil(LANES);
        for (t, triangle) in triangles.enumerate().take(T) {
            let point = |v| {
                let (speed, force) = corner(v);
                (f64::from(speed), f64::from(force))
            };
            let ((x0, y0), (x1, y1), (x2, y2)) =
                (point(triangle[0]), point(triangle[1]), point(triangle[2]));
            let twice_area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
            self.corners[t] = triangle;
            let [w1_speed, w1_force, w2_speed, w2_force] =
                [y2 - y0, x0 - x2, y0 - y1, x1 - x0].map(|side| side / twice_area);
            let reach = (w1_speed.abs() + w2_speed.abs()) * f64::from(max_speed_mm_s)
                + (w1_force.abs() + w2_force.abs()) * f64::from(max_force_n);
            // A triangle with no area, or too thin for f32 to weigh, keeps its NaN rows
            // and is never chosen: its points belong to its neighbours.
            if reach < MAX_REACH {
                self.speed0[t] = x0 as f32;
                self.force0[t] = y0 as f32;
                self.w1_speed[t] = w1_speed as f32;
                self.w1_force[t] = w1_force as f32;
                self.w2_speed[t] = w2_speed as f32;
                self.w2_force[t] = w2_force as f32;
            }
        }
    }

    #[inline]
    fn weights(&self, t: usize, speed: f32, force: f32) -> [f32; 3] {
        let ds = speed - self.speed0[t];
        let df = force - self.force0[t];
        let w1 = self.w1_speed[t] * ds + self.w1_force[t] * df;
        let w2 = self.w2_speed[t] * ds + self.w2_force[t] * df;
        [1.0 - w1 - w2, w1, w2]
    }

    /// The mixture at a speed and a force; finite and convex for every input.
    #[inline]
    pub(crate) fn locate(&self, speed_mm_s: f32, force_n: f32) -> Barycentric {
        let speed = clamp_from_zero(speed_mm_s, self.max_speed_mm_s);
        let force = clamp_from_zero(force_n, self.max_force_n);
        let mut best = [f32::NEG_INFINITY; LANES];
        let mut winner = [0_u32; LANES];
        let blocks = self
            .speed0
            .as_chunks::<LANES>()
            .0
            .iter()
            .zip(self.force0.as_chunks::<LANES>().0)
            .zip(self.w1_speed.as_chunks::<LANES>().0)
            .zip(self.w1_force.as_chunks::<LANES>().0)
            .zip(self.w2_speed.as_chunks::<LANES>().0)
            .zip(self.w2_force.as_chunks::<LANES>().0);
        let mut first = 0_u32;
        for (((((speed0, force0), w1_speed), w1_force), w2_speed), w2_force) in
            blocks.take(self.blocks)
        {
            for lane in 0..LANES {
                let ds = speed - speed0[lane];
                let df = force - force0[lane];
                let w1 = w1_speed[lane] * ds + w1_force[lane] * df;
                let w2 = w2_speed[lane] * ds + w2_force[lane] * df;
                // NaN rows compare false and lose.
                let smallest = min(min(1.0 - w1 - w2, w1), w2);
                let wins = smallest > best[lane];
                best[lane] = if wins { smallest } else { best[lane] };
                winner[lane] = if wins { first } else { winner[lane] };
            }
            first += LANES as u32;
        }
        let (mut top, mut t) = (best[0], winner[0]);
        for lane in 1..LANES {
            let wins = best[lane] > top;
            top = if wins { best[lane] } else { top };
            t = if wins { winner[lane] + lane as u32 } else { t };
        }
        let t = (t as usize) % T;
        let cut = self.weights(t, speed, force).map(|w| max(w, 0.0));
        let scale = 1.0 / (cut[0] + cut[1] + cut[2]);
        Barycentric {
            vertices: self.corners[t],
            weights: cut.map(|w| w * scale),
            outside: !(speed == speed_mm_s && force == force_n),
        }
    }
}
