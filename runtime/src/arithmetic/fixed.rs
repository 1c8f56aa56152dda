//! Fixed point of 32 bits, with products and sums in 64.
//!
//! A product is rounded once, to the nearest. In debug builds, and wherever debug assertions are
//! on, a result out of range panics; [`units`](super::units) shows why there is none.

mod limits;
mod reciprocal;

use super::{
    Arithmetic, NEARLY_INSIDE, Point, Scalar, Zero,
    float::{C1, C3},
    units::{Acceleration, Coefficient, Coordinate, Gaussian, Pair, Slope, Unit, Weight},
};
use crate::{Config, ConfigError, LoadError, Surface, lsf::Two};
use asperity_formats::Asset;
use core::array;
use fixed::{FixedI32, types::extra::Unsigned as _};
use reciprocal::{quotient, reciprocal_root};

/// `FixedI32`, for processors without an FPU.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Fixed;

/// The root of a square, and its reciprocal `inverse`·2^(shift − 62), shift ≤ 32.
#[derive(Debug, Clone, Copy)]
pub struct FixedPolar {
    length: u32,
    inverse: u32,
    shift: u32,
}

impl FixedPolar {
    /// A number over the length, which it does not exceed.
    #[inline(always)]
    fn under<F: Point>(self, number: FixedI32<F>) -> FixedI32<Unit> {
        let scaled = (i64::from(number.to_bits()) * i64::from(self.inverse)) >> self.shift;
        FixedI32::from_bits(scaled as i32)
    }
}

type Four<F> = [FixedI32<F>; 4];

/// `wide`·2^−shift in range.
#[inline(always)]
fn narrow<F: Point>(wide: i64, shift: i32) -> FixedI32<F> {
    let rounded = round(wide, shift);
    debug_assert_eq!(rounded, i64::from(rounded as i32), "out of range");
    FixedI32::from_bits(rounded as i32)
}

/// `wide`·2^−shift, at most `limit` in size.
#[inline(always)]
fn narrow_within<F: Point>(wide: i64, shift: i32, limit: i32) -> FixedI32<F> {
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

/// To the nearest.
#[inline(always)]
const fn round(wide: i64, shift: i32) -> i64 {
    if shift > 0 {
        (wide + (1 << (shift - 1))) >> shift
    } else {
        wide << -shift
    }
}

#[inline(always)]
fn wide<F: Point, G: Point>(a: FixedI32<F>, b: FixedI32<G>) -> i64 {
    i64::from(a.to_bits()) * i64::from(b.to_bits())
}

/// From the point of a product to that of a number.
const fn shift<F: Point, G: Point, H: Point>() -> i32 {
    F::I32 + G::I32 - H::I32
}

impl<F: Point> Zero for FixedI32<F> {
    const ZERO: Self = Self::ZERO;
}

impl<F: Point, const N: usize> Zero for [FixedI32<F>; N] {
    const ZERO: Self = [FixedI32::ZERO; N];
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
}

/// 2 to the power of the bits behind the point.
#[inline(always)]
const fn scale<F: Point>() -> f64 {
    (1_u64 << F::U32) as f64
}

/// What rounds to the nearest before a cut.
#[inline(always)]
const fn half(value: f32) -> f64 {
    if value < 0.0 { -0.5 } else { 0.5 }
}

/// The bits of a positive limit; the end of the range beyond it.
#[inline(always)]
const fn bits_of<F: Point>(limit: f32) -> i32 {
    (limit as f64 * scale::<F>()) as i32
}

impl Arithmetic for Fixed {
    type Scalar<F: Point> = FixedI32<F>;
    type Four<F: Point> = Four<F>;
    type Three<F: Point> = [FixedI32<F>; 3];
    type Best = FixedI32<Weight>;
    type Square = u64;
    type Polar = FixedPolar;
    type Sum = i64;

    const WORST: FixedI32<Weight> = FixedI32::MIN;
    const FAR_OFF: FixedI32<Coordinate> = FixedI32::from_bits(1500 << Coordinate::U32);
    const STEEP: FixedI32<Slope> = FixedI32::from_bits(1000 << Slope::U32);
    const ONE_HALF: FixedI32<Coefficient> = FixedI32::from_bits(1 << (Coefficient::I32 - 1));
    const IN_REGISTERS: bool = false;
    const REACH_M: f32 = 1.0;
    const OUT_OF_REACH_M: f32 = 4.0;
    const ROUNDING_N: f32 = 4.0e-5;
    const VIB_LIMIT_M_S2: f32 = 2048.0;
    const SILENCE_M_S2: f32 = 0.0;

    fn check_config(config: &Config) -> Result<(), ConfigError> {
        limits::check_config(config)
    }

    fn check_surface(surface: &Surface) -> Result<(), ConfigError> {
        limits::check_surface(surface)
    }

    fn check(asset: &Asset<'_>) -> Result<(), LoadError> {
        limits::check(asset)
    }

    #[inline(always)]
    fn whole<F: Point>(n: i32) -> FixedI32<F> {
        FixedI32::from_bits(n << F::U32)
    }

    #[inline(always)]
    fn nearest<F: Point>(a: FixedI32<F>) -> u32 {
        ((a.to_bits() + (1 << (F::U32 - 1))) >> F::U32) as u32
    }

    #[inline(always)]
    fn to<F: Point, G: Point>(a: FixedI32<F>) -> FixedI32<G> {
        narrow(i64::from(a.to_bits()), F::I32 - G::I32)
    }

    #[inline(always)]
    fn plus_within<F: Point>(a: FixedI32<F>, b: FixedI32<F>) -> FixedI32<F> {
        a.saturating_add(b)
    }

    #[inline(always)]
    fn times<F: Point, G: Point, H: Point>(a: FixedI32<F>, b: FixedI32<G>) -> FixedI32<H> {
        narrow(wide(a, b), shift::<F, G, H>())
    }

    #[inline(always)]
    fn times_within<F: Point, G: Point, H: Point>(
        a: FixedI32<F>,
        b: FixedI32<G>,
        limit: f32,
    ) -> FixedI32<H> {
        narrow_within(wide(a, b), shift::<F, G, H>(), bits_of::<H>(limit))
    }

    #[inline(always)]
    fn left_of<F: Point>(a: FixedI32<F>, b: FixedI32<F>) -> FixedI32<F> {
        // Products are dear here: b is made in any case, so that a tick always costs the same.
        let left = (a - b).max(FixedI32::ZERO);
        if a > FixedI32::<F>::ZERO {
            left
        } else {
            FixedI32::ZERO
        }
    }

    #[inline(always)]
    fn over<F: Point, G: Point, H: Point>(a: FixedI32<F>, b: FixedI32<G>) -> FixedI32<H> {
        FixedI32::from_bits(quotient(
            a.to_bits(),
            b.to_bits().unsigned_abs(),
            G::I32 + H::I32 - F::I32,
        ))
    }

    #[inline(always)]
    fn four<F: Point>(numbers: &Four<F>) -> Four<F> {
        *numbers
    }

    #[inline(always)]
    fn three<F: Point>([x, y, z, _]: Four<F>) -> [FixedI32<F>; 3] {
        [x, y, z]
    }

    #[inline(always)]
    fn four_of_three<F: Point>([x, y, z]: [FixedI32<F>; 3]) -> Four<F> {
        [x, y, z, FixedI32::ZERO]
    }

    #[inline(always)]
    fn numbers<F: Point>(four: Four<F>) -> Four<F> {
        four
    }

    #[inline(always)]
    fn four_plus<F: Point>(a: Four<F>, b: Four<F>) -> Four<F> {
        array::from_fn(|lane| a[lane] + b[lane])
    }

    #[inline(always)]
    fn four_minus<F: Point>(a: Four<F>, b: Four<F>) -> Four<F> {
        array::from_fn(|lane| a[lane] - b[lane])
    }

    #[inline(always)]
    fn alternating<F: Point>([a, b, c, d]: Four<F>) -> Four<F> {
        [a, -b, c, -d]
    }

    #[inline(always)]
    fn four_min<F: Point>(a: Four<F>, b: Four<F>) -> Four<F> {
        array::from_fn(|lane| a[lane].min(b[lane]))
    }

    #[inline(always)]
    fn four_times<F: Point, G: Point, H: Point>(a: Four<F>, b: Four<G>) -> Four<H> {
        array::from_fn(|lane| Self::times(a[lane], b[lane]))
    }

    #[inline(always)]
    fn four_scaled<F: Point, G: Point, H: Point>(a: Four<F>, b: FixedI32<G>) -> Four<H> {
        a.map(|a| Self::times(a, b))
    }

    #[inline(always)]
    fn four_times_within<F: Point, G: Point, H: Point>(
        a: Four<F>,
        b: Four<G>,
        limits: Four<H>,
    ) -> Four<H> {
        array::from_fn(|lane| {
            let limit = limits[lane].to_bits();
            narrow_within(wide(a[lane], b[lane]), shift::<F, G, H>(), limit)
        })
    }

    #[inline(always)]
    fn four_sum_within<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(Four<F>, Four<G>); N],
        limit: f32,
    ) -> Four<H> {
        array::from_fn(|lane| {
            let sum = terms
                .iter()
                .fold(0, |sum, (x, c)| sum + wide(x[lane], c[lane]));
            narrow_within(sum, shift::<F, G, H>(), bits_of::<H>(limit))
        })
    }

    #[inline(always)]
    fn sum_within<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(FixedI32<F>, FixedI32<G>); N],
        limit: f32,
    ) -> FixedI32<H> {
        let sum = terms.iter().fold(0, |sum, &(x, c)| sum + wide(x, c));
        narrow_within(sum, shift::<F, G, H>(), bits_of::<H>(limit))
    }

    #[inline(always)]
    fn dot3<F: Point, G: Point, H: Point>(a: Four<F>, b: Four<G>) -> FixedI32<H> {
        let sum = wide(a[0], b[0]) + wide(a[1], b[1]) + wide(a[2], b[2]);
        narrow(sum, shift::<F, G, H>())
    }

    #[inline(always)]
    fn first_three<F: Point>([x, y, z, _]: Four<F>) -> Four<F> {
        [x, y, z, FixedI32::ZERO]
    }

    #[inline(always)]
    fn is_within<F: Point>(a: Four<F>, limit: f32) -> bool {
        let limit = bits_of::<F>(limit).unsigned_abs();
        a.iter().all(|a| a.to_bits().unsigned_abs() <= limit)
    }

    #[inline(always)]
    fn better(
        best: FixedI32<Weight>,
        four: Four<Weight>,
        bits: u32,
        index: u32,
    ) -> FixedI32<Weight> {
        let marked = |x: FixedI32<Weight>, index: u32| {
            FixedI32::from_bits(x.to_bits() & !bits as i32 | index as i32)
        };
        let lanes = four.into_iter().zip(index..);
        lanes.fold(best, |best, (x, index)| marked(x, index).max(best))
    }

    #[inline(always)]
    fn is_inside(best: FixedI32<Weight>) -> bool {
        best >= <FixedI32<Weight> as Scalar>::of(NEARLY_INSIDE)
    }

    #[inline(always)]
    fn keep_best(best: FixedI32<Weight>, bits: &mut [u32; 4]) {
        bits[0] = best.bits();
    }

    #[inline(always)]
    fn kept_best(bits: &[u32; 4]) -> FixedI32<Weight> {
        Scalar::from_bits(bits[0])
    }

    #[inline(always)]
    fn best(best: FixedI32<Weight>, bits: u32) -> u32 {
        best.to_bits() as u32 & bits
    }

    #[inline(always)]
    fn square<F: Point>([x, y, z, _]: Four<F>) -> u64 {
        (wide(x, x) + wide(y, y) + wide(z, z)) as u64
    }

    #[inline(always)]
    fn square_of<F: Point>(length: FixedI32<F>) -> u64 {
        wide(length, length) as u64
    }

    #[inline(always)]
    fn is_some(square: u64) -> bool {
        square > 0
    }

    #[inline(always)]
    fn is_sane(_: u64) -> bool {
        true
    }

    #[inline(always)]
    fn polar(square: u64) -> FixedPolar {
        // No length takes as long as any.
        let some = square.max(1);
        let zeros = some.leading_zeros() & !1;
        let m = ((some << zeros) >> 32) as u32;
        let inverse = reciprocal_root(m);
        let shift = 32 - zeros / 2;
        // √m with 32 bits behind the point; the root of a square is below 2³².
        let root = (u64::from(m) * u64::from(inverse)) >> 30;
        let length = (root >> (32 - shift)) as u32;
        FixedPolar {
            // Everything reaches a length of zero.
            length: if square == 0 { 0 } else { length },
            inverse,
            shift,
        }
    }

    #[inline(always)]
    fn polar_pair<F: Point, G: Point>(a: Four<F>, b: Four<G>) -> [FixedPolar; 2] {
        [Self::square(a), Self::square(b)].map(Self::polar)
    }

    #[inline(always)]
    fn tangential<F: Point>(vector: Four<F>, normal: Four<Unit>) -> Four<F> {
        let along: FixedI32<F> = Self::dot3(vector, normal);
        Self::four_minus(vector, Self::four_scaled(normal, along))
    }

    #[inline(always)]
    fn length<F: Point>(polar: FixedPolar) -> FixedI32<F> {
        FixedI32::from_bits(polar.length as i32)
    }

    #[inline(always)]
    fn direction<F: Point>(vector: Four<F>, polar: FixedPolar) -> Four<Unit> {
        vector.map(|x| polar.under(x))
    }

    #[inline(always)]
    fn along<F: Point, G: Point, H: Point>(
        vector: Four<F>,
        other: Four<F>,
        polar: FixedPolar,
        factor: FixedI32<G>,
        limit: f32,
    ) -> FixedI32<H> {
        let along: FixedI32<F> = Self::dot3(Self::direction::<F>(other, polar), vector);
        Self::times_within(along, factor, limit)
    }

    #[inline(always)]
    fn share<F: Point>(reach: FixedI32<F>, polar: FixedPolar) -> FixedI32<Unit> {
        let one = FixedI32::<Unit>::ONE;
        let under = polar.under(reach).min(one);
        // The length is rounded down.
        if reach.to_bits().unsigned_abs() > polar.length {
            one
        } else {
            under
        }
    }

    #[inline(always)]
    fn over_root<F: Point>(reach: FixedI32<F>, square: u64) -> FixedI32<Unit> {
        // The length itself is not asked for: it is not below the reach.
        Self::polar(square).under(reach).min(FixedI32::ONE)
    }

    #[inline(always)]
    fn extend<const FULL: bool>(
        two: &Two<FixedI32<Pair>>,
        c: [Option<FixedI32<Coefficient>>; 5],
    ) -> FixedI32<Coefficient> {
        let [c, one, middle, three, four] = c.map(Option::unwrap_or_default);
        // o is 0 or 1.
        let shown = |x: FixedI32<Coefficient>| {
            if FULL || two.o.is_positive() {
                x
            } else {
                FixedI32::ZERO
            }
        };
        let sum = (i64::from((c + shown(four)).to_bits()) << Pair::I32)
            + wide(two.q, middle)
            + wide(two.s, one + shown(three));
        narrow_within(sum, Pair::I32, bits_of::<Coefficient>(LARGEST_PRODUCT))
    }

    #[inline(always)]
    fn extend_four<const FULL: bool>(
        two: &Two<Four<Pair>>,
        c: [Option<Four<Coefficient>>; 5],
    ) -> Four<Coefficient> {
        array::from_fn(|lane| {
            let two = Two {
                s: two.s[lane],
                q: two.q[lane],
                o: two.o[lane],
            };
            Self::extend::<FULL>(&two, c.map(|c| c.map(|c| c[lane])))
        })
    }

    #[inline(always)]
    fn gaussian(centred: i32) -> FixedI32<Gaussian> {
        /// 44 and 60 bits behind the point.
        const LINEAR: i64 = (C1 as f64 * (1_u64 << 44) as f64) as i64;
        const CUBIC: i64 = (C3 as f64 * (1_u64 << 60) as f64) as i64;
        // Below 2¹⁸, so both factors fit 32 bits after the shift.
        let square = i64::from(centred * centred);
        let slope = ((LINEAR + (((CUBIC >> 8) * square) >> 8)) >> 8) as i32;
        FixedI32::from_bits(((i64::from(slope) * i64::from(centred)) >> 8) as i32)
    }

    #[inline(always)]
    fn sum_of(first: FixedI32<Acceleration>) -> i64 {
        i64::from(first.to_bits()) << Coefficient::I32
    }

    #[inline(always)]
    fn inner_product(
        blocks: usize,
        c: &[[FixedI32<Coefficient>; 4]],
        x: &[[FixedI32<Acceleration>; 4]],
    ) -> i64 {
        let products = c.iter().zip(x).take(blocks);
        let block = |(c, x): (&Four<Coefficient>, &Four<Acceleration>)| {
            wide(c[0], x[0]) + wide(c[1], x[1]) + wide(c[2], x[2]) + wide(c[3], x[3])
        };
        products.map(block).sum()
    }

    #[inline(always)]
    fn sample_of(sum: i64) -> (FixedI32<Acceleration>, bool) {
        let limit = bits_of::<Acceleration>(Self::VIB_LIMIT_M_S2);
        let y = narrow_within(sum, Coefficient::I32, limit);
        (y, y.to_bits().unsigned_abs() == limit.unsigned_abs())
    }
}

/// No coefficient of a partial product is beyond this; those of real textures stay far below.
const LARGEST_PRODUCT: f32 = 64.0;
