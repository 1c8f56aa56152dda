//! A section pair, and its product with a polynomial.
//!
//! A section pair is a low second-order section times a high one:
//! (1 + l z⁻¹ + z⁻²)(1 + h z⁻¹ + z⁻²) = 1 + s z⁻¹ + q z⁻² + s z⁻³ + z⁻⁴, s = l + h, q = 2 + l·h.

use crate::{
    arithmetic::{
        Arithmetic, Fixed, Float, Quad,
        fixed::{bits_of, narrow_within, wide},
    },
    lanes::F4,
    quantity::{
        Raw,
        unit::{Coefficient, LineCosine, Unit},
    },
};
use core::ops::{Add, Mul};
use fixed::{FixedI32, types::extra::Unsigned as _};

/// Multiplying a section pair into polynomials.
pub trait SectionProduct: Arithmetic {
    /// ½.
    const ONE_HALF: Raw<Self, Coefficient>;

    /// Coefficient `k` of a polynomial times a section pair, from coefficients `k`, `k − 1` …
    /// `k − 4`, as far as there are any. With `FULL`, o = 1.
    fn extend<const FULL: bool>(
        pair: &SectionPair<Raw<Self, LineCosine>>,
        c: [Option<Raw<Self, Coefficient>>; 5],
    ) -> Raw<Self, Coefficient>;

    /// [`SectionProduct::extend`] of four polynomials.
    fn extend_four<const FULL: bool>(
        pair: &SectionPair<Self::Four<<LineCosine as Unit>::Point>>,
        c: [Option<Self::Four<<Coefficient as Unit>::Point>>; 5],
    ) -> Self::Four<<Coefficient as Unit>::Point>;

    /// Four numbers, the second and the fourth with the other sign.
    fn alternating(
        a: Self::Four<<Coefficient as Unit>::Point>,
    ) -> Self::Four<<Coefficient as Unit>::Point>;
}

impl SectionProduct for Float {
    const ONE_HALF: f32 = 0.5;

    #[inline(always)]
    fn extend<const FULL: bool>(pair: &SectionPair<f32>, c: [Option<f32>; 5]) -> f32 {
        extended::<FULL, f32>(pair, c).unwrap_or(0.0)
    }

    #[inline(always)]
    fn extend_four<const FULL: bool>(pair: &SectionPair<F4>, c: [Option<F4>; 5]) -> F4 {
        extended::<FULL, F4>(pair, c).unwrap_or(F4::ZERO)
    }

    #[inline(always)]
    fn alternating(a: F4) -> F4 {
        F4::load(&[1.0, -1.0, 1.0, -1.0]) * a
    }
}

/// See [`SectionProduct::extend`]: a coefficient that is not there takes no operation.
#[inline(always)]
fn extended<const FULL: bool, T: Copy + Add<Output = T> + Mul<Output = T>>(
    pair: &SectionPair<T>,
    [c, one, middle, three, four]: [Option<T>; 5],
) -> Option<T> {
    let plus = |a: Option<T>, b: Option<T>| match (a, b) {
        (Some(a), Some(b)) => Some(a + b),
        (a, b) => a.or(b),
    };
    let times = |factor: T, x: Option<T>| x.map(|x| factor * x);
    let shown = |x: Option<T>| if FULL { x } else { times(pair.o, x) };
    let ends = plus(plus(c, shown(four)), times(pair.q, middle));
    plus(ends, times(pair.s, plus(one, shown(three))))
}

/// No coefficient of a partial product is beyond this in fixed point; those of real textures stay
/// far below.
const LARGEST_PRODUCT: f32 = 64.0;

impl SectionProduct for Fixed {
    const ONE_HALF: Raw<Self, Coefficient> = FixedI32::lit("0.5");

    #[inline(always)]
    fn extend<const FULL: bool>(
        pair: &SectionPair<Raw<Self, LineCosine>>,
        c: [Option<Raw<Self, Coefficient>>; 5],
    ) -> Raw<Self, Coefficient> {
        const POINT: i32 = <LineCosine as Unit>::Point::I32;
        let [c, one, middle, three, four] = c.map(Option::unwrap_or_default);
        // o is 0 or 1.
        let shown = |x: Raw<Self, Coefficient>| {
            if FULL || pair.o.is_positive() {
                x
            } else {
                FixedI32::ZERO
            }
        };
        let sum = (i64::from((c + shown(four)).to_bits()) << POINT)
            + wide(pair.q, middle)
            + wide(pair.s, one + shown(three));
        let limit = bits_of::<<Coefficient as Unit>::Point>(LARGEST_PRODUCT);
        narrow_within(sum, POINT, limit)
    }

    #[inline(always)]
    fn extend_four<const FULL: bool>(
        pair: &SectionPair<Quad<<LineCosine as Unit>::Point>>,
        c: [Option<Quad<<Coefficient as Unit>::Point>>; 5],
    ) -> Quad<<Coefficient as Unit>::Point> {
        Quad::from_lanes(|lane| {
            let pair = SectionPair {
                s: pair.s.0[lane],
                q: pair.q.0[lane],
                o: pair.o.0[lane],
            };
            Self::extend::<FULL>(&pair, c.map(|c| c.map(|c| c.0[lane])))
        })
    }

    #[inline(always)]
    fn alternating(
        Quad([a, b, c, d]): Quad<<Coefficient as Unit>::Point>,
    ) -> Quad<<Coefficient as Unit>::Point> {
        Quad([a, -b, c, -d])
    }
}

/// A section pair: 1 + s z⁻¹ + q z⁻² + os z⁻³ + o z⁻⁴. Without a high section o is 0.
#[derive(Debug, Clone, Copy)]
pub struct SectionPair<T> {
    pub(crate) s: T,
    pub(crate) q: T,
    pub(crate) o: T,
}

impl<T> SectionPair<T> {
    /// Maps each factor.
    #[inline(always)]
    pub(super) fn map<U>(self, f: impl Fn(T) -> U) -> SectionPair<U> {
        SectionPair {
            s: f(self.s),
            q: f(self.q),
            o: f(self.o),
        }
    }
}
