//! Scalar with a unit.

use super::{
    product::{Over, Times},
    unit::{ConvertTo, Unit},
};
use crate::{
    arithmetic::{Arithmetic, Cut, Scalar as _, Zero as _},
    lanes::GRID,
};
use core::{
    cmp::Ordering,
    ops::{Add, Mul, Neg, Sub},
};

/// The bare number of a quantity: an `f32`, or a `FixedI32` with the unit's binary point.
pub type Raw<A, U> = <A as Arithmetic>::Scalar<<U as Unit>::Point>;

/// A number of arithmetic `A` with unit `U`.
#[derive(Debug, Default)]
pub struct Quantity<A: Arithmetic, U: Unit>(pub Raw<A, U>);

impl<A: Arithmetic, U: Unit> Clone for Quantity<A, U> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Arithmetic, U: Unit> Copy for Quantity<A, U> {}

impl<A: Arithmetic, U: Unit> PartialEq for Quantity<A, U> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<A: Arithmetic, U: Unit> PartialOrd for Quantity<A, U> {
    #[inline(always)]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }

    #[inline(always)]
    fn lt(&self, other: &Self) -> bool {
        self.0 < other.0
    }

    #[inline(always)]
    fn gt(&self, other: &Self) -> bool {
        self.0 > other.0
    }

    #[inline(always)]
    fn le(&self, other: &Self) -> bool {
        self.0 <= other.0
    }

    #[inline(always)]
    fn ge(&self, other: &Self) -> bool {
        self.0 >= other.0
    }
}

impl<A: Arithmetic, U: Unit> Add for Quantity<A, U> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<A: Arithmetic, U: Unit> Sub for Quantity<A, U> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<A: Arithmetic, U: Unit> Neg for Quantity<A, U> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<A: Arithmetic, U: Times<V>, V: Unit> Mul<Quantity<A, V>> for Quantity<A, U> {
    type Output = Quantity<A, U::Product>;
    #[inline(always)]
    fn mul(self, other: Quantity<A, V>) -> Self::Output {
        Quantity(
            A::product::<U::Point, V::Point, <U::Product as Unit>::Point>(self.0, other.0, U::CUT),
        )
    }
}

impl<A: Arithmetic, U: Unit> Quantity<A, U> {
    /// Zero.
    pub const ZERO: Self = Self(A::Scalar::ZERO);
    /// Larger than every quantity in use.
    pub const FARTHEST: Self = Self(A::Scalar::FARTHEST);

    /// The nearest quantity to `value`; the end of the range beyond it, 0 for NaN in fixed point.
    #[inline(always)]
    #[must_use]
    pub fn of(value: f32) -> Self {
        Self(A::Scalar::of(value))
    }

    /// A whole number.
    #[inline(always)]
    #[must_use]
    pub fn whole(n: i32) -> Self {
        Self(A::whole(n))
    }

    /// Its value.
    #[inline(always)]
    #[must_use]
    pub fn value(self) -> f32 {
        self.0.value()
    }

    /// The same quantity in another unit of its dimension.
    #[inline(always)]
    #[must_use]
    pub fn to<V: Unit>(self) -> Quantity<A, V>
    where
        U: ConvertTo<V>,
    {
        Quantity(A::convert(self.0))
    }

    /// The quotient by a divisor that is not negative; the end of the range beyond it, 0 for 0/0.
    #[inline(always)]
    #[must_use]
    pub fn over<V: Unit>(self, divisor: Quantity<A, V>) -> Quantity<A, U::Quotient>
    where
        U: Over<V>,
    {
        Quantity(A::quotient::<
            U::Point,
            V::Point,
            <U::Quotient as Unit>::Point,
        >(self.0, divisor.0))
    }

    /// Σ xᵢ·cᵢ, first to last, rounded once in fixed point and cut where the caller says.
    #[inline(always)]
    #[must_use]
    pub(crate) fn sum_of_products<const N: usize, V: Unit, W: Unit>(
        terms: [(Quantity<A, V>, Quantity<A, W>); N],
        cut: Cut,
    ) -> Self {
        let terms = terms.map(|(x, c)| (x.0, c.0));
        Self(A::sum_of_products::<N, V::Point, W::Point, U::Point>(
            terms, cut,
        ))
    }

    /// The sum, or the end of the range beyond it.
    #[inline(always)]
    #[must_use]
    pub(crate) fn saturating_add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }

    /// [`Quantity::settled_within`] the grid of the smallest numbers in use.
    #[inline(always)]
    #[must_use]
    pub(crate) fn settled(self) -> Self {
        self.settled_within(GRID)
    }

    /// See [`Arithmetic::settled`].
    #[inline(always)]
    #[must_use]
    pub(crate) fn settled_within(self, grid: f32) -> Self {
        Self(A::settled(self.0, grid))
    }

    /// The number where it is more than `least`, else zero.
    #[inline(always)]
    #[must_use]
    pub(crate) fn above(self, least: Self) -> Self {
        if self.0 > least.0 { self } else { Self::ZERO }
    }

    /// The smaller one.
    #[inline(always)]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        if self.0 < other.0 { self } else { other }
    }

    /// The larger one.
    #[inline(always)]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        if self.0 > other.0 { self } else { other }
    }

    /// The number cut to `0..=limit`; 0 for NaN.
    #[inline(always)]
    #[must_use]
    pub fn clamp_from_zero(self, limit: Self) -> Self {
        self.max(Self::ZERO).min(limit)
    }
}
