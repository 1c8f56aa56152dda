//! Noise that repeats after one patch, in both directions.
//!
//! A place is (u, v) in patches. A lattice has a whole number of cells a patch, so its noise is
//! the same at u and u + 1. Only + − × ÷ √ are used: the same bits on every machine.

use std::cell::Cell as Remembered;

/// A well-mixed number of a cell of a lattice.
#[must_use]
pub(crate) fn hash(x: i32, y: i32, seed: u32) -> u32 {
    let mut h = (x as u32)
        .wrapping_mul(0x9E37_79B1)
        .wrapping_add((y as u32).wrapping_mul(0x85EB_CA77))
        .wrapping_add(seed.wrapping_mul(0xC2B2_AE3D));
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    h ^ (h >> 15)
}

/// A number in 0..1 of a hash.
#[must_use]
pub(crate) fn unit(hash: u32) -> f32 {
    (hash >> 8) as f32 / (1 << 24) as f32
}

/// Another number in 0..1 of the same hash, the `n`th.
#[must_use]
pub(crate) fn nth(id: u32, n: i32) -> f32 {
    unit(hash(n, 77, id))
}

/// The largest whole number not above `x`. A cast and a comparison are faster than a call.
#[must_use]
pub(crate) fn floor(x: f32) -> i32 {
    let cut = x as i32;
    cut - i32::from(x < cut as f32)
}

/// A cell of a lattice of `n`, `n` cells on being the same one. A division takes longer than the
/// comparison that is nearly always enough.
fn wrapped(cell: i32, n: i32) -> i32 {
    if (0..n).contains(&cell) {
        cell
    } else {
        cell.rem_euclid(n)
    }
}

/// The part of `x` above its floor, 0..1.
#[must_use]
pub(crate) fn fract(x: f32) -> f32 {
    x - floor(x) as f32
}

/// 0 below `low`, 1 above `high`, smooth between; falls where `low` is above `high`.
#[must_use]
pub(crate) fn step(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The profile of a round thing: 1 in the middle, 0 at a distance of 1 and beyond.
#[must_use]
pub(crate) fn dome(distance: f32) -> f32 {
    (1.0 - distance * distance).max(0.0).sqrt()
}

/// The sine of `turns` turns.
#[must_use]
pub(crate) fn wave(turns: f32) -> f32 {
    libm::sinf(core::f32::consts::TAU * fract(turns))
}

/// Cells that a thread remembers of each kind of noise; a pattern asks for some twenty at a pixel.
const SLOTS: usize = 256;

/// A lattice's numbers of cells and seed, and one of its cells, not wrapped.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Key {
    cell: (i32, i32),
    cells: (i32, i32),
    seed: u32,
}

impl Key {
    /// No lattice has 0 cells.
    const NONE: Self = Self {
        cell: (0, 0),
        cells: (0, 0),
        seed: 0,
    };

    /// Where the cell is remembered.
    fn slot(self) -> usize {
        let cell = (self.cell.0 as u32).wrapping_add((self.cell.1 as u32) << 12);
        let lattice = self.seed.wrapping_mul(0x85EB_CA77) ^ ((self.cells.0 as u32) << 21);
        (cell ^ lattice).wrapping_mul(0x9E37_79B1) as usize >> (32 - SLOTS.ilog2())
    }
}

/// Slopes at the four corners of a cell: upper left, upper right, lower left, lower right.
type Slopes = [(f32, f32); 4];

thread_local! {
    // Neighbouring pixels mostly lie in one cell, so that few hashes are computed. What is
    // remembered is what would be computed: the same bits, whoever drew before.
    static SLOPES: [Remembered<(Key, Slopes)>; SLOTS] =
        const { [const { Remembered::new((Key::NONE, [(0.0, 0.0); 4])) }; SLOTS] };
    static POINTS: [Remembered<(Key, f32, Points)>; SLOTS] =
        const { [const { Remembered::new((Key::NONE, 0.0, [(0, 0.0, 0.0); 9])) }; SLOTS] };
}

/// The slopes of a cell's corners.
fn slopes(key: Key) -> Slopes {
    let ((x0, y0), (nx, ny)) = (key.cell, key.cells);
    let (xa, xb) = (wrapped(x0, nx), wrapped(x0 + 1, nx));
    let (ya, yb) = (wrapped(y0, ny), wrapped(y0 + 1, ny));
    let slope = |x: i32, y: i32| {
        let h = hash(x, y, key.seed);
        // Slopes on a square rather than a circle: no sine, and nobody sees it.
        (
            (h & 0xFFFF) as f32 * (2.0 / 65535.0) - 1.0,
            (h >> 16) as f32 * (2.0 / 65535.0) - 1.0,
        )
    };
    [slope(xa, ya), slope(xb, ya), slope(xa, yb), slope(xb, yb)]
}

/// Gradient noise of `nx` × `ny` cells a patch, about −1..1.
#[must_use]
pub(crate) fn gradient(u: f32, v: f32, nx: i32, ny: i32, seed: u32) -> f32 {
    let (x, y) = (u * nx as f32, v * ny as f32);
    let (x0, y0) = (floor(x), floor(y));
    let key = Key {
        cell: (x0, y0),
        cells: (nx, ny),
        seed,
    };
    let [a, b, c, d] = SLOPES.with(|all| {
        let slot = &all[key.slot()];
        let (known, slopes_there) = slot.get();
        if known == key {
            return slopes_there;
        }
        let found = slopes(key);
        slot.set((key, found));
        found
    });
    let (fx, fy) = (x - x0 as f32, y - y0 as f32);
    let corner = |(gx, gy): (f32, f32), dx: f32, dy: f32| gx * dx + gy * dy;
    let fade = |t: f32| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (sx, sy) = (fade(fx), fade(fy));
    let top = lerp(corner(a, fx, fy), corner(b, fx - 1.0, fy), sx);
    let bottom = lerp(corner(c, fx, fy - 1.0), corner(d, fx - 1.0, fy - 1.0), sx);
    1.6 * lerp(top, bottom, sy)
}

/// Gradient noise in octaves, each twice as fine and half as strong, about −1..1.
#[must_use]
pub(crate) fn octaves(u: f32, v: f32, nx: i32, ny: i32, count: u32, seed: u32) -> f32 {
    let (mut sum, mut weight, mut nx, mut ny) = (0.0, 0.5, nx, ny);
    for octave in 0..count {
        sum += weight * gradient(u, v, nx, ny, seed.wrapping_add(octave * 101));
        weight *= 0.5;
        nx *= 2;
        ny *= 2;
    }
    sum * 1.4
}

/// A number between two.
#[must_use]
pub(crate) fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Cellular noise at a place: points strewn over a lattice, one per cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cell {
    /// Hash of the nearest point.
    pub(crate) id: u32,
    /// Distance to the nearest point, cells.
    pub(crate) near: f32,
    /// Distance to the border with the next point's cell, cells.
    pub(crate) edge: f32,
    /// Way from the nearest point, cells.
    pub(crate) way: (f32, f32),
}

/// Hashes and places of the points in and around a cell, row by row; places in cells.
type Points = [(u32, f32, f32); 9];

/// The points in and around a cell.
fn points(key: Key, jitter: f32) -> Points {
    let ((x0, y0), (nx, ny)) = (key.cell, key.cells);
    let mut points = [(0, 0.0, 0.0); 9];
    for (k, point) in (0..).zip(&mut points) {
        let (x, y) = (x0 + k % 3 - 1, y0 + k / 3 - 1);
        let h = hash(wrapped(x, nx), wrapped(y, ny), key.seed);
        *point = (
            h,
            x as f32 + 0.5 + jitter * ((h & 0xFFFF) as f32 / 65535.0 - 0.5),
            y as f32 + 0.5 + jitter * ((h >> 16) as f32 / 65535.0 - 0.5),
        );
    }
    points
}

/// The cell of a place among points strewn over `nx` × `ny` cells; `jitter` 0 leaves the points
/// in the middle of their cells, 1 strews them all over.
#[must_use]
pub(crate) fn cell(u: f32, v: f32, nx: i32, ny: i32, jitter: f32, seed: u32) -> Cell {
    let (x, y) = (u * nx as f32, v * ny as f32);
    let key = Key {
        cell: (floor(x), floor(y)),
        cells: (nx, ny),
        seed,
    };
    let points = POINTS.with(|all| {
        let slot = &all[key.slot()];
        let (known, known_jitter, points_there) = slot.get();
        if known == key && known_jitter == jitter {
            return points_there;
        }
        let found = points(key, jitter);
        slot.set((key, jitter, found));
        found
    });
    let (mut best, mut next) = (f32::MAX, f32::MAX);
    let (mut way, mut other, mut id) = ((0.0, 0.0), (0.0, 0.0), 0);
    for (h, px, py) in points {
        let (dx, dy) = (x - px, y - py);
        let d = dx * dx + dy * dy;
        if d < best {
            next = best;
            other = way;
            best = d;
            way = (dx, dy);
            id = h;
        } else if d < next {
            next = d;
            other = (dx, dy);
        }
    }
    let (px, py) = (way.0 - other.0, way.1 - other.1);
    let apart = (px * px + py * py).sqrt().max(1e-6);
    Cell {
        id: hash(id as i32, 3, seed),
        near: best.sqrt(),
        edge: (next - best) / (2.0 * apart),
        way,
    }
}

/// Numbers in 0..1, one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Sequence {
    seed: u32,
    at: i32,
}

impl Sequence {
    pub(crate) fn new(seed: u32) -> Self {
        Self { seed, at: 0 }
    }

    /// The next number, 0..1.
    pub(crate) fn next(&mut self) -> f32 {
        self.at += 1;
        unit(hash(self.at, 11, self.seed))
    }

    /// The next number, −1..1.
    pub(crate) fn signed(&mut self) -> f32 {
        2.0 * self.next() - 1.0
    }

    /// The next whole number.
    pub(crate) fn id(&mut self) -> u32 {
        self.at += 1;
        hash(self.at, 13, self.seed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_the_same_a_patch_further() {
        for k in 0..200 {
            let (u, v) = (nth(9, k), nth(10, k));
            let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-3, "{a} {b}");
            near(gradient(u, v, 7, 3, 1), gradient(u + 1.0, v - 1.0, 7, 3, 1));
            near(octaves(u, v, 4, 4, 4, 1), octaves(u, v + 1.0, 4, 4, 4, 1));
            let (a, b) = (cell(u, v, 9, 9, 1.0, 2), cell(u + 1.0, v, 9, 9, 1.0, 2));
            near(a.near, b.near);
        }
    }

    #[test]
    fn floor_goes_down_on_both_sides_of_zero() {
        assert_eq!(
            [floor(-1.0), floor(-0.1), floor(0.0), floor(1.9)],
            [-1, -1, 0, 1]
        );
    }
}
