//! Which share of location and conversion each tick of a cycle does.
//!
//! Location looks at triangles in blocks of four, the best makes a mixture, and conversion
//! multiplies two pairs of zeros at a time: a fixed list of items, cut into [`CYCLE_TICKS`]
//! shares of about equal cost when a texture is loaded. What comes out does not depend on where
//! the cuts are.

use crate::{arithmetic::Arithmetic, lsf::Shape};
use core::ops::Range;

/// Ticks from one query to the next; a query takes effect in the last of them.
pub const CYCLE_TICKS: usize = 6;

/// What each item costs, in executed instructions; only ratios matter.
struct Costs {
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
            block: 33,
            mix: 140,
            mix_four: 12,
            two: 28,
            coefficient: 10,
            assembly_four: 37,
        }
    } else {
        Costs {
            block: 65,
            mix: 150,
            mix_four: 50,
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

/// The shares of `blocks` blocks of triangles and the conversion of a shape, in `count` ticks.
pub(crate) fn shares<A: Arithmetic>(blocks: usize, shape: &Shape, count: usize) -> Shares {
    let costs = costs::<A>();
    let fours = |order: usize| order.div_ceil(4);
    let mix = costs.mix + costs.mix_four * (fours(shape.ar_order()) + fours(shape.ma_order()));
    let part_cost = |part: usize| {
        let two = part / shape.parts::<A>();
        costs.two + costs.coefficient * 2 * (two + 1)
    };
    let halves = fours(shape.ar_order().div_ceil(2)) + fours(shape.ma_order().div_ceil(2));
    let parts = shape.twos() * shape.parts::<A>();
    let twos: usize = (0..parts).map(part_cost).sum();
    let total = costs.block * blocks + mix + twos + costs.assembly_four * halves;

    let mut shares = Shares::NONE.0;
    let mut spent = 0;
    // An item belongs to the tick in which its middle lies; in the first one, only blocks.
    let mut tick_of = |cost: usize, first: usize| {
        let tick = count * (2 * spent + cost) / (2 * total);
        spent += cost;
        tick.clamp(first, count - 1)
    };
    for _ in 0..blocks {
        shares[tick_of(costs.block, 0)].blocks += 1;
    }
    shares[tick_of(mix, 1)].mixes = true;
    for part in 0..parts {
        let range = &mut shares[tick_of(part_cost(part), 1)].twos;
        if range.1 == 0 {
            range.0 = part as u8;
        }
        range.1 = part as u8 + 1;
    }
    Shares(shares)
}
