//! Four numbers of one unit side by side.

use super::{
    product::Times,
    scalar::{Quantity, Raw},
    unit::Unit,
};
use crate::arithmetic::{Arithmetic, Cut, Scalar as _, Zero as _};
use core::ops::{Add, Mul, Sub};

/// Four numbers of unit `U`: a register where the processor has such.
#[derive(Debug)]
pub struct Four<A: Arithmetic, U: Unit>(pub(crate) A::Four<U::Point>);

impl<A: Arithmetic, U: Unit> Clone for Four<A, U> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Arithmetic, U: Unit> Copy for Four<A, U> {}

impl<A: Arithmetic, U: Unit> PartialEq for Four<A, U> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<A: Arithmetic, U: Unit> Add for Four<A, U> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<A: Arithmetic, U: Unit> Sub for Four<A, U> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

/// The products of each two.
impl<A: Arithmetic, U: Times<V>, V: Unit> Mul<Four<A, V>> for Four<A, U> {
    type Output = Four<A, U::Product>;
    #[inline(always)]
    fn mul(self, other: Four<A, V>) -> Self::Output {
        Four(A::four_product::<
            U::Point,
            V::Point,
            <U::Product as Unit>::Point,
        >(self.0, other.0, U::CUT))
    }
}

impl<A: Arithmetic, U: Unit> Four<A, U> {
    /// Zeros.
    pub const ZERO: Self = Self(A::Four::ZERO);

    /// Four bare numbers.
    #[inline(always)]
    #[must_use]
    pub fn load(numbers: &[Raw<A, U>; 4]) -> Self {
        Self(A::four(numbers))
    }

    /// The nearest quantities to four values.
    #[inline(always)]
    #[must_use]
    pub fn of(values: [f32; 4]) -> Self {
        Self::load(&values.map(A::Scalar::of))
    }

    /// Whole numbers.
    #[inline(always)]
    #[must_use]
    pub fn whole(numbers: [i32; 4]) -> Self {
        Self::load(&numbers.map(A::whole))
    }

    /// Broadcasts a quantity to all four lanes.
    #[inline(always)]
    #[must_use]
    pub fn splat(number: Quantity<A, U>) -> Self {
        Self::load(&[number.0; 4])
    }

    /// The bare numbers.
    #[inline(always)]
    #[must_use]
    pub fn to_array(self) -> [Raw<A, U>; 4] {
        A::numbers(self.0)
    }

    /// Returns a single lane.
    #[inline(always)]
    #[must_use]
    pub fn lane(self, lane: usize) -> Quantity<A, U> {
        Quantity(self.to_array()[lane % 4])
    }

    /// The sum of all four: (1st + 2nd) + (3rd + 4th).
    #[inline(always)]
    #[must_use]
    pub fn sum(self) -> Quantity<A, U> {
        let [a, b, c, d] = self.to_array();
        Quantity((a + b) + (c + d))
    }

    /// See [`Arithmetic::four_settled`].
    #[inline(always)]
    #[must_use]
    pub(crate) fn settled_within(self, grid: f32) -> Self {
        Self(A::four_settled(self.0, grid))
    }

    /// The smaller of each two; none is NaN.
    #[inline(always)]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self(A::four_min(self.0, other.0))
    }

    /// Σ xᵢ·cᵢ in each lane, first to last, rounded once in fixed point and cut where the caller
    /// says.
    #[inline(always)]
    #[must_use]
    pub(crate) fn sum_of_products<const N: usize, V: Unit, W: Unit>(
        terms: [(Four<A, V>, Four<A, W>); N],
        cut: Cut,
    ) -> Self {
        let terms = terms.map(|(x, c)| (x.0, c.0));
        Self(A::four_sum_of_products::<N, V::Point, W::Point, U::Point>(
            terms, cut,
        ))
    }

    /// Returns true if all four lanes are within ±`limit`; false for NaN.
    #[inline(always)]
    #[must_use]
    pub fn is_within(self, limit: Quantity<A, U>) -> bool {
        A::is_within(self.0, limit.0)
    }
}
