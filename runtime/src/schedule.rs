//! Which share of location and conversion each tick of a cycle does.
//!
//! Location looks at triangles in blocks of four, the best makes a mixture, and conversion
//! multiplies two pairs of zeros at a time: a fixed list of items, cut into shares when a texture
//! is loaded, such that the dearest one costs least. What comes out does not depend on where the
//! cuts are, but it does on how many shares a cycle has: that is the same everywhere ([`cycle`]).

use crate::{arithmetic::Arithmetic, cycle::Cycle, lsf::Shape};
use core::ops::Range;

/// What each item costs, in executed instructions; only ratios matter to the cuts.
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

/// On x86-64.
const IN_REGISTERS: Costs = Costs {
    begin: 40,
    block: 33,
    mix: 140,
    mix_four: 16,
    two: 28,
    coefficient: 10,
    assembly_four: 37,
};
/// On a Cortex-M4F, where four lanes are four numbers.
const ONE_BY_ONE: Costs = Costs {
    begin: 110,
    block: 145,
    mix: 190,
    mix_four: 38,
    two: 45,
    coefficient: 14,
    assembly_four: 50,
};
/// No share costs more there, where that can be: a tick of order 20 with an MA part then takes
/// some 1,400 instructions.
const DEAREST: usize = 640;

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
    fn new(costs: Costs, blocks: usize, fours: usize, shape: &Shape, parts: usize) -> Self {
        let halves =
            [shape.ar_order(), shape.ma_order()].map(|order| order.div_ceil(2).div_ceil(4));
        Self {
            blocks,
            mix: costs.mix + costs.mix_four * fours,
            parts: shape.twos() * parts,
            parts_of_two: parts,
            assembly: costs.assembly_four * (halves[0] + halves[1]),
            costs,
        }
    }

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

    /// What the dearest tick has to be allowed, and what those after the blocks have to be, within
    /// [`STEP`].
    fn limits(&self, ticks: usize) -> Limits {
        // Less than the mean or the dearest item will not do.
        let (mut total, mut dearest) = (self.costs.begin + self.assembly, self.assembly);
        let mut dearest_later = dearest;
        for item in 0..self.count() {
            let cost = self.cost(item);
            (total, dearest) = (total + cost, dearest.max(cost));
            if item >= self.blocks {
                dearest_later = dearest_later.max(cost);
            }
        }
        let any = self.least(dearest.max(total / ticks), |limit| {
            self.cut(ticks, Limits::of_all(limit), |_, _| ())
        });
        // A search seldom looks at all of its blocks: then these are the dearest.
        let later = self.least(dearest_later, |later| {
            self.cut(ticks, Limits { any, later }, |_, _| ())
        });
        Limits { any, later }
    }

    /// The least limit from `from` on that fits, within [`STEP`].
    fn least(&self, from: usize, fits: impl Fn(usize) -> bool) -> usize {
        let mut limit = from / STEP * STEP;
        while !fits(limit) {
            limit += STEP;
        }
        limit
    }

    /// Gives each item in turn to the tick under way, or to the next one where that would cost
    /// more than its limit; the first one looks at blocks only. Returns whether no tick costs more.
    fn cut(&self, ticks: usize, limits: Limits, mut give: impl FnMut(usize, usize)) -> bool {
        let (mut tick, mut spent) = (0, self.costs.begin);
        let mut fits = true;
        for item in 0..self.count() {
            let cost = self.cost(item);
            let limit = if item < self.blocks {
                limits.any
            } else {
                limits.later
            };
            let only_blocks = tick == 0 && item >= self.blocks;
            if tick + 1 < ticks && (spent + cost > limit || only_blocks) {
                (tick, spent) = (tick + 1, 0);
                if tick + 1 == ticks {
                    spent = self.assembly;
                }
            }
            spent += cost;
            fits &= spent <= limit;
            give(item, tick);
        }
        fits & (self.assembly <= limits.later)
    }
}

/// What a tick may cost.
#[derive(Debug, Clone, Copy)]
struct Limits {
    /// Any of them.
    any: usize,
    /// One that mixes, multiplies or assembles.
    later: usize,
}

impl Limits {
    const fn of_all(limit: usize) -> Self {
        Self {
            any: limit,
            later: limit,
        }
    }
}

/// The cycle of a texture with `blocks` blocks of triangles to look at: as short a way from query
/// to effect as leaves no share dearer on a Cortex-M4F than it may be. The same on every processor.
pub(crate) fn cycle(blocks: usize, shape: &Shape) -> Cycle {
    let fours = [shape.ar_order(), shape.ma_order()].map(|order| order.div_ceil(4));
    let parts = shape.parts_one_by_one();
    let items = Items::new(ONE_BY_ONE, blocks, fours[0] + fours[1], shape, parts);
    let fits = |cycle: &Cycle| {
        let ticks = cycle.working().into();
        items.cut(ticks, Limits::of_all(DEAREST), |_, _| ())
    };
    Cycle::ALL.into_iter().find(fits).unwrap_or(Cycle::SLOWEST)
}

/// The shares of `blocks` blocks of triangles, a mixture of rows of `fours` fours and the
/// conversion of a shape, in `ticks` ticks whose dearest one costs as little as can be.
pub(crate) fn shares<A: Arithmetic>(
    blocks: usize,
    fours: usize,
    shape: &Shape,
    ticks: usize,
) -> Shares {
    let costs = if A::IN_REGISTERS {
        IN_REGISTERS
    } else {
        ONE_BY_ONE
    };
    let items = Items::new(costs, blocks, fours, shape, shape.parts::<A>());
    let limits = items.limits(ticks);

    let mut shares = Shares::NONE.0;
    items.cut(ticks, limits, |item, tick| {
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
                costs: ONE_BY_ONE,
                blocks,
                mix,
                parts,
                parts_of_two: 2,
                assembly: 130,
            };
            let limits = items.limits(ticks);
            let dearest = least(&items, ticks, 0, 0);
            assert!(limits.any < dearest + STEP && limits.later <= limits.any);
            let (mut next, mut last) = (0, 0);
            let mut spent = [0; 6];
            spent[0] = items.costs.begin;
            spent[ticks - 1] += items.assembly;
            let fits = items.cut(ticks, limits, |item, tick| {
                assert!(item == next && tick >= last && tick < ticks);
                (next, last) = (next + 1, tick);
                spent[tick] += items.cost(item);
                let is_block = item < blocks;
                assert!(spent[tick] <= if is_block { limits.any } else { limits.later });
            });
            assert!(fits);
            assert_eq!(next, items.count());
        }
    }
}
