//! A search for the triangle of a query, which can stop and go on between blocks.

use super::{triangle::LANES, weight::WeightSearch};
use crate::{
    arithmetic::Scalar as _,
    model::scratch::Scratch,
    quantity::{Quantity, unit::Coordinate},
};
use asperity_formats::limits::MAX_TRIANGLES;

/// Bits that hold an index.
pub(super) const INDEX: u32 = MAX_TRIANGLES.next_power_of_two() as u32 - 1;

/// A search under way, of a query in the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Search<A: WeightSearch> {
    pub(super) speed: Quantity<A, Coordinate>,
    pub(super) force: Quantity<A, Coordinate>,
    /// The best triangle so far: its smallest weight, whose last bits are replaced by its index.
    /// Neighbours whose weights differ by so little mix the same.
    pub(super) best: A::Best,
    /// Blocks to look at, one bit each: the last bit stands for block `first`.
    pub(super) left: u32,
    pub(super) first: u32,
}

impl<A: WeightSearch> Search<A> {
    /// The best triangle so far.
    #[inline(always)]
    pub(super) fn triangle(&self) -> usize {
        A::index(self.best, INDEX) as usize
    }

    /// The block of the best triangle.
    #[inline(always)]
    pub(crate) fn block(&self) -> u8 {
        (self.triangle() / LANES) as u8
    }

    /// Stores the search as bits.
    #[inline(always)]
    pub(crate) fn keep(&self, scratch: &mut Scratch) {
        let [best, rest, ..] = &mut scratch.0;
        A::keep(self.best, best);
        *rest = [
            self.left,
            self.first,
            self.speed.0.bits(),
            self.force.0.bits(),
        ];
    }

    /// Returns true if the stored search has blocks left.
    #[inline(always)]
    pub(crate) fn goes_on(scratch: &Scratch) -> bool {
        let [_, [left, ..], ..] = &scratch.0;
        *left != 0
    }

    /// Loads a stored search.
    #[inline(always)]
    pub(crate) fn kept(scratch: &Scratch) -> Self {
        let [best, [left, first, speed, force], ..] = &scratch.0;
        Self {
            speed: Quantity(A::Scalar::from_bits(*speed)),
            force: Quantity(A::Scalar::from_bits(*force)),
            best: A::kept(best),
            left: *left,
            first: *first,
        }
    }
}
