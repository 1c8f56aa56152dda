//! A grid at every order that is compared.

use asperity::{
    model::{ModelGrid, Numerator},
    reduce::{self, Reference, order::Fits},
};
use asperity_kernels::design::Order;

/// A grid, prepared for every order.
pub(super) struct Grids<'a> {
    full: &'a ModelGrid,
    with_zero: Option<Fits<'a>>,
    all_pole: Option<Fits<'a>>,
    auto: ModelGrid,
}

impl<'a> Grids<'a> {
    pub(super) fn of(full: &'a ModelGrid) -> Self {
        Self {
            full,
            with_zero: Fits::new(full, Numerator::Nyquist),
            all_pole: Fits::new(full, Numerator::None),
            auto: Reference::new(full).map_or_else(
                || full.clone(),
                |reference| reduce::least_order(full, &reference),
            ),
        }
    }

    /// The grid at an order; `None` where it has no such form. An order above the grid's own
    /// gives the grid's own.
    pub(super) fn at(&self, order: Order) -> Option<ModelGrid> {
        match order {
            Order::Full => Some(self.full.clone()),
            Order::Auto => Some(self.auto.clone()),
            Order::WithZero(order) => self.with_zero.as_ref()?.at(order),
            Order::AllPole(order) => self.all_pole.as_ref()?.at(order),
        }
    }
}
