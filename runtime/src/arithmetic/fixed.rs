//! Fixed point of 32 bits, with products and sums in 64.
//!
//! A product is rounded once, to the nearest. In debug builds, and wherever debug assertions are
//! on, a result out of range panics; [`units`](crate::quantity::unit) shows why there is none.

use super::{
    operations::{Arithmetic, Cut},
    reciprocal::quotient,
    rounding::round,
    scalar::{Point, Scalar, Zero},
};
use core::ops::{Add, Sub};
use fixed::FixedI32;

/// `FixedI32`, for processors without an FPU.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Fixed;

/// Four numbers with one binary point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quad<F: Point>(pub(crate) [FixedI32<F>; 4]);

impl<F: Point> Quad<F> {
    /// Each lane by itself. `core::array::from_fn` would be a call.
    #[inline(always)]
    pub(crate) fn from_lanes(lane: impl Fn(usize) -> FixedI32<F>) -> Self {
        Self([lane(0), lane(1), lane(2), lane(3)])
    }
}

impl<F: Point> Zero for Quad<F> {
    const ZERO: Self = Self([FixedI32::ZERO; 4]);
}

impl<F: Point> Add for Quad<F> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::from_lanes(|lane| self.0[lane] + other.0[lane])
    }
}

impl<F: Point> Sub for Quad<F> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::from_lanes(|lane| self.0[lane] - other.0[lane])
    }
}

/// `wide`·2^−shift, within a cut.
#[inline(always)]
fn narrow<F: Point>(wide: i64, shift: i32, cut: Cut) -> FixedI32<F> {
    match cut {
        Cut::Never => {
            let rounded = round(wide, shift);
            debug_assert_eq!(rounded, i64::from(rounded as i32), "out of range");
            FixedI32::from_bits(rounded as i32)
        }
        Cut::At(limit) => narrow_within(wide, shift, bits_of::<F>(limit)),
    }
}

/// `wide`·2^−shift, at most `limit` in size.
#[inline(always)]
pub(crate) fn narrow_within<F: Point>(wide: i64, shift: i32, limit: i32) -> FixedI32<F> {
    let rounded = round(wide, shift);
    let clamped = if rounded > i64::from(limit) {
        limit
    } else if rounded < -i64::from(limit) {
        -limit
    } else {
        rounded as i32
    };
    FixedI32::from_bits(clamped)
}

/// The product, not yet rounded.
#[inline(always)]
pub(crate) fn wide<F: Point, G: Point>(a: FixedI32<F>, b: FixedI32<G>) -> i64 {
    i64::from(a.to_bits()) * i64::from(b.to_bits())
}

/// Right shift that takes a product of numbers with points F and G to point H, bits.
pub(crate) const fn shift<F: Point, G: Point, H: Point>() -> i32 {
    F::I32 + G::I32 - H::I32
}

/// The bits of a positive limit; the end of the range beyond it.
#[inline(always)]
pub(crate) const fn bits_of<F: Point>(limit: f32) -> i32 {
    (limit as f64 * scale::<F>()) as i32
}

/// 2 to the power of the bits behind the point.
#[inline(always)]
const fn scale<F: Point>() -> f64 {
    (1_u64 << F::U32) as f64
}

/// The half that is added before a conversion truncates, so that it rounds to the nearest.
#[inline(always)]
const fn half(value: f32) -> f64 {
    if value < 0.0 { -0.5 } else { 0.5 }
}

impl<F: Point> Zero for FixedI32<F> {
    const ZERO: Self = Self::ZERO;
}

impl<F: Point> Scalar for FixedI32<F> {
    const FARTHEST: Self = Self::MAX;
    const MISSING: Self = Self::MIN;

    #[inline(always)]
    fn of(value: f32) -> Self {
        // The conversion saturates, and gives 0 for NaN.
        Self::from_bits((f64::from(value) * scale::<F>() + half(value)) as i32)
    }

    #[inline(always)]
    fn value(self) -> f32 {
        (f64::from(self.to_bits()) / scale::<F>()) as f32
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.to_bits() as u32
    }

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self::from_bits(bits as i32)
    }

    fn holds(value: f32) -> bool {
        (f64::from(value) * scale::<F>()).abs() <= f64::from(i32::MAX)
    }

    #[inline(always)]
    fn saturating_add(self, other: Self) -> Self {
        Self::saturating_add(self, other)
    }
}

impl Arithmetic for Fixed {
    type Scalar<F: Point> = FixedI32<F>;
    type Four<F: Point> = Quad<F>;
    type Three<F: Point> = [FixedI32<F>; 3];

    const IN_REGISTERS: bool = false;

    #[inline(always)]
    fn whole<F: Point>(n: i32) -> FixedI32<F> {
        FixedI32::from_bits(n << F::U32)
    }

    #[inline(always)]
    fn convert<F: Point, G: Point>(a: FixedI32<F>) -> FixedI32<G> {
        narrow(i64::from(a.to_bits()), F::I32 - G::I32, Cut::Never)
    }

    #[inline(always)]
    fn product<F: Point, G: Point, H: Point>(
        a: FixedI32<F>,
        b: FixedI32<G>,
        cut: Cut,
    ) -> FixedI32<H> {
        narrow(wide(a, b), shift::<F, G, H>(), cut)
    }

    #[inline(always)]
    fn quotient<F: Point, G: Point, H: Point>(a: FixedI32<F>, b: FixedI32<G>) -> FixedI32<H> {
        FixedI32::from_bits(quotient(
            a.to_bits(),
            b.to_bits().unsigned_abs(),
            G::I32 + H::I32 - F::I32,
        ))
    }

    #[inline(always)]
    fn sum_of_products<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(FixedI32<F>, FixedI32<G>); N],
        cut: Cut,
    ) -> FixedI32<H> {
        let sum = terms.iter().fold(0, |sum, &(x, c)| sum + wide(x, c));
        narrow(sum, shift::<F, G, H>(), cut)
    }

    #[inline(always)]
    fn four<F: Point>(numbers: &[FixedI32<F>; 4]) -> Quad<F> {
        Quad(*numbers)
    }

    #[inline(always)]
    fn numbers<F: Point>(four: Quad<F>) -> [FixedI32<F>; 4] {
        four.0
    }

    #[inline(always)]
    fn three<F: Point>(Quad([x, y, z, _]): Quad<F>) -> [FixedI32<F>; 3] {
        [x, y, z]
    }

    #[inline(always)]
    fn four_of_three<F: Point>([x, y, z]: [FixedI32<F>; 3]) -> Quad<F> {
        Quad([x, y, z, FixedI32::ZERO])
    }

    #[inline(always)]
    fn first_three<F: Point>(Quad([x, y, z, _]): Quad<F>) -> Quad<F> {
        Quad([x, y, z, FixedI32::ZERO])
    }

    #[inline(always)]
    fn four_min<F: Point>(a: Quad<F>, b: Quad<F>) -> Quad<F> {
        Quad::from_lanes(|lane| a.0[lane].min(b.0[lane]))
    }

    #[inline(always)]
    fn four_product<F: Point, G: Point, H: Point>(a: Quad<F>, b: Quad<G>, cut: Cut) -> Quad<H> {
        Quad::from_lanes(|lane| Self::product(a.0[lane], b.0[lane], cut))
    }

    #[inline(always)]
    fn four_sum_of_products<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(Quad<F>, Quad<G>); N],
        cut: Cut,
    ) -> Quad<H> {
        Quad::from_lanes(|lane| {
            let products = terms.iter().map(|(x, c)| wide(x.0[lane], c.0[lane]));
            narrow(products.sum(), shift::<F, G, H>(), cut)
        })
    }

    #[inline(always)]
    fn dot3<F: Point, G: Point, H: Point>(a: Quad<F>, b: Quad<G>) -> FixedI32<H> {
        let product = |axis: usize| wide(a.0[axis], b.0[axis]);
        let sum = product(0) + product(1) + product(2);
        narrow(sum, shift::<F, G, H>(), Cut::Never)
    }

    #[inline(always)]
    fn settled<F: Point>(a: FixedI32<F>, _: f32) -> FixedI32<F> {
        a
    }

    #[inline(always)]
    fn four_settled<F: Point>(a: Quad<F>, _: f32) -> Quad<F> {
        a
    }

    #[inline(always)]
    fn is_within<F: Point>(a: Quad<F>, limit: FixedI32<F>) -> bool {
        let limit = limit.to_bits().unsigned_abs();
        a.0.iter().all(|a| a.to_bits().unsigned_abs() <= limit)
    }
}
