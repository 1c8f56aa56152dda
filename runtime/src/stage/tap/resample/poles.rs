//! The filter's poles, and its states for as many traces as a register has lanes.

use crate::{
    complex::Complex4,
    lanes::{F4, GRID, settled},
};
use core::ops::{Add, Mul, Sub};

/// `N` numbers side by side, one a trace.
pub(crate) trait Lanes<const N: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    fn splat(number: f32) -> Self;

    fn load(numbers: &[f32; N]) -> Self;

    fn to_array(self) -> [f32; N];

    /// See [`Arithmetic::settled`](crate::arithmetic::Arithmetic::settled).
    fn settled(self) -> Self;
}

impl Lanes<4> for F4 {
    #[inline(always)]
    fn splat(number: f32) -> Self {
        Self::splat(number)
    }

    #[inline(always)]
    fn load(numbers: &[f32; 4]) -> Self {
        Self::load(numbers)
    }

    #[inline(always)]
    fn to_array(self) -> [f32; 4] {
        self.to_array()
    }

    #[inline(always)]
    fn settled(self) -> Self {
        self.settled(GRID)
    }
}

/// For processors without registers of four: the state of one trace leaves room on a small stack.
impl Lanes<1> for f32 {
    #[inline(always)]
    fn splat(number: f32) -> Self {
        number
    }

    #[inline(always)]
    fn load(&[number]: &[f32; 1]) -> Self {
        number
    }

    #[inline(always)]
    fn to_array(self) -> [f32; 1] {
        [self]
    }

    #[inline(always)]
    fn settled(self) -> Self {
        settled(self, GRID)
    }
}

const PARTS: usize = 7;

/// The filter's state for each of `N` traces: one complex number a pole, the last of which is real.
/// Four real parts come first, then three imaginary ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct Poles<L, const N: usize>([L; PARTS]);

impl<L: Lanes<N>, const N: usize> Poles<L, N> {
    pub(super) fn zero() -> Self {
        Self([L::splat(0.0); PARTS])
    }

    /// The same factors for every trace: widened where they are used, because they would take `N`
    /// times the stack.
    #[inline(always)]
    fn widened(factors: &Complex4) -> [L; PARTS] {
        let ([a, b, c, d], [e, f, g, _]) = (factors.re.to_array(), factors.im.to_array());
        [
            L::splat(a),
            L::splat(b),
            L::splat(c),
            L::splat(d),
            L::splat(e),
            L::splat(f),
            L::splat(g),
        ]
    }

    /// Each number times its factor.
    #[inline(always)]
    pub(super) fn times(&self, factors: &Complex4) -> Self {
        let ([a, b, c, d, e, f, g], [p, q, r, s, t, u, v]) = (self.0, Self::widened(factors));
        Self([
            a * p - e * t,
            b * q - f * u,
            c * r - g * v,
            d * s,
            a * t + e * p,
            b * u + f * q,
            c * v + g * r,
        ])
    }

    /// Rounds what is next to nothing, in place, which takes no stack.
    #[inline(always)]
    pub(super) fn settle(&mut self) {
        for number in &mut self.0 {
            *number = number.settled();
        }
    }

    /// Adds a sample of each trace, decayed by `left`.
    #[inline(always)]
    pub(super) fn add(&mut self, sample: L, left: &Complex4) {
        let left = Self::widened(left);
        for (sum, left) in self.0.iter_mut().zip(left) {
            *sum = *sum + left * sample;
        }
    }

    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        for (sum, other) in sum.0.iter_mut().zip(other.0) {
            *sum = *sum + other;
        }
        sum
    }

    /// Output of the filter with these residues.
    #[inline(always)]
    pub(super) fn response(&self, residues: &Complex4) -> L {
        let ([a, b, c, d, e, f, g], [p, q, r, s, t, u, v]) = (self.0, Self::widened(residues));
        ((a * p - e * t) + (b * q - f * u)) + ((c * r - g * v) + d * s)
    }
}
