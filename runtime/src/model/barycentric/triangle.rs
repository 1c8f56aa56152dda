//! The numbers that weights need of a triangle, in blocks of four triangles.

use super::weight::WeightSearch;
use crate::{
    arithmetic::{Scalar as _, Zero as _},
    quantity::{
        Raw,
        unit::{Coordinate, Slope},
    },
};

/// Triangles evaluated side by side.
pub(super) const LANES: usize = 4;
/// Numbers of a triangle: first corner's speed and force, and the rows of the inverse of the edge
/// matrix. Weights of the second and third corner are linear in the offset from the first, which
/// keeps slivers accurate.
pub(super) const NUMBERS: usize = 6;
/// Numbers of a block: four times each of the above.
pub(super) const BLOCK: usize = NUMBERS * LANES;
/// A triangle whose weights change by more than this over the whole grid is too thin: rounding in
/// f32 would move them by 1 % and more. Its width is 1e-5 of the grid, so its points are within
/// 1e-5 of a neighbour. Of 128 triangles that tile the grid, one is always wider.
const MAX_REACH: f64 = 1.0e5;

/// A block without triangles. A corner far off and a steep slope give weights far below zero for
/// every query.
pub(super) fn never<A: WeightSearch>() -> [Raw<A, Coordinate>; BLOCK] {
    let mut block = [A::Scalar::ZERO; BLOCK];
    block[..LANES].fill(A::FAR_OFF);
    block[2 * LANES..3 * LANES].fill(A::STEEP);
    block
}

/// Index of number `k` of triangle `t`.
pub(super) const fn index(t: usize, k: usize) -> usize {
    t / LANES * BLOCK + k * LANES + t % LANES
}

/// The numbers of a triangle with these corners, in a grid that reaches so far. A triangle with no
/// area, or too thin to weigh, has none. It is never chosen, and its points belong to its
/// neighbours.
pub(super) fn row<A: WeightSearch>(
    points: [(f32, f32); 3],
    extent: [f32; 2],
) -> Option<[Raw<A, Coordinate>; 6]> {
    let [(x0, y0), (x1, y1), (x2, y2)] = points.map(|(x, y)| (f64::from(x), f64::from(y)));
    let per_twice_area = 1.0 / ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0));
    let inverse = [y2 - y0, x0 - x2, y0 - y1, x1 - x0].map(|side| side * per_twice_area);
    let [speed, force] = extent.map(f64::from);
    let reach = (inverse[0].abs() + inverse[2].abs()) * speed
        + (inverse[1].abs() + inverse[3].abs()) * force;
    let held = inverse.iter().all(|&x| Raw::<A, Slope>::holds(x as f32));
    let row = [x0, y0, inverse[0], inverse[1], inverse[2], inverse[3]];
    (reach < MAX_REACH && held).then(|| row.map(|x| A::Scalar::of(x as f32)))
}
