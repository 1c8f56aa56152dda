//! The plan of a texture: how long its cycle is and what each tick of it does.

use super::{
    clock::slices_of_cycle,
    cycle::Cycle,
    slices::{Slice, Slices, cycle, slices},
};
use crate::{
    capacity::Capacity,
    model::{barycentric::WeightSearch, filter::Models},
};

/// Schedule of the work on a texture's models, fixed when it is loaded.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    /// Duration of a cycle.
    pub(crate) cycle: Cycle,
    slices: Slices,
    /// Ticks per sample of the models.
    pub(super) ticks_per_sample: u8,
}

impl Plan {
    /// The plan of a slot that was never loaded.
    pub(crate) const NONE: Self = Self {
        cycle: Cycle::SLOWEST,
        slices: Slices::NONE,
        ticks_per_sample: 1,
    };

    /// The plan for these models, at this many ticks a sample.
    pub(crate) fn new<S: Capacity, A: WeightSearch>(
        models: &Models<S, A>,
        ticks_per_sample: u8,
    ) -> Self {
        let (blocks, orders) = (models.grid.blocks(), &models.orders);
        let cycle = cycle(blocks, orders);
        let count = slices_of_cycle(ticks_per_sample, cycle);
        // Rows are mixed over the whole capacity of the slot.
        let fours = S::AR_ORDER / 4 + if orders.ma() > 0 { S::MA_ORDER / 4 } else { 0 };
        Self {
            cycle,
            slices: slices::<A>(blocks, fours, orders, count),
            ticks_per_sample,
        }
    }

    /// The work of a tick of the cycle.
    #[inline]
    pub(super) fn slice(&self, phase: u8) -> &Slice {
        self.slices.of(phase)
    }
}
