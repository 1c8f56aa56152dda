//! Vectors along the world's axes.

use super::{
    four::Four,
    product::Times,
    scalar::{Quantity, Raw},
    unit::{Fraction, Unit},
};
use crate::{
    arithmetic::{Arithmetic, Scalar as _, Zero as _},
    lanes::GRID,
};
use core::ops::{Add, Mul, Sub};

/// Three components of unit `U` along the world's axes; a fourth number beside them, where
/// registers hold four, has no meaning.
#[derive(Debug)]
pub struct Vector<A: Arithmetic, U: Unit>(pub(crate) A::Four<U::Point>);

/// A vector as a state keeps it: without the fourth number where memory is scarce.
#[derive(Debug)]
pub struct StoredVector<A: Arithmetic, U: Unit>(A::Three<U::Point>);

impl<A: Arithmetic, U: Unit> Clone for StoredVector<A, U> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Arithmetic, U: Unit> Copy for StoredVector<A, U> {}

impl<A: Arithmetic, U: Unit> PartialEq for StoredVector<A, U> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<A: Arithmetic, U: Unit> StoredVector<A, U> {
    /// No length.
    pub const ZERO: Self = Self(A::Three::ZERO);

    /// The vector.
    #[inline(always)]
    #[must_use]
    pub fn get(self) -> Vector<A, U> {
        Vector(A::four_of_three(self.0))
    }
}

impl<A: Arithmetic, U: Unit> From<Vector<A, U>> for StoredVector<A, U> {
    #[inline(always)]
    fn from(vector: Vector<A, U>) -> Self {
        Self(A::three(vector.0))
    }
}

impl<A: Arithmetic, U: Unit> Clone for Vector<A, U> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Arithmetic, U: Unit> Copy for Vector<A, U> {}

impl<A: Arithmetic, U: Unit> PartialEq for Vector<A, U> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.to_array() == other.to_array()
    }
}

impl<A: Arithmetic, U: Unit> Add for Vector<A, U> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<A: Arithmetic, U: Unit> Sub for Vector<A, U> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

/// A vector times a number.
impl<A: Arithmetic, U: Times<V>, V: Unit> Mul<Quantity<A, V>> for Vector<A, U> {
    type Output = Vector<A, U::Product>;
    #[inline(always)]
    fn mul(self, factor: Quantity<A, V>) -> Self::Output {
        let factor = A::four(&[factor.0; 4]);
        Vector(A::four_product::<
            U::Point,
            V::Point,
            <U::Product as Unit>::Point,
        >(self.0, factor, U::CUT))
    }
}

impl<A: Arithmetic, U: Unit> Vector<A, U> {
    /// No length.
    pub const ZERO: Self = Self(A::Four::ZERO);

    /// Three bare numbers.
    #[inline(always)]
    #[must_use]
    pub fn load([x, y, z]: [Raw<A, U>; 3]) -> Self {
        Self(A::four(&[x, y, z, A::Scalar::ZERO]))
    }

    /// The nearest vector to three values.
    #[inline(always)]
    #[must_use]
    pub fn of(values: [f32; 3]) -> Self {
        Self::load(values.map(A::Scalar::of))
    }

    /// Whole numbers.
    #[inline(always)]
    #[must_use]
    pub fn whole(numbers: [i32; 3]) -> Self {
        Self::load(numbers.map(A::whole))
    }

    /// The bare numbers.
    #[inline(always)]
    #[must_use]
    pub fn to_array(self) -> [Raw<A, U>; 3] {
        let [x, y, z, _] = A::numbers(self.0);
        [x, y, z]
    }

    /// The components' values.
    #[inline]
    #[must_use]
    pub fn values(self) -> [f32; 3] {
        self.to_array().map(A::Scalar::value)
    }

    /// The components.
    #[inline(always)]
    #[must_use]
    pub fn components(self) -> [Quantity<A, U>; 3] {
        self.to_array().map(Quantity)
    }

    /// The components and a fourth number beside them.
    #[inline(always)]
    #[must_use]
    pub fn with_fourth(self, fourth: Quantity<A, U>) -> Four<A, U> {
        let [x, y, z] = self.to_array();
        Four::load(&[x, y, z, fourth.0])
    }

    /// Inner product.
    #[inline(always)]
    #[must_use]
    pub fn dot<V: Unit>(self, other: Vector<A, V>) -> Quantity<A, U::Product>
    where
        U: Times<V>,
    {
        Quantity(A::dot3::<U::Point, V::Point, <U::Product as Unit>::Point>(
            self.0, other.0,
        ))
    }

    /// [`Vector::settled_within`] the grid of the smallest numbers in use.
    #[inline(always)]
    #[must_use]
    pub(crate) fn settled(self) -> Self {
        self.settled_within(GRID)
    }

    /// See [`Arithmetic::four_settled`].
    #[inline(always)]
    #[must_use]
    pub(crate) fn settled_within(self, grid: f32) -> Self {
        Self(A::four_settled(self.0, grid))
    }

    /// Returns true if every component is within ±`limit`; false for NaN.
    #[inline(always)]
    #[must_use]
    pub fn is_within(self, limit: Quantity<A, U>) -> bool {
        A::is_within(self.0, limit.0)
    }
}

impl<A: Arithmetic, U: Times<Fraction, Product = U>> Vector<A, U> {
    /// The part in the plane with unit normal n̂: x − n̂ (x·n̂).
    #[inline(always)]
    #[must_use]
    pub fn tangential(self, normal: Vector<A, Fraction>) -> Self {
        self - normal * self.dot(normal)
    }
}

impl<A: Arithmetic> Vector<A, Fraction> {
    /// Cross product of two directions.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        let (a, b) = (self.components(), other.components());
        let minor = |i: usize, j: usize| (a[i] * b[j] - a[j] * b[i]).0;
        Self::load([minor(1, 2), minor(2, 0), minor(0, 1)])
    }
}

impl<A: Arithmetic, U: Unit> Four<A, U> {
    /// The first three as a vector.
    #[inline(always)]
    #[must_use]
    pub fn vector(self) -> Vector<A, U> {
        Vector(A::first_three(self.0))
    }
}
