//! What a tick computes with: [`Float`], or [`Fixed`] point for processors without an FPU.
//!
//! Every stage is written once, over [`Arithmetic`]. A [`Number`] carries its binary point in
//! its type, so that a product or a quotient lands where it belongs; [`units`] gives each
//! quantity its point, and the range that follows. Floats know no points: there a [`Number`] is an
//! `f32`, and four numbers side by side a register.

mod fixed;
mod float;
mod four;
mod number;
pub mod units;

#[cfg(test)]
pub(crate) use self::float::{C1, C3};
pub(crate) use self::four::{Four, Three};
pub use self::{fixed::Fixed, float::Float, number::Number};

use self::units::{Acceleration, Coefficient, Coordinate, Gaussian, Pair, Slope, Unit, Weight};
use crate::{Config, ConfigError, LoadError, Surface, lsf::Two};
use ::fixed::types::extra::LeEqU32;
use asperity_formats::Asset;
use core::{
    fmt::Debug,
    ops::{Add, Neg, Sub},
};

/// A binary point: how many bits stand behind it.
pub trait Point: LeEqU32 + Copy + Debug + Default + PartialEq + 'static {}

impl<P: LeEqU32 + Copy + Debug + Default + PartialEq + 'static> Point for P {}

/// What can be nothing.
pub trait Zero: Copy + Debug + PartialEq + 'static {
    /// Nothing.
    const ZERO: Self;
}

/// One number as callers see it: an `f32`, or a `FixedI32`.
pub trait Scalar:
    Zero + Default + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self>
{
    /// Larger than every number in use.
    const FARTHEST: Self;
    /// What stands for a position that a device does not have.
    const MISSING: Self;

    /// The nearest one to `value`; the end of the range beyond it, 0 for NaN.
    fn of(value: f32) -> Self;

    /// Its value.
    fn value(self) -> f32;

    /// Its bits.
    fn bits(self) -> u32;

    /// Of these bits.
    fn from_bits(bits: u32) -> Self;

    /// Whether `value` lies in the range.
    fn holds(value: f32) -> bool;
}

/// A point whose smallest weight is this, −2⁻²³, or more, lies in a triangle: what rounding leaves
/// of a zero. More would be felt beside slivers, whose mixtures change within a hair. The last bits,
/// where a weight has an index, are set, so that no index decides.
pub const NEARLY_INSIDE: f32 = f32::from_bits(0xb400_007f);

/// A kind of arithmetic.
///
/// What a function does beyond a range says its name: `…_within` stays within a limit, the others
/// are only used where [`units`] shows that the result is in range. Floats have no range.
pub trait Arithmetic: Copy + Debug + Default + PartialEq + 'static {
    /// One number.
    type Scalar<F: Point>: Scalar;
    /// Four numbers.
    type Four<F: Point>: Zero;
    /// Three components of a vector as a state keeps them.
    type Three<F: Point>: Zero;
    /// The largest of many weights, or of those in each lane.
    type Best: Copy + Debug + PartialEq;
    /// The square of a length.
    type Square: Copy + Debug + PartialOrd;
    /// What a length and a direction are made of.
    type Polar: Copy + Debug;
    /// A sum of products of coefficients and samples.
    type Sum: Copy + Add<Output = Self::Sum> + Sub<Output = Self::Sum>;

    /// Less than every weight.
    const WORST: Self::Best;
    /// A coordinate beyond every grid, and a slope that makes a weight there less than any.
    const FAR_OFF: Self::Scalar<Coordinate>;
    /// See [`Arithmetic::FAR_OFF`].
    const STEEP: Self::Scalar<Slope>;
    /// ½.
    const ONE_HALF: Self::Scalar<Coefficient>;
    /// Whether registers hold four numbers; elsewhere long work costs less lane by lane.
    const IN_REGISTERS: bool;
    /// Positions beyond this on any axis are errors, not positions, m.
    const REACH_M: f32;
    /// Further away than every position in reach, m.
    const OUT_OF_REACH_M: f32;
    /// Forces stay so far within their limits, N, that the rounding of two steps exceeds none.
    const ROUNDING_N: f32;
    /// |y| never exceeds this, m/s²; a verified texture stays far below.
    const VIB_LIMIT_M_S2: f32;
    /// Less than this is silence, m/s².
    const SILENCE_M_S2: f32;

    /// Whether a configuration lies in the range.
    ///
    /// # Errors
    /// The first field that does not.
    fn check_config(config: &Config) -> Result<(), ConfigError>;

    /// Whether a surface lies in the range.
    ///
    /// # Errors
    /// The first field that does not.
    fn check_surface(surface: &Surface) -> Result<(), ConfigError>;

    /// Whether a texture lies in the range.
    ///
    /// # Errors
    /// [`LoadError::Range`] with the first field that does not.
    fn check(asset: &Asset<'_>) -> Result<(), LoadError>;

    /// A whole number.
    fn whole<F: Point>(n: i32) -> Self::Scalar<F>;

    /// The nearest whole number, of one from 0 to 32.
    fn nearest<F: Point>(a: Self::Scalar<F>) -> u32;

    /// A number at another point.
    fn to<F: Point, G: Point>(a: Self::Scalar<F>) -> Self::Scalar<G>;

    /// a + b, at the end of the range beyond it.
    fn plus_within<F: Point>(a: Self::Scalar<F>, b: Self::Scalar<F>) -> Self::Scalar<F>;

    /// a·b.
    fn times<F: Point, G: Point, H: Point>(
        a: Self::Scalar<F>,
        b: Self::Scalar<G>,
    ) -> Self::Scalar<H>;

    /// a·b, at most `limit` in size.
    fn times_within<F: Point, G: Point, H: Point>(
        a: Self::Scalar<F>,
        b: Self::Scalar<G>,
        limit: f32,
    ) -> Self::Scalar<H>;

    /// a − b, not below zero; zero where a is.
    fn left_of<F: Point>(a: Self::Scalar<F>, b: Self::Scalar<F>) -> Self::Scalar<F>;

    /// a/b for b ≥ 0; the end of the range beyond it, 0 for 0/0.
    fn over<F: Point, G: Point, H: Point>(
        a: Self::Scalar<F>,
        b: Self::Scalar<G>,
    ) -> Self::Scalar<H>;

    /// Four numbers.
    fn four<F: Point>(numbers: &[Self::Scalar<F>; 4]) -> Self::Four<F>;

    /// The first three of four.
    fn three<F: Point>(four: Self::Four<F>) -> Self::Three<F>;

    /// Three components and a number that means nothing.
    fn four_of_three<F: Point>(three: Self::Three<F>) -> Self::Four<F>;

    /// The numbers of four.
    fn numbers<F: Point>(four: Self::Four<F>) -> [Self::Scalar<F>; 4];

    /// a + b.
    fn four_plus<F: Point>(a: Self::Four<F>, b: Self::Four<F>) -> Self::Four<F>;

    /// a − b.
    fn four_minus<F: Point>(a: Self::Four<F>, b: Self::Four<F>) -> Self::Four<F>;

    /// The second and the fourth with the other sign.
    fn alternating<F: Point>(a: Self::Four<F>) -> Self::Four<F>;

    /// The smaller of each two.
    fn four_min<F: Point>(a: Self::Four<F>, b: Self::Four<F>) -> Self::Four<F>;

    /// The products of each two.
    fn four_times<F: Point, G: Point, H: Point>(
        a: Self::Four<F>,
        b: Self::Four<G>,
    ) -> Self::Four<H>;

    /// Multiples.
    fn four_scaled<F: Point, G: Point, H: Point>(
        a: Self::Four<F>,
        b: Self::Scalar<G>,
    ) -> Self::Four<H>;

    /// The products of each two, each at most that of `limits` in size.
    fn four_times_within<F: Point, G: Point, H: Point>(
        a: Self::Four<F>,
        b: Self::Four<G>,
        limits: Self::Four<H>,
    ) -> Self::Four<H>;

    /// Σ xᵢ·cᵢ, first to last, each at most `limit` in size.
    fn four_sum_within<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(Self::Four<F>, Self::Four<G>); N],
        limit: f32,
    ) -> Self::Four<H>;

    /// [`Arithmetic::four_sum_within`] of single numbers.
    fn sum_within<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(Self::Scalar<F>, Self::Scalar<G>); N],
        limit: f32,
    ) -> Self::Scalar<H>;

    /// x + y + z of the products of each two.
    fn dot3<F: Point, G: Point, H: Point>(a: Self::Four<F>, b: Self::Four<G>) -> Self::Scalar<H>;

    /// The first three and a number that means nothing, a zero where numbers have a range.
    fn first_three<F: Point>(a: Self::Four<F>) -> Self::Four<F>;

    /// Whether none of the four is beyond ±`limit`, or no number.
    fn is_within<F: Point>(a: Self::Four<F>, limit: f32) -> bool;

    /// The best so far of weights whose last bits, those of `bits`, are replaced by their index;
    /// four come from `index` on.
    fn better(best: Self::Best, four: Self::Four<Weight>, bits: u32, index: u32) -> Self::Best;

    /// Whether the best one has its point: [`NEARLY_INSIDE`].
    fn is_inside(best: Self::Best) -> bool;

    /// The best one as bits; where it is a single number, in the first of them.
    fn keep_best(best: Self::Best, bits: &mut [u32; 4]);

    /// The best one of those bits.
    fn kept_best(bits: &[u32; 4]) -> Self::Best;

    /// The index of the best one.
    fn best(best: Self::Best, bits: u32) -> u32;

    /// The square of the length of the first three.
    fn square<F: Point>(a: Self::Four<F>) -> Self::Square;

    /// The square of a length.
    fn square_of<F: Point>(length: Self::Scalar<F>) -> Self::Square;

    /// Whether a square is more than that of a nanometre, or of nothing.
    fn is_some(square: Self::Square) -> bool;

    /// Whether a square is that of a number.
    fn is_sane(square: Self::Square) -> bool;

    /// What belongs to a square.
    fn polar(square: Self::Square) -> Self::Polar;

    /// What belongs to the first three of two vectors. The length of the first may be 10⁻¹⁸ where
    /// it has none; the second has no direction where it has no length.
    fn polar_pair<F: Point, G: Point>(a: Self::Four<F>, b: Self::Four<G>) -> [Self::Polar; 2];

    /// What is left of the first three of a vector in the plane with unit normal `normal`.
    fn tangential<F: Point>(vector: Self::Four<F>, normal: Self::Four<Unit>) -> Self::Four<F>;

    /// The length.
    fn length<F: Point>(polar: Self::Polar) -> Self::Scalar<F>;

    /// A vector of that length at length 1; something finite if it has none.
    fn direction<F: Point>(vector: Self::Four<F>, polar: Self::Polar) -> Self::Four<Unit>;

    /// What a vector has along another one, to which `polar` belongs, times `factor`; at most
    /// `limit` in size if numbers have a range.
    fn along<F: Point, G: Point, H: Point>(
        vector: Self::Four<F>,
        other: Self::Four<F>,
        polar: Self::Polar,
        factor: Self::Scalar<G>,
        limit: f32,
    ) -> Self::Scalar<H>;

    /// `reach` over the length; 1 or more where it reaches further.
    fn share<F: Point>(reach: Self::Scalar<F>, polar: Self::Polar) -> Self::Scalar<Unit>;

    /// `reach` over the root of a square that is not smaller.
    fn over_root<F: Point>(reach: Self::Scalar<F>, square: Self::Square) -> Self::Scalar<Unit>;

    /// Coefficient `k` of a polynomial times a two, from those of `k`, `k − 1` … `k − 4` that there
    /// are; with `FULL`, o = 1.
    fn extend<const FULL: bool>(
        two: &Two<Self::Scalar<Pair>>,
        c: [Option<Self::Scalar<Coefficient>>; 5],
    ) -> Self::Scalar<Coefficient>;

    /// [`Arithmetic::extend`] of four polynomials.
    fn extend_four<const FULL: bool>(
        two: &Two<Self::Four<Pair>>,
        c: [Option<Self::Four<Coefficient>>; 5],
    ) -> Self::Four<Coefficient>;

    /// ε of a centred sum of four bytes: see [`excitation`](crate::excitation).
    fn gaussian(centred: i32) -> Self::Scalar<Gaussian>;

    /// A sum that begins with a sample.
    fn sum_of(first: Self::Scalar<Acceleration>) -> Self::Sum;

    /// Σ c_k x_k over the first `blocks` blocks.
    fn inner_product(
        blocks: usize,
        c: &[[Self::Scalar<Coefficient>; 4]],
        x: &[[Self::Scalar<Acceleration>; 4]],
    ) -> Self::Sum;

    /// The sample of a sum, and whether it had to be clamped to [`Arithmetic::VIB_LIMIT_M_S2`].
    fn sample_of(sum: Self::Sum) -> (Self::Scalar<Acceleration>, bool);
}
