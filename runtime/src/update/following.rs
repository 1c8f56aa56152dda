//! How far the line spectrum goes towards a new mixture in a cycle.

use super::{cycle::Cycle, plan::Plan};
use crate::{
    arithmetic::Arithmetic,
    math::exp,
    quantity::{Quantity, unit::Fraction},
};

/// The fraction of its way that a one-pole of time constant `constant` goes in a time.
pub(crate) fn fraction_after(time: f32, constant: f32) -> f32 {
    let constants = constant / time;
    if constants > 0.0125 {
        1.0 - exp(-1.0 / constants)
    } else {
        1.0
    }
}

/// The fractions of the way to a mixture that a line spectrum goes in a cycle, by ticks a sample
/// and kind of cycle.
#[derive(Debug, Clone)]
pub(crate) struct Following<A: Arithmetic>([[Quantity<A, Fraction>; Cycle::KINDS]; 32]);

impl<A: Arithmetic> Following<A> {
    /// The fractions for a time constant in ticks.
    pub(crate) fn new(constant_ticks: f32) -> Self {
        Self(core::array::from_fn(|per_sample| {
            let mut fractions = [Quantity::ZERO; Cycle::KINDS];
            for cycle in Cycle::ALL {
                let ticks = usize::from(cycle.samples()) * per_sample.max(1);
                let fraction = fraction_after(ticks as f32, constant_ticks);
                fractions[cycle.kind()] = Quantity::of(fraction);
            }
            fractions
        }))
    }

    /// The fraction for a plan.
    #[inline(always)]
    pub(crate) fn of(&self, plan: &Plan) -> Quantity<A, Fraction> {
        self.0[usize::from(plan.ticks_per_sample % 32)][plan.cycle.kind()]
    }
}
