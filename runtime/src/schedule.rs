//! Which share of location and conversion each tick of a cycle does.
//!
//! Location looks at triangles in blocks of four, the best makes a mixture, and conversion
//! multiplies two pairs of zeros at a time: a fixed list of items, cut into [`CYCLE_TICKS`]
//! shares when a texture is loaded, such that the dearest one costs least. What comes out does not depend on where
//! the cuts are.

use crate::{arithmetic::Arithmetic, lsf::Shape};
use core::ops::Range;

/// Ticks from one query to the next; a query takes effect in the last of them.
pub const CYCLE_TICKS: usize = 6;

/// What each item costs, in executed instructions; only ratios matter.
struct Costs {
    /// The query, before the first block.
    begin: usize,
    block: usize,
    /// The choice of a triangle, and its mixture.
    mix: usize,
    mix_four: usize,
    /// A two, and each of the coefficients that it makes.
    two: usize,
    coefficient: usize,
    assembly_four: usize,
}

/// On x86-64, and on a Cortex-M4F, where four lanes are four numbers.
const fn costs<A: Arithmetic>() -> Costs {
    if A::IN_REGISTERS {
        Costs {
            begin: 40,
            block: 33,
            mix: 140,
            mix_four: 12,
            two: 28,
            coefficient: 10,
            assembly_four: 37,
        }
    } else {
        Costs {
            begin: 45,
            block: 65,
            mix: 150,
            mix_four: 36,
            two: 40,
            coefficient: 14,
            assembly_four: 44,
        }
    }
}

/// The share of one tick: blocks first, then the mixture, then twos.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Share {
    /// Blocks of triangles to look at.
    pub(crate) blocks: u8,
    pub(crate) mixes: bool,
    twos: (u8, u8),
}

impl Share {
    pub(crate) const NONE: Self = Self {
        blocks: 0,
        mixes: false,
        twos: (0, 0),
    };

    /// Parts of twos to multiply in.
    #[inline(always)]
    pub(crate) fn twos(&self) -> Range<usize> {
        self.twos.0.into()..self.twos.1.into()
    }
}

/// The shares of all ticks, with room for any index of four bits.
#[derive(Debug, Clone)]
pub(crate) struct Shares([Share; 16]);

impl Shares {
    pub(crate) const NONE: Self = Self([Share::NONE; 16]);

    #[inline(always)]
    pub(crate) fn of(&self, phase: u8) -> &Share {
        &self.0[usize::from(phase % 16)]
    }
}

/// Work in order, and what each item of it costs.
struct Items {
    costs: Costs,
    blocks: usize,
    mix: usize,
    parts: usize,
    parts_of_two: usize,
    /// What the last tick does in any case.
    assembly: usize,
}

impl Items {
    const fn count(&self) -> usize {
        self.blocks + 1 + self.parts
    }

    const fn cost(&self, item: usize) -> usize {
        if item < self.blocks {
            self.costs.block
        } else if item == self.blocks {
            self.mix
        } else {
            let two = (item - self.blocks - 1) / self.parts_of_two;
            self.costs.two + self.costs.coefficient * 2 * (two + 1)
        }
    }

    /// What the dearest tick has to be allowed, within [`STEP`].
    fn limit(&self, ticks: usize) -> usize {
        // Less than the mean or the dearest item will not do.
        let (mut total, mut dearest) = (self.costs.begin + self.assembly, 0);
        for cost in (0..self.count()).map(|item| self.cost(item)) {
            (total, dearest) = (total + cost, dearest.max(cost));
        }
        let mut limit = dearest.max(total / ticks) / STEP * STEP;
        while self.cut(ticks, limit, |_, _| ()) > limit {
            limit += STEP;
        }
        limit
    }

    /// Gives each item in turn to the tick under way, or to the next one where that would cost
    /// more than `limit`; the first one looks at blocks only. Returns what the dearest tick costs.
    fn cut(&self, ticks: usize, limit: usize, mut give: impl FnMut(usize, usize)) -> usize {
        let (mut tick, mut spent, mut most) = (0, self.costs.begin, 0);
        for item in 0..self.count() {
            let cost = self.cost(item);
            let only_blocks = tick == 0 && item >= self.blocks;
            if tick + 1 < ticks && (spent + cost > limit || only_blocks) {
                (tick, spent) = (tick + 1, 0);
                if tick + 1 == ticks {
                    spent = self.assembly;
                }
            }
            spent += cost;
            most = most.max(spent);
            give(item, tick);
        }
        most.max(self.assembly)
    }
}

/// The shares of `blocks` blocks of triangles, a mixture of rows of `fours` fours and the
/// conversion of a shape, in `ticks` ticks whose dearest one costs as little as can be.
pub(crate) fn shares<A: Arithmetic>(
    blocks: usize,
    fours: usize,
    shape: &Shape,
    ticks: usize,
) -> Shares {
    let costs = costs::<A>();
    let halves = [shape.ar_order(), shape.ma_order()].map(|order| order.div_ceil(2).div_ceil(4));
    let items = Items {
        blocks,
        mix: costs.mix + costs.mix_four * fours,
        parts: shape.twos() * shape.parts::<A>(),
        parts_of_two: shape.parts::<A>(),
        assembly: costs.assembly_four * (halves[0] + halves[1]),
        costs,
    };
    let limit = items.limit(ticks);

    let mut shares = Shares::NONE.0;
    items.cut(ticks, limit, |item, tick| {
        let share = &mut shares[tick % 16];
        if item < blocks {
            share.blocks += 1;
        } else if item == blocks {
            share.mixes = true;
        } else {
            let part = (item - blocks - 1) as u8;
            if share.twos.1 == 0 {
                share.twos.0 = part;
            }
            share.twos.1 = part + 1;
        }
    });
    Shares(shares)
}

/// Limits are tried so far apart, in instructions.
const STEP: usize = 16;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::Fixed;

    /// What the dearest tick costs at least, from tick `tick` and item `from` on, by trying all.
    fn least(items: &Items, ticks: usize, tick: usize, from: usize) -> usize {
        let run = |to: usize| (from..to).map(|item| items.cost(item)).sum::<usize>();
        if tick + 1 == ticks {
            return items.assembly + run(items.count());
        }
        let last = if tick == 0 {
            items.blocks
        } else {
            items.count()
        };
        let begin = if tick == 0 { items.costs.begin } else { 0 };
        let ends = from..=last;
        let dearest = ends.map(|to| (begin + run(to)).max(least(items, ticks, tick + 1, to)));
        dearest.min().unwrap_or(usize::MAX)
    }

    #[test]
    fn no_cut_is_cheaper_by_a_step_and_every_item_is_done_once_in_turn() {
        for (blocks, parts, mix, ticks) in [
            (6, 10, 340, 6),
            (1, 1, 150, 6),
            (12, 5, 260, 4),
            (3, 12, 40, 5),
            (0, 6, 900, 6),
        ] {
            let items = Items {
                costs: costs::<Fixed>(),
                blocks,
                mix,
                parts,
                parts_of_two: 2,
                assembly: 130,
            };
            let limit = items.limit(ticks);
            assert!(limit < least(&items, ticks, 0, 0) + STEP, "{limit}");
            let (mut next, mut last) = (0, 0);
            items.cut(ticks, limit, |item, tick| {
                assert!(item == next && tick >= last && tick < ticks);
                (next, last) = (next + 1, tick);
            });
            assert_eq!(next, items.count());
        }
    }
}
