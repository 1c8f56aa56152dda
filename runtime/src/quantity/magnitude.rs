//! Length and direction of a vector.
//!
//! A [`Magnitude`] is a length and its inverse, made together: a direction is the vector times the
//! inverse. Three ways to make one differ in what they give where there is no length.

mod fixed;
mod float;

use super::{
    product::Times,
    scalar::{Quantity, Raw},
    unit::{DirectionFactor, Fraction, Unit},
    vector::Vector,
};
use crate::arithmetic::{Arithmetic, Cut, Point};
use core::{fmt::Debug, marker::PhantomData, ops::Mul};

/// Lengths in an arithmetic.
pub trait Magnitudes: Arithmetic {
    /// The square of a length.
    type Square: Copy + Debug + PartialOrd;
    /// A length and its inverse.
    type Magnitude: Copy + Debug;
    /// An inner product that is still to be divided by a length.
    type Projection<F: Point>: Copy;

    /// The square of the length of the first three.
    fn square<F: Point>(v: Self::Four<F>) -> Self::Square;

    /// √a for a ≥ 0.
    fn root<F: Point>(a: Self::Scalar<F>) -> Self::Scalar<F>;

    /// Returns true if the length is above a nanometre or, in fixed point, above zero.
    fn is_some(square: Self::Square) -> bool;

    /// The magnitude of a square. Its inverse is finite even where there is no length.
    fn magnitude(square: Self::Square) -> Self::Magnitude;

    /// The magnitude of a vector. In floats a vector without length gets 10⁻¹⁸, so that the inverse
    /// is finite without a later sum.
    fn magnitude_above_zero<F: Point>(v: Self::Four<F>) -> Self::Magnitude;

    /// The magnitude of a vector whose direction is used only where it has a length. In floats the
    /// inverse of no length is infinite.
    fn magnitude_unguarded<F: Point>(v: Self::Four<F>) -> Self::Magnitude;

    /// The length.
    fn length<F: Point>(magnitude: Self::Magnitude) -> Self::Scalar<F>;

    /// A vector of that magnitude at length 1; something finite if it has none.
    fn direction<F: Point>(
        v: Self::Four<F>,
        magnitude: Self::Magnitude,
    ) -> Self::Four<<Fraction as Unit>::Point>;

    /// The component of `v` along `axis`, which has this magnitude.
    fn project<F: Point>(
        v: Self::Four<F>,
        axis: Self::Four<F>,
        magnitude: Self::Magnitude,
    ) -> Self::Projection<F>;

    /// A factor times a projection.
    fn scale_projection<F: Point, G: Point, H: Point>(
        projection: Self::Projection<F>,
        factor: Self::Scalar<G>,
        cut: Cut,
    ) -> Self::Scalar<H>;

    /// `reach` over the length; 1 or more where it reaches further.
    fn ratio<F: Point>(
        reach: Self::Scalar<F>,
        magnitude: Self::Magnitude,
    ) -> Self::Scalar<<Fraction as Unit>::Point>;
}

/// Length and inverse length of a vector of unit `U`.
#[derive(Debug)]
pub struct Magnitude<A: Magnitudes, U: Unit>(A::Magnitude, PhantomData<U>);

impl<A: Magnitudes, U: Unit> Clone for Magnitude<A, U> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<A: Magnitudes, U: Unit> Copy for Magnitude<A, U> {}

impl<A: Magnitudes, U: Unit> Magnitude<A, U> {
    /// See [`Magnitudes::magnitude`].
    #[inline(always)]
    #[must_use]
    pub fn of_square(square: A::Square) -> Self {
        Self(A::magnitude(square), PhantomData)
    }

    /// See [`Magnitudes::magnitude_above_zero`].
    #[inline(always)]
    #[must_use]
    pub fn above_zero(v: Vector<A, U>) -> Self {
        Self(A::magnitude_above_zero(v.0), PhantomData)
    }

    /// See [`Magnitudes::magnitude_unguarded`].
    #[inline(always)]
    #[must_use]
    pub fn unguarded(v: Vector<A, U>) -> Self {
        Self(A::magnitude_unguarded(v.0), PhantomData)
    }

    /// The length.
    #[inline(always)]
    #[must_use]
    pub fn length(self) -> Quantity<A, U> {
        Quantity(A::length(self.0))
    }

    /// `reach` over the length; 1 or more where it reaches further.
    #[inline(always)]
    #[must_use]
    pub fn divides(self, reach: Quantity<A, U>) -> Quantity<A, Fraction> {
        Quantity(A::ratio::<U::Point>(reach.0, self.0))
    }
}

impl<A: Magnitudes> Quantity<A, DirectionFactor> {
    /// The square root of a factor that is not negative.
    #[inline(always)]
    #[must_use]
    pub(crate) fn root(self) -> Self {
        Self(A::root(self.0))
    }
}

impl<A: Magnitudes, U: Unit> Vector<A, U> {
    /// The square of the length.
    #[inline(always)]
    pub(crate) fn square(self) -> A::Square {
        A::square(self.0)
    }

    /// The direction, of a vector with this magnitude.
    #[inline(always)]
    #[must_use]
    pub fn direction(self, magnitude: Magnitude<A, U>) -> Vector<A, Fraction> {
        Vector(A::direction(self.0, magnitude.0))
    }

    /// The component along `axis`, which has this magnitude.
    #[inline(always)]
    #[must_use]
    pub fn along(self, axis: Self, magnitude: Magnitude<A, U>) -> Projection<A, U> {
        Projection(A::project(self.0, axis.0, magnitude.0))
    }
}

/// The component of a vector along another one. In floats it is still to be multiplied by the
/// inverse length, which is known last.
#[derive(Clone, Copy)]
pub struct Projection<A: Magnitudes, U: Unit>(A::Projection<U::Point>);

impl<A: Magnitudes, U: Times<V>, V: Unit> Mul<Projection<A, V>> for Quantity<A, U> {
    type Output = Quantity<A, U::Product>;
    #[inline(always)]
    fn mul(self, projection: Projection<A, V>) -> Self::Output {
        let product: Raw<A, U::Product> =
            A::scale_projection::<V::Point, U::Point, _>(projection.0, self.0, U::CUT);
        Quantity(product)
    }
}
