//! Scalar of an arithmetic, as callers see it.

use core::{
    fmt::Debug,
    ops::{Add, Neg, Sub},
};
use fixed::types::extra::LeEqU32;

/// A binary point, as the number of fractional bits. Floats ignore it.
pub trait Point: LeEqU32 + Copy + Debug + Default + PartialEq + 'static {}

impl<P: LeEqU32 + Copy + Debug + Default + PartialEq + 'static> Point for P {}

/// A type with a zero.
pub trait Zero: Copy + Debug + PartialEq + 'static {
    /// Zero in every component.
    const ZERO: Self;
}

impl<X: Zero, const N: usize> Zero for [X; N] {
    const ZERO: Self = [X::ZERO; N];
}

impl Zero for u16 {
    const ZERO: Self = 0;
}

impl Zero for u8 {
    const ZERO: Self = 0;
}

/// A scalar: an `f32`, or a `FixedI32`.
pub trait Scalar:
    Zero + Default + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self>
{
    /// Larger than every number in use.
    const FARTHEST: Self;
    /// Stands for a coordinate that the device did not report.
    const MISSING: Self;

    /// The nearest number to `value`; the end of the range beyond it, 0 for NaN.
    fn of(value: f32) -> Self;

    /// Its value.
    fn value(self) -> f32;

    /// Its bits.
    fn bits(self) -> u32;

    /// The number of these bits.
    fn from_bits(bits: u32) -> Self;

    /// Returns true if `value` lies in the range.
    fn holds(value: f32) -> bool;

    /// The sum, or the end of the range beyond it.
    #[must_use]
    fn saturating_add(self, other: Self) -> Self;
}
