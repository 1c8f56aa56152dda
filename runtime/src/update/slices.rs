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
