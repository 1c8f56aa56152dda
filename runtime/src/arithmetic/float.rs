//! Floating point: `f32`, and registers of four.

use super::{
    operations::{Arithmetic, Cut},
    scalar::{Point, Scalar, Zero},
};
use crate::lanes::{F3, F4, settled};

/// IEEE 754 `f32`. Every operation rounds alike on every processor, and no two are fused.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Float;

impl Zero for f32 {
    const ZERO: Self = 0.0;
}

impl Zero for F4 {
    const ZERO: Self = Self::ZERO;
}

impl Zero for F3 {
    const ZERO: Self = Self::ZERO;
}

impl Scalar for f32 {
    const FARTHEST: Self = Self::INFINITY;
    const MISSING: Self = Self::NAN;

    #[inline(always)]
    fn of(value: f32) -> Self {
        value
    }

    #[inline(always)]
    fn value(self) -> f32 {
        self
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.to_bits()
    }

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self::from_bits(bits)
    }

    fn holds(value: f32) -> bool {
        !value.is_nan()
    }

    #[inline(always)]
    fn saturating_add(self, other: Self) -> Self {
        self + other
    }
}

impl Arithmetic for Float {
    type Scalar<F: Point> = f32;
    type Four<F: Point> = F4;
    type Three<F: Point> = F3;

    const IN_REGISTERS: bool = F4::IN_REGISTERS;

    #[inline(always)]
    fn whole<F: Point>(n: i32) -> f32 {
        n as f32
    }

    #[inline(always)]
    fn convert<F: Point, G: Point>(a: f32) -> f32 {
        a
    }

    #[inline(always)]
    fn product<F: Point, G: Point, H: Point>(a: f32, b: f32, _: Cut) -> f32 {
        a * b
    }

    #[inline(always)]
    fn quotient<F: Point, G: Point, H: Point>(a: f32, b: f32) -> f32 {
        a / b
    }

    #[inline(always)]
    fn sum_of_products<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(f32, f32); N],
        _: Cut,
    ) -> f32 {
        let (x, c) = terms[0];
        terms[1..].iter().fold(c * x, |sum, &(x, c)| sum + c * x)
    }

    #[inline(always)]
    fn four<F: Point>(numbers: &[f32; 4]) -> F4 {
        F4::load(numbers)
    }

    #[inline(always)]
    fn numbers<F: Point>(four: F4) -> [f32; 4] {
        four.to_array()
    }

    #[inline(always)]
    fn three<F: Point>(four: F4) -> F3 {
        F3::of(four)
    }

    #[inline(always)]
    fn four_of_three<F: Point>(three: F3) -> F4 {
        three.four()
    }

    #[inline(always)]
    fn first_three<F: Point>(a: F4) -> F4 {
        a
    }

    #[inline(always)]
    fn four_min<F: Point>(a: F4, b: F4) -> F4 {
        a.min(b)
    }

    #[inline(always)]
    fn four_product<F: Point, G: Point, H: Point>(a: F4, b: F4, _: Cut) -> F4 {
        a * b
    }

    #[inline(always)]
    fn four_sum_of_products<const N: usize, F: Point, G: Point, H: Point>(
        terms: [(F4, F4); N],
        _: Cut,
    ) -> F4 {
        let (x, c) = terms[0];
        terms[1..].iter().fold(c * x, |sum, &(x, c)| sum + c * x)
    }

    #[inline(always)]
    fn dot3<F: Point, G: Point, H: Point>(a: F4, b: F4) -> f32 {
        a.dot3(b)
    }

    #[inline(always)]
    fn settled<F: Point>(a: f32, grid: f32) -> f32 {
        settled(a, grid)
    }

    #[inline(always)]
    fn four_settled<F: Point>(a: F4, grid: f32) -> F4 {
        a.settled(grid)
    }

    #[inline(always)]
    fn is_within<F: Point>(a: F4, limit: f32) -> bool {
        a.is_within(limit)
    }
}
