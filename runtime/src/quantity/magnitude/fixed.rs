//! Lengths in fixed point.

use super::Magnitudes;
use crate::{
    arithmetic::{Arithmetic, Cut, Fixed, Point, Quad, fixed::wide, reciprocal_root},
    quantity::unit::{Fraction, Unit},
};
use fixed::FixedI32;

/// The root of a square, and its reciprocal `inverse`·2^(shift − 62), shift ≤ 32.
#[derive(Debug, Clone, Copy)]
pub struct FixedMagnitude {
    length: u32,
    inverse: u32,
    shift: u32,
}

impl FixedMagnitude {
    /// A number over the length, which it does not exceed.
    #[inline(always)]
    pub(crate) fn under<F: Point>(
        self,
        number: FixedI32<F>,
    ) -> FixedI32<<Fraction as Unit>::Point> {
        let scaled = (i64::from(number.to_bits()) * i64::from(self.inverse)) >> self.shift;
        FixedI32::from_bits(scaled as i32)
    }
}

impl Magnitudes for Fixed {
    type Square = u64;
    type Magnitude = FixedMagnitude;
    /// The inner product with the direction.
    type Projection<F: Point> = FixedI32<F>;

    #[inline(always)]
    fn square<F: Point>(Quad([x, y, z, _]): Quad<F>) -> u64 {
        (wide(x, x) + wide(y, y) + wide(z, z)) as u64
    }

    #[inline(always)]
    fn root<F: Point>(a: FixedI32<F>) -> FixedI32<F> {
        Self::length(Self::magnitude(
            (a.to_bits().unsigned_abs() as u64) << F::U32,
        ))
    }

    #[inline(always)]
    fn is_some(square: u64) -> bool {
        square > 0
    }

    #[inline(always)]
    fn magnitude(square: u64) -> FixedMagnitude {
        // A vector without length takes as long as any other.
        let some = square.max(1);
        let zeros = some.leading_zeros() & !1;
        let m = ((some << zeros) >> 32) as u32;
        let inverse = reciprocal_root(m);
        let shift = 32 - zeros / 2;
        // √m with 32 bits behind the point; the root of a square is below 2³².
        let root = (u64::from(m) * u64::from(inverse)) >> 30;
        let length = (root >> (32 - shift)) as u32;
        FixedMagnitude {
            // Everything reaches a length of zero.
            length: if square == 0 { 0 } else { length },
            inverse,
            shift,
        }
    }

    #[inline(always)]
    fn magnitude_above_zero<F: Point>(v: Quad<F>) -> FixedMagnitude {
        Self::magnitude(Self::square(v))
    }

    #[inline(always)]
    fn magnitude_unguarded<F: Point>(v: Quad<F>) -> FixedMagnitude {
        Self::magnitude(Self::square(v))
    }

    #[inline(always)]
    fn length<F: Point>(magnitude: FixedMagnitude) -> FixedI32<F> {
        FixedI32::from_bits(magnitude.length as i32)
    }

    #[inline(always)]
    fn direction<F: Point>(
        v: Quad<F>,
        magnitude: FixedMagnitude,
    ) -> Quad<<Fraction as Unit>::Point> {
        Quad(v.0.map(|x| magnitude.under(x)))
    }

    #[inline(always)]
    fn project<F: Point>(v: Quad<F>, axis: Quad<F>, magnitude: FixedMagnitude) -> FixedI32<F> {
        Self::dot3(Self::direction(axis, magnitude), v)
    }

    #[inline(always)]
    fn scale_projection<F: Point, G: Point, H: Point>(
        projection: FixedI32<F>,
        factor: FixedI32<G>,
        cut: Cut,
    ) -> FixedI32<H> {
        Self::product(projection, factor, cut)
    }

    #[inline(always)]
    fn ratio<F: Point>(
        reach: FixedI32<F>,
        magnitude: FixedMagnitude,
    ) -> FixedI32<<Fraction as Unit>::Point> {
        let one = FixedI32::ONE;
        let under = magnitude.under(reach).min(one);
        // The length is rounded down.
        if reach.to_bits().unsigned_abs() > magnitude.length {
            one
        } else {
            under
        }
    }
}
