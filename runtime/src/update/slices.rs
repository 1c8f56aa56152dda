//! Which slice of a cycle's work each tick does.
//!
//! What comes out does not depend on where the cuts are. It depends on how many slices a cycle has,
//! which is the same on every processor ([`cycle`]).

use super::{
    cost::{DEAREST, IN_REGISTERS, Items, Limits, ONE_BY_ONE},
    cycle::Cycle,
};
use crate::{arithmetic::Arithmetic, model::orders::Orders};
use core::ops::Range;

/// The slice of one tick: blocks first, then the mixture, then section pairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Slice {
    /// Blocks of triangles to look at.
    pub(crate) blocks: u8,
    pub(crate) mixes: bool,
    pairs: (u8, u8),
}

impl Slice {
    pub(crate) const NONE: Self = Self {
        blocks: 0,
        mixes: false,
        pairs: (0, 0),
    };

    /// Parts of section pairs to multiply in.
    #[inline(always)]
    pub(crate) fn section_pairs(&self) -> Range<usize> {
        self.pairs.0.into()..self.pairs.1.into()
    }
}

/// The slices of all ticks, with room for any index of four bits.
#[derive(Debug, Clone)]
pub(crate) struct Slices([Slice; 16]);

impl Slices {
    pub(crate) const NONE: Self = Self([Slice::NONE; 16]);

    #[inline(always)]
    pub(crate) fn of(&self, phase: u8) -> &Slice {
        &self.0[usize::from(phase % 16)]
    }
}

/// The cycle of a texture with `blocks` blocks of triangles to look at: the one that answers
/// soonest among those whose slices cost at most [`DEAREST`] on a Cortex-M4F. It is the same on
/// every processor.
pub(crate) fn cycle(blocks: usize, orders: &Orders) -> Cycle {
    let fours = [orders.ar(), orders.ma()].map(|order| order.div_ceil(4));
    let parts = orders.parts_one_by_one();
    let items = Items::new(ONE_BY_ONE, blocks, fours[0] + fours[1], orders, parts);
    let fits = |cycle: &Cycle| {
        let ticks = cycle.working().into();
        items.cut(ticks, Limits::of_all(DEAREST), |_, _| ())
    };
    Cycle::ALL.into_iter().find(fits).unwrap_or(Cycle::SLOWEST)
}

/// The slices of `blocks` blocks of triangles, a mixture of rows of `fours` fours and the
/// conversion at these orders, in `ticks` ticks, cut so that the costliest one costs least.
pub(crate) fn slices<A: Arithmetic>(
    blocks: usize,
    fours: usize,
    orders: &Orders,
    ticks: usize,
) -> Slices {
    let costs = if A::IN_REGISTERS {
        IN_REGISTERS
    } else {
        ONE_BY_ONE
    };
    let items = Items::new(costs, blocks, fours, orders, orders.parts::<A>());
    let limits = items.limits(ticks);

    let mut slices = Slices::NONE.0;
    items.cut(ticks, limits, |item, tick| {
        let slice = &mut slices[tick % 16];
        if item < blocks {
            slice.blocks += 1;
        } else if item == blocks {
            slice.mixes = true;
        } else {
            let part = (item - blocks - 1) as u8;
            if slice.pairs.1 == 0 {
                slice.pairs.0 = part;
            }
            slice.pairs.1 = part + 1;
        }
    });
    Slices(slices)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Fixed, Float};

    /// Bits depend on the cycle, so it is the same on every processor and in every version.
    #[test]
    fn the_cycle_of_a_texture_is_the_committed_one() {
        let working = |(ar, ma): (usize, usize)| {
            let orders = Orders::new(ar, ma);
            [1, 2, 4, 6, 8, 12, 20, 32].map(|blocks| cycle(blocks, &orders).working())
        };
        let orders = [
            (4, 0),
            (10, 0),
            (16, 0),
            (20, 0),
            (24, 0),
            (8, 8),
            (20, 18),
            (24, 24),
        ];
        let committed = [
            [4, 4, 4, 4, 4, 4, 6, 6],
            [4, 4, 4, 4, 4, 5, 6, 6],
            [4, 4, 4, 4, 4, 5, 6, 6],
            [4, 4, 4, 4, 5, 6, 6, 6],
            [4, 4, 4, 5, 5, 6, 6, 6],
            [4, 4, 4, 4, 4, 5, 6, 6],
            [5, 5, 6, 6, 6, 6, 6, 6],
            [6, 6, 6, 6, 6, 6, 6, 6],
        ];
        assert_eq!(orders.map(working), committed);
    }

    /// Each block, the mixture and each part once, in this order, within as many ticks.
    #[test]
    fn slices_hold_all_of_the_work_once_and_in_turn() {
        fn check<A: Arithmetic>() {
            for (ar, ma) in [(1, 0), (4, 0), (20, 0), (20, 18), (24, 24), (3, 24)] {
                let orders = Orders::new(ar, ma);
                let all = orders.section_pairs() * orders.parts::<A>();
                for blocks in [0, 1, 3, 9, 32] {
                    for ticks in [4, 5, 6, 13] {
                        let slices = slices::<A>(blocks, 6, &orders, ticks);
                        let (mut looked, mut mixed, mut next) = (0, 0, 0);
                        for tick in 0..16 {
                            let slice = slices.of(tick);
                            let works = *slice != Slice::NONE;
                            assert!(!works || usize::from(tick) < ticks);
                            assert!(slice.blocks == 0 || mixed == 0, "blocks come first");
                            looked += usize::from(slice.blocks);
                            mixed += usize::from(slice.mixes);
                            let pairs = slice.section_pairs();
                            if !pairs.is_empty() {
                                assert!(mixed == 1 && pairs.start == next);
                                next = pairs.end;
                            }
                        }
                        assert_eq!((looked, mixed, next), (blocks, 1, all));
                        assert!(!slices.of(0).mixes && slices.of(0).section_pairs().is_empty());
                    }
                }
            }
        }
        check::<Float>();
        check::<Fixed>();
    }
}
