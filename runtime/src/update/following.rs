//! Smoothing of the line spectrum: its step per cycle towards a new mixture.

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

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::{Fixed, Float};

    #[test]
    fn a_one_pole_goes_its_exponential_fraction_of_the_way() {
        for (time, constant) in [
            (1.0, 5.0),
            (6.0, 5.0),
            (8.0, 40.0),
            (160.0, 100.0),
            (8.0, 1.0),
        ] {
            let exact = 1.0 - (-f64::from(time) / f64::from(constant)).exp();
            let found = f64::from(fraction_after(time, constant));
            assert!(
                (found - exact).abs() < 1e-5,
                "{time} {constant}: {found} {exact}"
            );
        }
        // Nothing is left to follow in less than an eightieth of the time.
        for constant in [0.0, 0.0125, 1e-9] {
            assert_eq!(fraction_after(1.0, constant), 1.0);
        }
        assert!(fraction_after(1.0, 0.1) < 1.0);
    }

    #[test]
    fn a_cycle_of_more_samples_or_slower_models_goes_further() {
        fn check<A: Arithmetic>() {
            let following = Following::<A>::new(50.0);
            for per_sample in 0..32_usize {
                for cycle in Cycle::ALL {
                    let ticks = f64::from(cycle.samples()) * per_sample.max(1) as f64;
                    let found = following.0[per_sample][cycle.kind()].value();
                    let exact = 1.0 - (-ticks / 50.0).exp();
                    assert!(
                        (f64::from(found) - exact).abs() < 1e-5,
                        "{per_sample} {cycle:?}"
                    );
                }
            }
        }
        check::<Float>();
        check::<Fixed>();
    }
}
