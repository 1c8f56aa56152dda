//! The triangles of a grid, prepared for queries.

use super::{
    order,
    search::{INDEX, Search},
    strips::{STRIPS, Strips, distinct},
    triangle::{BLOCK, LANES, NUMBERS, index, never, row},
    weight::WeightSearch,
    weights::Barycentric,
};
use crate::{
    arithmetic::{Cut, Zero as _},
    capacity::Capacity,
    math::{max, min},
    model::edge::Extent,
    quantity::{
        Four, Quantity, Raw,
        product::FARTHEST_WEIGHT,
        unit::{Coordinate, Fraction, MillimetrePerSecond, Newton, Slope, Weight},
    },
};

/// The farthest that a weight falls outside its triangle.
const FAR: Cut = Cut::At(FARTHEST_WEIGHT);

/// The triangles of a grid.
#[derive(Debug, Clone)]
pub(crate) struct Grid<S: Capacity, A: WeightSearch> {
    /// The measured range.
    pub(crate) extent: Extent<A>,
    speed_strips: Strips<A>,
    force_strips: Strips<A>,
    /// Blocks of triangles that a query looks at, at most.
    blocks: usize,
    corners: S::Triangles<[u8; 3]>,
    rows: Rows<S, A>,
}

/// [`NUMBERS`] numbers a triangle, in blocks of four triangles.
#[derive(Debug, Clone)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
struct Rows<S: Capacity, A: WeightSearch>(S::Triangles<[Raw<A, Coordinate>; NUMBERS]>);

impl<S: Capacity, A: WeightSearch> Grid<S, A> {
    /// No triangles.
    pub(crate) const EMPTY: Self = Self {
        extent: Extent::NONE,
        speed_strips: Strips::EMPTY,
        force_strips: Strips::EMPTY,
        blocks: 0,
        corners: S::Triangles::ZERO,
        rows: Rows(S::Triangles::ZERO),
    };

    /// Prepares triangles; `corner` gives (speed, force) of a vertex.
    pub(crate) fn load(
        &mut self,
        triangles: &[[u8; 3]],
        corner: impl Fn(u8) -> (f32, f32),
        max_speed_mm_s: f32,
        max_force_n: f32,
    ) {
        self.extent = Extent::new(max_speed_mm_s, max_force_n);
        self.speed_strips = Strips::new(max_speed_mm_s);
        self.force_strips = Strips::new(max_force_n);
        self.corners = S::Triangles::ZERO;
        let extent = self.extent.values();
        let points = |[a, b, c]: [u8; 3]| [corner(a), corner(b), corner(c)];
        let count = self.sort(triangles, points);
        let corners = self.corners.as_ref().get(..count).unwrap_or_default();
        let rows = self.rows.0.as_mut().as_flattened_mut();
        let rows = rows.as_chunks_mut::<BLOCK>().0;
        let never = never::<A>();
        // Rows of an earlier texture may remain, but no strip names them.
        for (block, (corners, rows)) in corners.chunks(LANES).zip(rows).enumerate() {
            *rows = never;
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

    /// Sorts the triangles along a Z curve through their centres, so that triangles that stand
    /// together become neighbours. Returns how many there are.
    fn sort(
        &mut self,
        triangles: &[[u8; 3]],
        points: impl Fn([u8; 3]) -> [(f32, f32); 3],
    ) -> usize {
        let mut places = S::Triangles::<u16>::ZERO;
        let places = places.as_mut();
        for (place, &triangle) in places.iter_mut().zip(triangles) {
            let [a, b, c] = points(triangle);
            let speed = Quantity::of((a.0 + b.0 + c.0) * (1.0 / 3.0));
            let force = Quantity::of((a.1 + b.1 + c.1) * (1.0 / 3.0));
            *place = order::interleaved(
                self.speed_strips.strip(speed),
                self.force_strips.strip(force),
            );
        }
        order::sort::<_, S>(triangles, places, self.corners.as_mut());
        triangles.len().min(places.len())
    }

    /// Counts the blocks, of `all`, that a query examines: the most that two strips share. If any
    /// pair shares none (the triangles leave a gap), every query examines all.
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

    /// Blocks of four triangles that a query looks at, at most.
    pub(crate) const fn blocks(&self) -> usize {
        self.blocks
    }

    /// Begins a search. A query outside the grid is moved to the nearest point of its border. The
    /// search begins with block `first`, if that is one to look at.
    #[inline]
    pub(crate) fn begin(
        &self,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
        first: u8,
    ) -> Search<A> {
        let first = u32::from(first);
        let [speed, force] = self.extent.nearest(speed, force);
        Search {
            speed,
            force,
            best: A::WORST,
            left: (self.speed_strips.at(speed) & self.force_strips.at(force)).rotate_right(first),
            first,
        }
    }

    /// Looks at up to `blocks` more blocks, until a triangle contains the query.
    #[cfg_attr(target_arch = "arm", inline(never))]
    #[cfg_attr(not(target_arch = "arm"), inline)]
    pub(crate) fn look(&self, search: &mut Search<A>, blocks: usize) {
        let (speed, force) = (Four::splat(search.speed), Four::splat(search.force));
        let mut best = search.best;
        let one = Four::<A, Weight>::splat(Quantity::whole(1));
        let all = self.rows.0.as_ref().as_flattened().as_chunks::<LANES>().0;
        let all = all.as_chunks::<NUMBERS>().0;
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
            let w1 = Four::<A, Weight>::sum_of_products([(ds, w1s), (df, w1f)], FAR);
            let w2 = Four::<A, Weight>::sum_of_products([(ds, w2s), (df, w2f)], FAR);
            let smallest = (one - w1 - w2).min(w1).min(w2);
            best = A::better(best, smallest, INDEX, block * LANES as u32);
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
        let flat = self.rows.0.as_ref().as_flattened();
        let number = |k: usize| flat.get(index(t, k)).copied().unwrap_or_default();
        let ds: Quantity<A, Coordinate> = search.speed - Quantity(number(0));
        let df: Quantity<A, Coordinate> = search.force - Quantity(number(1));
        let slope = |k: usize| Quantity::<A, Slope>(number(k));
        let w1 = Quantity::<A, Weight>::sum_of_products([(ds, slope(2)), (df, slope(3))], FAR);
        let w2 = Quantity::<A, Weight>::sum_of_products([(ds, slope(4)), (df, slope(5))], FAR);
        let one = Quantity::whole(1);
        let cut = [one - w1 - w2, w1, w2].map(|w| w.settled().max(Quantity::ZERO));
        let sum = cut[0] + cut[1] + cut[2];
        // Without a triangle there are no weights.
        let scale = if sum > Quantity::ZERO {
            one.over(sum)
        } else {
            Quantity::<A, Fraction>::ZERO
        };
        Barycentric {
            vertices: self.corners.as_ref().get(t).copied().unwrap_or_default(),
            weights: cut.map(|w| w * scale),
            outside: false,
        }
    }

    /// The mixture at a speed and a force; finite and convex for every input.
    pub(crate) fn locate(
        &self,
        speed: Quantity<A, MillimetrePerSecond>,
        force: Quantity<A, Newton>,
    ) -> Barycentric<A> {
        let mut search = self.begin(speed, force, 0);
        self.look(&mut search, self.blocks);
        Barycentric {
            outside: self.extent.is_outside(speed, force),
            ..self.choose(&search)
        }
    }
}

fn least(x: [f32; 3]) -> f32 {
    min(min(x[0], x[1]), x[2])
}

fn most(x: [f32; 3]) -> f32 {
    max(max(x[0], x[1]), x[2])
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::{Fixed, Float, capacity::HostCapacities};
    use std::{boxed::Box, vec::Vec};

    type Host<A> = Grid<HostCapacities, A>;
    type Corners = Vec<(f32, f32)>;

    /// Squares of a lattice over 8 mm/s × 4 N, two triangles each, without those of some columns.
    fn lattice(columns: usize, rows: usize, gap: &[usize]) -> (Corners, Vec<[u8; 3]>) {
        let corner = |at: usize| {
            let (column, row) = (at % (columns + 1), at / (columns + 1));
            (
                8.0 * column as f32 / columns as f32,
                4.0 * row as f32 / rows as f32,
            )
        };
        let corners = (0..(columns + 1) * (rows + 1)).map(corner).collect();
        let mut triangles = Vec::new();
        for row in 0..rows {
            for column in (0..columns).filter(|column| !gap.contains(column)) {
                let at = (row * (columns + 1) + column) as u8;
                let above = at + columns as u8 + 1;
                triangles.extend([[at, at + 1, above], [at + 1, above + 1, above]]);
            }
        }
        (corners, triangles)
    }

    fn loaded<A: WeightSearch>((corners, triangles): &(Corners, Vec<[u8; 3]>)) -> Box<Host<A>> {
        let mut grid = Box::new(Host::EMPTY);
        grid.load(triangles, |v| corners[usize::from(v)], 8.0, 4.0);
        grid
    }

    /// The smallest weight of a point in a triangle, f64.
    fn smallest(corners: &[(f32, f32)], triangle: [u8; 3], (x, y): (f64, f64)) -> f64 {
        let [a, b, c] = triangle.map(|v| {
            let (x, y) = corners[usize::from(v)];
            (f64::from(x), f64::from(y))
        });
        let area = |p: (f64, f64), q: (f64, f64), r: (f64, f64)| {
            (q.0 - p.0) * (r.1 - p.1) - (r.0 - p.0) * (q.1 - p.1)
        };
        let (all, p) = (area(a, b, c), (x, y));
        let weights = [area(p, b, c), area(a, p, c), area(a, b, p)].map(|part| part / all);
        weights[0].min(weights[1]).min(weights[2])
    }

    /// The best triangle is the one whose smallest weight is largest, in a gap too, whatever block
    /// the search begins with, and wherever it pauses.
    #[test]
    fn a_search_finds_the_triangle_that_suits_best() {
        fn check<A: WeightSearch>() {
            for shape in [
                lattice(4, 3, &[]),
                lattice(7, 5, &[]),
                lattice(8, 4, &[3]),
                lattice(8, 6, &[0, 1, 2]),
                lattice(8, 6, &[4, 5, 6, 7]),
                lattice(1, 1, &[]),
            ] {
                let grid = loaded::<A>(&shape);
                let (corners, triangles) = &shape;
                for step in 0..400 {
                    let (x, y) = (
                        (step * 37 % 401) as f32 / 50.0,
                        (step * 91 % 397) as f32 / 100.0,
                    );
                    let at = (f64::from(x), f64::from(y));
                    let suits = |t: [u8; 3]| smallest(corners, t, at);
                    let best = triangles.iter().map(|&t| suits(t)).fold(f64::MIN, f64::max);
                    for first in [0, 1, 7, 31] {
                        let (v, f) = (Quantity::of(x), Quantity::of(y));
                        let mut search = grid.begin(v, f, first);
                        grid.look(&mut search, grid.blocks());
                        let chosen = suits(grid.choose(&search).vertices);
                        assert!(chosen > best.min(0.0) - 1e-3, "({x}, {y}): {chosen} {best}");
                        let mut paused = grid.begin(v, f, first);
                        for _ in 0..grid.blocks() {
                            grid.look(&mut paused, 1);
                        }
                        assert_eq!(paused, search);
                    }
                }
            }
        }
        check::<Float>();
        check::<Fixed>();
    }

    /// A query looks at the blocks near it. Where triangles leave a gap, it looks at all.
    #[test]
    fn a_query_looks_at_few_blocks_unless_there_is_a_gap() {
        fn check<A: WeightSearch>() {
            let shapes = [
                lattice(8, 6, &[]),
                lattice(8, 8, &[]),
                lattice(2, 2, &[]),
                lattice(1, 1, &[]),
                // 72 triangles.
                lattice(8, 6, &[3, 4]),
            ];
            let blocks = shapes.map(|shape| loaded::<A>(&shape).blocks());
            assert_eq!(blocks, [6, 4, 2, 1, 18]);
        }
        check::<Float>();
        check::<Fixed>();
    }
}
