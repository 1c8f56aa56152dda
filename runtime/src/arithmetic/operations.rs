//! The operations that every stage needs.

use super::scalar::{Point, Scalar, Zero};
use core::{
    fmt::Debug,
    ops::{Add, Sub},
};

/// Where a product or a sum of products is cut, if the arithmetic has a range. Floats have none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cut {
    /// Nowhere: the result is always in range ([`units`](crate::quantity::unit) shows why). In
    /// debug builds of fixed point a result out of range panics.
    Never,
    /// At ± this value, which is positive.
    At(f32),
}

/// A kind of arithmetic: [`Float`](super::Float) or [`Fixed`](super::Fixed).
///
/// `F`, `G` and `H` are binary points; a product of numbers with points F and G is rounded once,
/// to H. Four numbers side by side are a register where the processor has such.
pub trait Arithmetic: Copy + Debug + Default + PartialEq + 'static {
    /// Scalar type.
    type Scalar<F: Point>: Scalar;
    /// Four-lane vector type.
    type Four<F: Point>: Zero + Add<Output = Self::Four<F>> + Sub<Output = Self::Four<F>>;
    /// Storage type of three numbers in a state.
    type Three<F: Point>: Zero;

    /// True if four lanes fit a register; without one, long work is cheaper lane by lane.
    const IN_REGISTERS: bool;

    /// A whole number.
    fn whole<F: Point>(n: i32) -> Self::Scalar<F>;

    /// The same number with another binary point.
    fn convert<F: Point, G: Point>(a: Self::Scalar<F>) -> Self::Scalar<G>;

    /// a·b.
    fn product<F: Point, G: Point, H: Point>(
        a: Self::Scalar<F>,
        b: Self::Scalar<G>,
        cut: Cut,
    ) -> Self::Scalar<H>;

    /// a/b for b ≥ 0; the end of the range beyond it, 0 for 0/0.
    fn quotient<F: Point, G: Point, H: Point>(
        a: Self::Scalar<F>,
        b: Self::Scalar<G>,
    ) -> Self::Scalar<H>;

    /// Σ xᵢ·cᵢ, first to last, rounded once where the arithmetic has a range.
    fn sum_of_products<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(Self::Scalar<F>, Self::Scalar<G>); N],
        cut: Cut,
    ) -> Self::Scalar<H>;

    /// Four numbers side by side.
    fn four<F: Point>(numbers: &[Self::Scalar<F>; 4]) -> Self::Four<F>;

    /// The numbers of four.
    fn numbers<F: Point>(four: Self::Four<F>) -> [Self::Scalar<F>; 4];

    /// The first three of four, as a state keeps them.
    fn three<F: Point>(four: Self::Four<F>) -> Self::Three<F>;

    /// Three kept numbers and a fourth without meaning.
    fn four_of_three<F: Point>(three: Self::Three<F>) -> Self::Four<F>;

    /// The first three and a fourth without meaning: a zero where numbers have a range.
    fn first_three<F: Point>(a: Self::Four<F>) -> Self::Four<F>;

    /// The smaller of each two; none is NaN.
    fn four_min<F: Point>(a: Self::Four<F>, b: Self::Four<F>) -> Self::Four<F>;

    /// [`Arithmetic::product`] of each two.
    fn four_product<F: Point, G: Point, H: Point>(
        a: Self::Four<F>,
        b: Self::Four<G>,
        cut: Cut,
    ) -> Self::Four<H>;

    /// [`Arithmetic::sum_of_products`] in each lane.
    fn four_sum_of_products<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(Self::Four<F>, Self::Four<G>); N],
        cut: Cut,
    ) -> Self::Four<H>;

    /// Inner product of the first three.
    fn dot3<F: Point, G: Point, H: Point>(a: Self::Four<F>, b: Self::Four<G>) -> Self::Scalar<H>;

    /// Rounds what is next to nothing, so that no result is too small for the arithmetic: floats below
    /// 2²³ `grid` to whole multiples of `grid`, a power of two; floats up to 2⁴⁸ `grid` may change in
    /// their last bit. Fixed point has its own grid.
    fn settled<F: Point>(a: Self::Scalar<F>, grid: f32) -> Self::Scalar<F>;

    /// [`Arithmetic::settled`] of each.
    fn four_settled<F: Point>(a: Self::Four<F>, grid: f32) -> Self::Four<F>;

    /// Returns true if all four lanes are within ±`limit`; false for NaN.
    fn is_within<F: Point>(a: Self::Four<F>, limit: Self::Scalar<F>) -> bool;
}
