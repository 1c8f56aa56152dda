//! A number with its binary point.

use super::{Arithmetic, Point, Scalar as _, Zero as _};
use core::{
    cmp::Ordering,
    ops::{Add, Neg, Sub},
};

/// A number of an arithmetic with its binary point.
#[derive(Debug, Default)]
pub struct Number<A: Arithmetic, F: Point>(pub A::Scalar<F>);

impl<A: Arithmetic, F: Point> Clone for Number<A, F> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Arithmetic, F: Point> Copy for Number<A, F> {}

impl<A: Arithmetic, F: Point> PartialEq for Number<A, F> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<A: Arithmetic, F: Point> PartialOrd for Number<A, F> {
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

impl<A: Arithmetic, F: Point> Add for Number<A, F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<A: Arithmetic, F: Point> Sub for Number<A, F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<A: Arithmetic, F: Point> Neg for Number<A, F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<A: Arithmetic, F: Point> Number<A, F> {
    /// Nothing.
    pub const ZERO: Self = Self(A::Scalar::ZERO);
    /// Larger than every number in use.
    pub const FARTHEST: Self = Self(A::Scalar::FARTHEST);

    /// The nearest one to `value`; the end of the range beyond it, 0 for NaN.
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

    /// At another point.
    #[inline(always)]
    #[must_use]
    pub fn to<G: Point>(self) -> Number<A, G> {
        Number(A::to(self.0))
    }

    /// Product.
    #[inline(always)]
    #[must_use]
    pub fn times<G: Point, H: Point>(self, other: Number<A, G>) -> Number<A, H> {
        Number(A::times(self.0, other.0))
    }

    /// Product, at most `limit` in size.
    #[inline(always)]
    #[must_use]
    pub fn times_within<G: Point, H: Point>(self, other: Number<A, G>, limit: f32) -> Number<A, H> {
        Number(A::times_within(self.0, other.0, limit))
    }

    /// Σ xᵢ·cᵢ, first to last, at most `limit` in size if numbers have a range.
    #[inline(always)]
    #[must_use]
    pub(crate) fn sum_within<const N: usize, G: Point, H: Point>(
        terms: [(Number<A, G>, Number<A, H>); N],
        limit: f32,
    ) -> Self {
        Self(A::sum_within(terms.map(|(x, c)| (x.0, c.0)), limit))
    }

    /// Quotient of a divisor that is not negative; the end of the range beyond it, 0 for 0/0.
    #[inline(always)]
    #[must_use]
    pub fn over<G: Point, H: Point>(self, other: Number<A, G>) -> Number<A, H> {
        Number(A::over(self.0, other.0))
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

    /// In `0..=limit`; 0 for NaN.
    #[inline(always)]
    #[must_use]
    pub fn clamp_from_zero(self, limit: Self) -> Self {
        self.max(Self::ZERO).min(limit)
    }
}
