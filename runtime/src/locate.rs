//! Which triangle of the speed–force grid a query falls into, and its weights.
//!
//! Triangles stand in blocks of four neighbours. Each axis is cut into strips, and each strip
//! knows the blocks that it meets: those that both strips of a query meet are looked at, from that
//! of the triangle found last on, until one has a triangle with the query in it. There is no path
//! to walk, so nothing can hang on an edge. On a shared edge or vertex either neighbour wins and
//! both give the same mixture; where the triangles leave a gap, the one whose smallest barycentric
//! weight is largest wins, where they overlap, the first. Weights below zero are cut, so the
//! mixture is convex whatever the query.
//!
//! Outside the measured range the query is moved to the nearest point of the border
//! (edge model): constant extrapolation, continuous with the inside.

mod order;

use crate::{
    arithmetic::{
        Arithmetic, Float, Four, Number, Scalar as _, Zero as _,
        units::{Coordinate, FAR, MillimetrePerSecond, Newton, Slope, Unit, Weight},
    },
    math::{max, min},
    workspace::Workspace,
};
use asperity_formats::limits::MAX_TRIANGLES;

/// Triangles evaluated side by side.
const LANES: usize = 4;
/// Numbers of a block.
const BLOCK: usize = 6 * LANES;
/// Strips of an axis.
const STRIPS: usize = 32;
/// A block meets strips this much beyond it, in strips: far more than rounding, and than what
/// triangles too thin to weigh leave to their neighbours.
const MARGIN: f32 = 0.1;
/// Change of the weights over the whole grid beyond which a triangle is too thin: f32
/// rounding would move them by 1 % and more. It is 1e-5 of the grid thin, so its points
/// are within 1e-5 of a neighbour. One triangle in 128 that tile the grid always is wider.
const MAX_REACH: f64 = 1.0e5;

/// A convex mixture of three vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Barycentric<A: Arithmetic = Float> {
    /// Vertex indices.
    pub vertices: [u8; 3],
    /// Weights in [0, 1] that sum to 1 within rounding.
    pub weights: [A::Scalar<Unit>; 3],
    /// Whether the query lay outside the grid and was moved to its border.
    pub outside: bool,
}

/// The triangles, prepared for queries; at most `T`, a multiple of 4.
#[derive(Debug, Clone)]
pub(crate) struct Locator<const T: usize, A: Arithmetic> {
    pub(crate) max_speed_mm_s: Number<A, MillimetrePerSecond>,
    pub(crate) max_force_n: Number<A, Newton>,
    speed_strips: Strips<A>,
    force_strips: Strips<A>,
    /// Blocks of triangles that a query looks at, at most.
    blocks: usize,
    corners: [[u8; 3]; T],
    rows: Rows<T, A>,
}

/// The blocks that each strip of an axis meets, one bit a block. Strip i reaches half a strip
/// to either side of i.
#[derive(Debug, Clone)]
struct Strips<A: Arithmetic> {
    per_unit: Number<A, Slope>,
    blocks: [u32; STRIPS],
}

impl<A: Arithmetic> Strips<A> {
    const EMPTY: Self = Self {
        per_unit: Number::ZERO,
        blocks: [0; STRIPS],
    };

    /// Of an axis from 0 to `longest`.
    fn new(longest: f32) -> Self {
        let per_unit = if longest > 0.0 {
            (STRIPS - 1) as f32 / longest
        } else {
            0.0
        };
        Self {
            per_unit: Number::of(per_unit),
            ..Self::EMPTY
        }
    }

    /// The strip of a number from 0 to the longest.
    #[inline(always)]
    fn strip(&self, x: Number<A, Coordinate>) -> usize {
        A::nearest(x.times::<Slope, Coordinate>(self.per_unit).0) as usize % STRIPS
    }

    #[inline(always)]
    fn at(&self, x: Number<A, Coordinate>) -> u32 {
        self.blocks[self.strip(x)]
    }

    /// Block `block` reaches from `low` to `high`. Before [`Strips::turn`] a block stands where
    /// a strip does after it, and has a bit a strip.
    fn meets(&mut self, block: usize, low: f32, high: f32) {
        let [low, high] = [low, high].map(|x| x * self.per_unit.value());
        // The first strip at or above, and the last one at or below; a cast to a byte rounds down
        // to 0 and up, and costs less than one to a word.
        let [first, last] =
            [low - (0.5 + MARGIN), high + (0.5 + MARGIN)].map(|x| min(x, (STRIPS - 1) as f32));
        let from = u32::MAX << (first as u8 + u8::from(first > f32::from(first as u8)));
        let to = u32::MAX >> (STRIPS as u8 - 1 - last as u8);
        if let Some(strips) = self.blocks.get_mut(block) {
            *strips |= from & to;
        }
    }

    /// A bit a strip of each block to a bit a block of each strip: a transposition, halves of
    /// halves changing places (after Warren's "Hacker's Delight", 7-3).
    fn turn(&mut self) {
        let bits = &mut self.blocks;
        let (mut apart, mut low) = (STRIPS / 2, u32::MAX >> (STRIPS / 2));
        while apart > 0 {
            for pair in bits.chunks_exact_mut(2 * apart) {
                let (above, below) = pair.split_at_mut(apart);
                for (above, below) in above.iter_mut().zip(below) {
                    let exchanged = ((*above >> apart) ^ *below) & low;
                    *below ^= exchanged;
                    *above ^= exchanged << apart;
                }
            }
            apart /= 2;
            low ^= low << apart;
        }
    }
}

/// Six numbers a triangle, in blocks of four triangles: four times each of first corner's
/// speed and force, and the rows of the inverse of the edge matrix. Weights of the second
/// and third corner are linear in the offset from the first, which keeps slivers accurate.
#[derive(Debug, Clone)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
struct Rows<const T: usize, A: Arithmetic>([[A::Scalar<Coordinate>; 6]; T]);

impl<const T: usize, A: Arithmetic> Rows<T, A> {
    /// A block of no triangles: weights far below zero for every query, of a corner far off and
    /// a steep slope.
    const NEVER: [A::Scalar<Coordinate>; BLOCK] = {
        let mut rows = [A::Scalar::ZERO; BLOCK];
        let mut lane = 0;
        while lane < LANES {
            rows[lane] = A::FAR_OFF;
            rows[2 * LANES + lane] = A::STEEP;
            lane += 1;
        }
        rows
    };
    const EMPTY: Self = {
        let mut flat = [[A::Scalar::ZERO; 6]; T];
        let mut at = 0;
        while at < 6 * T {
            flat[at / 6][at % 6] = Self::NEVER[at % BLOCK];
            at += 1;
        }
        Self(flat)
    };
}

/// A search under way, of a query in the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Search<A: Arithmetic> {
    speed: Number<A, Coordinate>,
    force: Number<A, Coordinate>,
    /// The best triangle so far: its smallest weight, whose last bits are replaced by its index.
    /// Neighbours that differ by so little mix the same.
    best: A::Best,
    /// Blocks to look at, one bit each: the last bit is that of block `first`.
    left: u32,
    first: u32,
}

impl<A: Arithmetic> Search<A> {
    /// The best triangle so far.
    #[inline(always)]
    fn triangle(&self) -> usize {
        A::best(self.best, INDEX) as usize
    }

    /// Its block.
    #[inline(always)]
    pub(crate) fn block(&self) -> u8 {
        (self.triangle() / LANES) as u8
    }

    /// As bits.
    #[inline(always)]
    pub(crate) fn keep(&self, workspace: &mut Workspace) {
        let [best, rest, ..] = &mut workspace.0;
        A::keep_best(self.best, best);
        *rest = [
            self.left,
            self.first,
            self.speed.0.bits(),
            self.force.0.bits(),
        ];
    }

    /// Whether those bits are of a search that has blocks left.
    #[inline(always)]
    pub(crate) fn goes_on(workspace: &Workspace) -> bool {
        let [_, [left, ..], ..] = &workspace.0;
        *left != 0
    }

    /// Of those bits.
    #[inline(always)]
    pub(crate) fn kept(workspace: &Workspace) -> Self {
        let [best, [left, first, speed, force], ..] = &workspace.0;
        Self {
            speed: Number(A::Scalar::from_bits(*speed)),
            force: Number(A::Scalar::from_bits(*force)),
            best: A::kept_best(best),
            left: *left,
            first: *first,
        }
    }
}

/// Bits that hold an index.
const INDEX: u32 = MAX_TRIANGLES.next_power_of_two() as u32 - 1;

impl<const T: usize, A: Arithmetic> Locator<T, A> {
    pub(crate) const EMPTY: Self = Self {
        max_speed_mm_s: Number::ZERO,
        max_force_n: Number::ZERO,
        speed_strips: Strips::EMPTY,
        force_strips: Strips::EMPTY,
        blocks: 0,
        corners: [[0; 3]; T],
        rows: Rows::EMPTY,
    };

    /// Prepares triangles; `corner` gives (speed, force) of a vertex.
    pub(crate) fn load(
        &mut self,
        triangles: &[[u8; 3]],
        corner: impl Fn(u8) -> (f32, f32),
        max_speed_mm_s: f32,
        max_force_n: f32,
    ) {
        self.max_speed_mm_s = Number::of(max_speed_mm_s);
        self.max_force_n = Number::of(max_force_n);
        self.speed_strips = Strips::new(max_speed_mm_s);
        self.force_strips = Strips::new(max_force_n);
        self.corners = [[0; 3]; T];
        let extent = [self.max_speed_mm_s.value(), self.max_force_n.value()];
        let points = |[a, b, c]: [u8; 3]| [corner(a), corner(b), corner(c)];
        let count = self.sort(triangles, points);
        let corners = self.corners.get(..count).unwrap_or_default();
        let rows = self.rows.0.as_flattened_mut().as_chunks_mut::<BLOCK>().0;
        // What is left of earlier triangles is not in any strip.
        for (block, (corners, rows)) in corners.chunks(LANES).zip(rows).enumerate() {
            *rows = Rows::<T, A>::NEVER;
            for (lane, &corners) in corners.iter().enumerate() {
                let points = points(corners);
                if let Some(row) = row::<A>(points, extent) {
                    for (numbers, x) in rows.as_chunks_mut::<LANES>().0.iter_mut().zip(row) {
                        numbers[lane % LANES] = x;
                    }
                }
                let [speeds, forces] = [points.map(|(s, _)| s), points.map(|(_, f)| f)];
                self.speed_strips.meets(block, least(speeds), most(speeds));
                self.force_strips.meets(block, least(forces), most(forces));
            }
        }
        self.speed_strips.turn();
        self.force_strips.turn();
        self.count_blocks(count.div_ceil(LANES));
    }

    /// Takes the triangles in an order that makes neighbours of those that stand together: along
    /// a Z curve through their centres. Returns how many.
    fn sort(
        &mut self,
        triangles: &[[u8; 3]],
        points: impl Fn([u8; 3]) -> [(f32, f32); 3],
    ) -> usize {
        let mut places = [0; T];
        for (place, &triangle) in places.iter_mut().zip(triangles) {
            let [a, b, c] = points(triangle);
            let speed = Number::of((a.0 + b.0 + c.0) * (1.0 / 3.0));
            let force = Number::of((a.1 + b.1 + c.1) * (1.0 / 3.0));
            *place = order::interleaved(
                self.speed_strips.strip(speed),
                self.force_strips.strip(force),
            );
        }
        order::sort(triangles, &places, &mut self.corners);
        triangles.len().min(T)
    }

    /// How many of `all` blocks a query looks at: the most that two strips share. Where they
    /// share none (the triangles leave a gap), every query looks at all.
    fn count_blocks(&mut self, all: usize) {
        let (speeds, speed_count) = distinct(&self.speed_strips.blocks);
        let (forces, force_count) = distinct(&self.force_strips.blocks);
        let (mut least, mut most) = (u32::MAX, 0);
        for speed in &speeds[..speed_count] {
            for force in &forces[..force_count] {
                let shared = (speed & force).count_ones();
                (least, most) = (least.min(shared), most.max(shared));
            }
        }
        if least == 0 {
            let every = u32::MAX >> (u32::BITS as usize - all.clamp(1, 32));
            self.speed_strips.blocks = [every; STRIPS];
            self.force_strips.blocks = [every; STRIPS];
            self.blocks = all;
        } else {
            self.blocks = most as usize;
        }
    }

    /// Where number `k` of triangle `t` stands.
    const fn index(t: usize, k: usize) -> usize {
        t / LANES * (6 * LANES) + k * LANES + t % LANES
    }

    /// Blocks of four triangles that a query looks at, at most.
    pub(crate) const fn blocks(&self) -> usize {
        self.blocks
    }

    /// Whether a query lies outside the grid, or is none.
    #[inline]
    pub(crate) fn is_outside(
        &self,
        speed_mm_s: Number<A, MillimetrePerSecond>,
        force_n: Number<A, Newton>,
    ) -> bool {
        !(speed_mm_s <= self.max_speed_mm_s && force_n <= self.max_force_n)
    }

    /// Begins a search: for the nearest point of the grid's border where the query lies outside.
    /// It begins with block `first`, if that is one to look at.
    #[inline]
    pub(crate) fn begin(
        &self,
        speed_mm_s: Number<A, MillimetrePerSecond>,
        force_n: Number<A, Newton>,
        first: u8,
    ) -> Search<A> {
        let first = u32::from(first);
        let speed = speed_mm_s.clamp_from_zero(self.max_speed_mm_s).to();
        let force = force_n.clamp_from_zero(self.max_force_n).to();
        Search {
            speed,
            force,
            best: A::WORST,
            left: (self.speed_strips.at(speed) & self.force_strips.at(force)).rotate_right(first),
            first,
        }
    }

    /// Looks at up to `blocks` more blocks, until a triangle has the query.
    #[inline]
    pub(crate) fn look(&self, search: &mut Search<A>, blocks: usize) {
        let (speed, force) = (Four::splat(search.speed), Four::splat(search.force));
        let mut best = search.best;
        let one = Four::splat(Number::whole(1));
        let all = self.rows.0.as_flattened().as_chunks::<LANES>().0;
        let all = all.as_chunks::<6>().0;
        for _ in 0..blocks {
            if search.left == 0 {
                break;
            }
            let block = search.left.trailing_zeros().wrapping_add(search.first) % u32::BITS;
            let Some([speed0, force0, w1s, w1f, w2s, w2f]) = all.get(block as usize) else {
                break;
            };
            search.left &= search.left - 1;
            let ds = speed - Four::load(speed0);
            let df = force - Four::load(force0);
            let [w1s, w1f, w2s, w2f] = [w1s, w1f, w2s, w2f].map(Four::<A, Slope>::load);
            let w1 = Four::<A, Weight>::sum_within([(ds, w1s), (df, w1f)], FAR);
            let w2 = Four::<A, Weight>::sum_within([(ds, w2s), (df, w2f)], FAR);
            let smallest = (one - w1 - w2).min(w1).min(w2);
            best = A::better(best, smallest.0, INDEX, block * LANES as u32);
            if A::is_inside(best) {
                search.left = 0;
            }
        }
        search.best = best;
    }

    /// The mixture of the best triangle; finite and convex for every query in the grid.
    #[inline]
    pub(crate) fn choose(&self, search: &Search<A>) -> Barycentric<A> {
        let t = search.triangle();
        let flat = self.rows.0.as_flattened();
        let number =
            |k: usize| Number::<A, Slope>(flat.get(Self::index(t, k)).copied().unwrap_or_default());
        let (ds, df) = (search.speed - number(0), search.force - number(1));
        let w1 = Number::<A, Weight>::sum_within([(ds, number(2)), (df, number(3))], FAR);
        let w2 = Number::<A, Weight>::sum_within([(ds, number(4)), (df, number(5))], FAR);
        let one = Number::whole(1);
        let cut = [one - w1 - w2, w1, w2].map(|w| w.max(Number::ZERO));
        let sum = cut[0] + cut[1] + cut[2];
        // Without a triangle there are no weights.
        let scale = if sum > Number::ZERO {
            one.over(sum)
        } else {
            Number::<A, Unit>::ZERO
        };
        Barycentric {
            vertices: self.corners.get(t).copied().unwrap_or_default(),
            weights: cut.map(|w| w.times::<Unit, Unit>(scale).0),
            outside: false,
        }
    }

    /// The mixture at a speed and a force; finite and convex for every input.
    pub(crate) fn locate(
        &self,
        speed_mm_s: Number<A, MillimetrePerSecond>,
        force_n: Number<A, Newton>,
    ) -> Barycentric<A> {
        let mut search = self.begin(speed_mm_s, force_n, 0);
        self.look(&mut search, self.blocks);
        Barycentric {
            outside: self.is_outside(speed_mm_s, force_n),
            ..self.choose(&search)
        }
    }
}

/// Each number that is not the one before, and how many there are.
fn distinct(numbers: &[u32; STRIPS]) -> ([u32; STRIPS], usize) {
    let (mut found, mut count) = ([0; STRIPS], 0);
    let mut before = !numbers[0];
    for &number in numbers {
        found[count % STRIPS] = number;
        count += usize::from(number != before);
        before = number;
    }
    (found, count.min(STRIPS))
}

/// The numbers of a triangle with these corners, in a grid that reaches so far. A triangle with
/// no area, or too thin to weigh, has none and is never chosen: its points belong to its neighbours.
fn row<A: Arithmetic>(
    points: [(f32, f32); 3],
    extent: [f32; 2],
) -> Option<[A::Scalar<Coordinate>; 6]> {
    let [(x0, y0), (x1, y1), (x2, y2)] = points.map(|(x, y)| (f64::from(x), f64::from(y)));
    let per_twice_area = 1.0 / ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0));
    let inverse = [y2 - y0, x0 - x2, y0 - y1, x1 - x0].map(|side| side * per_twice_area);
    let [speed, force] = extent.map(f64::from);
    let reach = (inverse[0].abs() + inverse[2].abs()) * speed
        + (inverse[1].abs() + inverse[3].abs()) * force;
    let held = inverse.iter().all(|&x| A::Scalar::<Slope>::holds(x as f32));
    let row = [x0, y0, inverse[0], inverse[1], inverse[2], inverse[3]];
    (reach < MAX_REACH && held).then(|| row.map(|x| A::Scalar::of(x as f32)))
}

fn least(x: [f32; 3]) -> f32 {
    min(min(x[0], x[1]), x[2])
}

fn most(x: [f32; 3]) -> f32 {
    max(max(x[0], x[1]), x[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::Float;

    #[test]
    fn each_strip_knows_the_blocks_that_meet_it() {
        let mut strips = Strips::<Float>::new((STRIPS - 1) as f32);
        let span = |block: usize| {
            let low = (block * 7 % 29) as f32 + 0.3;
            (low, low + (block % 5) as f32)
        };
        for block in 0..MAX_TRIANGLES / LANES {
            let (low, high) = span(block);
            strips.meets(block, low, high);
            strips.meets(block, high, high + 0.5);
        }
        strips.turn();
        for (strip, blocks) in strips.blocks.iter().enumerate() {
            for block in 0..MAX_TRIANGLES / LANES {
                let (low, high) = span(block);
                let reach = 0.5 + MARGIN;
                let met = low - reach <= strip as f32 && strip as f32 <= high + 0.5 + reach;
                assert_eq!(
                    blocks >> block & 1 == 1,
                    met,
                    "strip {strip}, block {block}"
                );
            }
        }
        let (found, count) = distinct(&strips.blocks);
        assert!(count > 1 && found[..count].windows(2).all(|pair| pair[0] != pair[1]));
    }
}
