//! Cost model of a cycle's work, and its partition into slices.
//!
//! The work is a fixed list of items: blocks of triangles to examine, the mixture, section pairs to
//! multiply in. Each goes to the current tick or to the next one, so that the maximum cost of a
//! tick is minimal.

use crate::model::orders::Orders;

/// Cost of each item, in executed instructions; only ratios matter to the cuts.
pub(super) struct Costs {
    /// The query, before the first block.
    begin: usize,
    block: usize,
    /// The choice of a triangle, and its mixture.
    mix: usize,
    mix_four: usize,
    /// A section pair, and each of the coefficients that it makes.
    pair: usize,
    coefficient: usize,
    assembly_four: usize,
}

/// Costs on x86-64.
pub(super) const IN_REGISTERS: Costs = Costs {
    begin: 40,
    block: 33,
    mix: 140,
    mix_four: 16,
    pair: 28,
    coefficient: 10,
    assembly_four: 37,
};
/// Costs on a Cortex-M4F, where four lanes are four numbers.
pub(super) const ONE_BY_ONE: Costs = Costs {
    begin: 110,
    block: 145,
    mix: 190,
    mix_four: 38,
    pair: 45,
    coefficient: 14,
    assembly_four: 50,
};
/// No slice costs more on a Cortex-M4F, as far as cuts allow it. A tick of order 20 with an MA part
/// then takes less than 1,600 instructions.
pub(super) const DEAREST: usize = 640;

/// The items of work in order, and their costs.
pub(super) struct Items {
    costs: Costs,
    blocks: usize,
    mix: usize,
    parts: usize,
    parts_of_pair: usize,
    /// The cost of what the last tick does in any case.
    assembly: usize,
}

impl Items {
    pub(super) fn new(
        costs: Costs,
        blocks: usize,
        fours: usize,
        orders: &Orders,
        parts: usize,
    ) -> Self {
        let halves = [orders.ar(), orders.ma()].map(|order| order.div_ceil(2).div_ceil(4));
        Self {
            blocks,
            mix: costs.mix + costs.mix_four * fours,
            parts: orders.section_pairs() * parts,
            parts_of_pair: parts,
            assembly: costs.assembly_four * (halves[0] + halves[1]),
            costs,
        }
    }

    pub(super) const fn count(&self) -> usize {
        self.blocks + 1 + self.parts
    }

    pub(super) const fn cost(&self, item: usize) -> usize {
        if item < self.blocks {
            self.costs.block
        } else if item == self.blocks {
            self.mix
        } else {
            let pair = (item - self.blocks - 1) / self.parts_of_pair;
            self.costs.pair + self.costs.coefficient * 2 * (pair + 1)
        }
    }

    /// The limits of the best cut, within [`STEP`]: for the costliest tick, and for the ticks after
    /// the blocks.
    pub(super) fn limits(&self, ticks: usize) -> Limits {
        // No limit below the mean or below the costliest item will do.
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
        // A search seldom looks at all of its blocks. The ticks after them are then the costliest.
        let later = self.least(dearest_later, |later| {
            self.cut(ticks, Limits { any, later }, |_, _| ())
        });
        Limits { any, later }
    }

    /// The least limit from `from` on that fits, within [`STEP`].
    pub(super) fn least(&self, from: usize, fits: impl Fn(usize) -> bool) -> usize {
        let mut limit = from / STEP * STEP;
        while !fits(limit) {
            limit += STEP;
        }
        limit
    }

    /// Gives each item in turn to the tick under way, or to the next one where that would cost
    /// more than its limit; the first one looks at blocks only. Returns whether no tick costs more.
    pub(super) fn cut(
        &self,
        ticks: usize,
        limits: Limits,
        mut give: impl FnMut(usize, usize),
    ) -> bool {
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

/// Cost limits of a tick.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits {
    /// The limit of any tick.
    any: usize,
    /// The limit of a tick that mixes, multiplies or assembles.
    later: usize,
}

impl Limits {
    pub(super) const fn of_all(limit: usize) -> Self {
        Self {
            any: limit,
            later: limit,
        }
    }
}

/// Distance between the limits that are tried, in instructions.
const STEP: usize = 16;

#[cfg(test)]
mod tests {
    use super::*;

    /// Minimum cost of the costliest tick, from tick `tick` and item `from` on, by exhaustive search.
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
                parts_of_pair: 2,
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

    /// The whole of the work of some textures, added up by hand on a Cortex-M4F.
    #[test]
    fn the_work_costs_what_its_items_cost() {
        for (orders, blocks, fours, parts, mix, pairs, assembly) in [
            // Order 20: five pairs, of 2, 4, … 10 coefficients; 10 coefficients are three fours.
            ((20, 0), 3, 5, 1, 190 + 5 * 38, 5 * 45 + 14 * 30, 3 * 50),
            // Both polynomials: each pair twice; 9 coefficients are three fours, too.
            (
                (20, 18),
                6,
                10,
                2,
                190 + 10 * 38,
                2 * (5 * 45 + 14 * 30),
                6 * 50,
            ),
            ((4, 0), 1, 1, 1, 190 + 38, 45 + 14 * 2, 50),
            (
                (5, 9),
                2,
                4,
                2,
                190 + 4 * 38,
                2 * (3 * 45 + 14 * 12),
                3 * 50,
            ),
        ] {
            let orders = Orders::new(orders.0, orders.1);
            let items = Items::new(ONE_BY_ONE, blocks, fours, &orders, parts);
            let all = orders.section_pairs() * parts;
            assert_eq!(items.count(), blocks + 1 + all);
            let cost =
                |from: usize, to: usize| (from..to).map(|item| items.cost(item)).sum::<usize>();
            assert_eq!(cost(0, blocks), 145 * blocks);
            assert_eq!(cost(blocks, blocks + 1), mix);
            assert_eq!(cost(blocks + 1, items.count()), pairs);
            assert_eq!(items.assembly, assembly);
        }
    }
}
