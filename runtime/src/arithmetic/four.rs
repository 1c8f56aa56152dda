//! Four numbers side by side.

use super::{Arithmetic, Number, Point, Scalar as _, Zero as _, units::Unit};
use core::ops::{Add, Sub};

/// Four numbers with one binary point; as a vector, three components and a number.
#[derive(Debug)]
pub(crate) struct Four<A: Arithmetic, F: Point>(pub(crate) A::Four<F>);

/// A vector as a state keeps it.
#[derive(Debug)]
pub(crate) struct Three<A: Arithmetic, F: Point>(A::Three<F>);

impl<A: Arithmetic, F: Point> Clone for Three<A, F> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Arithmetic, F: Point> Copy for Three<A, F> {}

impl<A: Arithmetic, F: Point> PartialEq for Three<A, F> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<A: Arithmetic, F: Point> Three<A, F> {
    /// Nothing.
    pub(crate) const ZERO: Self = Self(A::Three::ZERO);

    /// The first three.
    #[inline(always)]
    pub(crate) fn of(four: Four<A, F>) -> Self {
        Self(A::three(four.0))
    }

    /// With a fourth that means nothing.
    #[inline(always)]
    pub(crate) fn four(self) -> Four<A, F> {
        Four(A::four_of_three(self.0))
    }
}

impl<A: Arithmetic, F: Point> Clone for Four<A, F> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Arithmetic, F: Point> Copy for Four<A, F> {}

impl<A: Arithmetic, F: Point> PartialEq for Four<A, F> {
    #[inline(always)]
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

impl<A: Arithmetic, F: Point> Add for Four<A, F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(A::four_plus(self.0, other.0))
    }
}

impl<A: Arithmetic, F: Point> Sub for Four<A, F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(A::four_minus(self.0, other.0))
    }
}

impl<A: Arithmetic, F: Point> Four<A, F> {
    /// Nothing.
    pub(crate) const ZERO: Self = Self(A::Four::ZERO);

    #[inline(always)]
    pub(crate) fn load(numbers: &[A::Scalar<F>; 4]) -> Self {
        Self(A::four(numbers))
    }

    /// The nearest ones.
    #[inline(always)]
    pub(crate) fn of(values: [f32; 4]) -> Self {
        Self::load(&values.map(A::Scalar::of))
    }

    /// Whole numbers.
    #[inline(always)]
    pub(crate) fn whole(numbers: [i32; 4]) -> Self {
        Self::load(&numbers.map(A::whole))
    }

    #[inline(always)]
    pub(crate) fn splat(number: Number<A, F>) -> Self {
        Self::load(&[number.0; 4])
    }

    #[inline(always)]
    pub(crate) fn to_array(self) -> [A::Scalar<F>; 4] {
        A::numbers(self.0)
    }

    /// Three components and a zero.
    #[inline(always)]
    pub(crate) fn vec3([x, y, z]: [A::Scalar<F>; 3]) -> Self {
        Self::load(&[x, y, z, A::Scalar::ZERO])
    }

    /// The first three.
    #[inline(always)]
    pub(crate) fn xyz(self) -> [A::Scalar<F>; 3] {
        let [x, y, z, _] = self.to_array();
        [x, y, z]
    }

    /// The first three and a number.
    #[inline(always)]
    pub(crate) fn with_fourth(self, w: Number<A, F>) -> Self {
        let [x, y, z, _] = self.to_array();
        Self::load(&[x, y, z, w.0])
    }

    /// The first three and a number that means nothing.
    #[inline(always)]
    pub(crate) fn first_three(self) -> Self {
        Self(A::first_three(self.0))
    }

    /// One of the four.
    #[inline(always)]
    pub(crate) fn lane(self, lane: usize) -> Number<A, F> {
        Number(self.to_array()[lane % 4])
    }

    /// The fourth.
    #[inline(always)]
    pub(crate) fn fourth(self) -> Number<A, F> {
        self.lane(3)
    }

    /// All four: (1st + 2nd) + (3rd + 4th).
    #[inline(always)]
    pub(crate) fn sum(self) -> Number<A, F> {
        let [a, b, c, d] = self.to_array();
        Number((a + b) + (c + d))
    }

    /// The smaller of each two; nothing is NaN.
    #[inline(always)]
    pub(crate) fn min(self, other: Self) -> Self {
        Self(A::four_min(self.0, other.0))
    }

    /// The second and the fourth with the other sign.
    #[inline(always)]
    pub(crate) fn alternating(self) -> Self {
        Self(A::alternating(self.0))
    }

    /// The products of each two.
    #[inline(always)]
    pub(crate) fn times<G: Point, H: Point>(self, other: Four<A, G>) -> Four<A, H> {
        Four(A::four_times(self.0, other.0))
    }

    /// Σ xᵢ·cᵢ, first to last, each at most `limit` in size if numbers have a range.
    #[inline(always)]
    pub(crate) fn sum_within<const N: usize, G: Point, H: Point>(
        terms: [(Four<A, G>, Four<A, H>); N],
        limit: f32,
    ) -> Self {
        Self(A::four_sum_within(terms.map(|(x, c)| (x.0, c.0)), limit))
    }

    /// Multiples.
    #[inline(always)]
    pub(crate) fn scaled<G: Point, H: Point>(self, by: Number<A, G>) -> Four<A, H> {
        Four(A::four_scaled(self.0, by.0))
    }

    /// The products of each two, each at most that of `limits` in size.
    #[inline(always)]
    pub(crate) fn times_within<G: Point, H: Point>(
        self,
        other: Four<A, G>,
        limits: Four<A, H>,
    ) -> Four<A, H> {
        Four(A::four_times_within(self.0, other.0, limits.0))
    }

    /// Inner product of the first three.
    #[inline(always)]
    pub(crate) fn dot3<G: Point, H: Point>(self, other: Four<A, G>) -> Number<A, H> {
        Number(A::dot3(self.0, other.0))
    }

    /// What is left of the first three in the plane with unit normal `normal`.
    #[inline(always)]
    pub(crate) fn tangential(self, normal: Four<A, Unit>) -> Self {
        Self(A::tangential(self.0, normal.0))
    }

    /// Cross product of the first three with a vector of length 1.
    #[inline(always)]
    pub(crate) fn cross(self, other: Four<A, Unit>) -> Self {
        let (a, b) = (self.xyz().map(Number), other.xyz().map(Number));
        let minor = |i: usize, j: usize| {
            let x: Number<A, F> = Number::<A, F>::times(a[i], b[j]);
            (x - Number::<A, F>::times(a[j], b[i])).0
        };
        Self::vec3([minor(1, 2), minor(2, 0), minor(0, 1)])
    }

    /// Whether none of the four is beyond ±`limit`, or no number.
    #[inline(always)]
    pub(crate) fn is_within(self, limit: f32) -> bool {
        A::is_within(self.0, limit)
    }

    /// The square of the length of the first three.
    #[inline(always)]
    pub(crate) fn square(self) -> A::Square {
        A::square(self.0)
    }

    /// At length 1, if `polar` belongs to it; else something finite.
    #[inline(always)]
    pub(crate) fn direction(self, polar: A::Polar) -> Four<A, Unit> {
        Four(A::direction(self.0, polar))
    }
}
