//! Which share of location and conversion each tick of a cycle does.
//!
//! Location looks at triangles in blocks of four, chooses, and conversion multiplies in units:
//! a fixed list of items, cut into [`CYCLE_TICKS`] shares of equal cost when a texture is
//! loaded. What comes out does not depend on where the cuts are.

use crate::lsf::Shape;
use core::ops::Range;

/// Ticks from one query to the next; a query takes effect in the last of them.
pub const CYCLE_TICKS: usize = 6;

/// Costs in executed x86-64 instructions; only their ratios matter.
const BLOCK: usize = 32;
const CHOICE: usize = 80;
const MIX: usize = 45;
const MIX_BLOCK: usize = 13;
const UNIT: usize = 31;
const STEP: usize = 11;
const PARTIAL_STEP: usize = 14;
const LEVEL: usize = 30;
const ASSEMBLY_FOUR: usize = 38;

/// The share of one tick: blocks first, then the choice, then the mixture, then units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Share {
    blocks: (u8, u8),
    pub(crate) chooses: bool,
    pub(crate) mixes_ar: bool,
    pub(crate) mixes_ma: bool,
    units: (u8, u8),
}

impl Share {
    pub(crate) const NONE: Self = Self {
        blocks: (0, 0),
        chooses: false,
        mixes_ar: false,
        mixes_ma: false,
        units: (0, 0),
    };

    /// Blocks of triangles to look at.
    pub(crate) fn blocks(&self) -> Range<usize> {
        self.blocks.0.into()..self.blocks.1.into()
    }

    /// Units of the conversion.
    pub(crate) fn units(&self) -> Range<usize> {
        self.units.0.into()..self.units.1.into()
    }
}

/// The shares of `blocks` blocks of triangles and the conversion of a shape.
pub(crate) fn shares(blocks: usize, shape: &Shape) -> [Share; CYCLE_TICKS] {
    let mix = |order: usize| {
        if order == 0 {
            0
        } else {
            MIX + MIX_BLOCK * order.div_ceil(4)
        }
    };
    let unit_cost = |unit: usize| {
        let two = unit / 2;
        let step = if shape.is_full(two) {
            STEP
        } else {
            PARTIAL_STEP
        };
        UNIT + step * (two + 1)
    };
    let assembly = |order: usize| ASSEMBLY_FOUR * (order / 2).div_ceil(4);
    let last = LEVEL + assembly(shape.ar_order) + assembly(shape.ma_order);
    let units: usize = (0..shape.units()).map(unit_cost).sum();
    let total = BLOCK * blocks + CHOICE + mix(shape.ar_order) + mix(shape.ma_order) + units + last;

    let mut shares = [Share::NONE; CYCLE_TICKS];
    let mut spent = 0;
    // An item belongs to the tick in which its middle lies.
    let mut tick_of = |cost: usize| {
        let tick = CYCLE_TICKS * (2 * spent + cost) / (2 * total);
        spent += cost;
        tick
    };
    let extend = |range: &mut (u8, u8), item: usize| {
        if range.1 == 0 {
            range.0 = item as u8;
        }
        range.1 = item as u8 + 1;
    };
    for block in 0..blocks {
        if let Some(share) = shares.get_mut(tick_of(BLOCK)) {
            extend(&mut share.blocks, block);
        }
    }
    if let Some(share) = shares.get_mut(tick_of(CHOICE)) {
        share.chooses = true;
    }
    if let Some(share) = shares.get_mut(tick_of(mix(shape.ar_order))) {
        share.mixes_ar = true;
    }
    if shape.ma_order > 0
        && let Some(share) = shares.get_mut(tick_of(mix(shape.ma_order)))
    {
        share.mixes_ma = true;
    }
    for unit in 0..shape.units() {
        if let Some(share) = shares.get_mut(tick_of(unit_cost(unit))) {
            extend(&mut share.units, unit);
        }
    }
    shares
}
