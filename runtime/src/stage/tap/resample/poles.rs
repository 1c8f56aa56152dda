//! The filter's poles, and its states for as many traces as a register has lanes.

use crate::{complex::Complex4, lanes::F4};
use core::ops::{Add, Mul, Sub};

/// `N` numbers side by side, one a trace.
pub(crate) trait Lanes<const N: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    fn splat(number: f32) -> Self;

    fn load(numbers: &[f32; N]) -> Self;

    fn to_array(self) -> [f32; N];
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
}

/// One complex number a pole, the last of which is real: four real parts, then three imaginary ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct Poles<L, const N: usize>([L; PARTS]);

const PARTS: usize = 7;

impl<L: Lanes<N>, const N: usize> Poles<L, N> {
    /// The same numbers for every trace.
    pub(super) fn new(numbers: Complex4) -> Self {
        let [[a, b, c, d], [e, f, g, _]] = [numbers.re, numbers.im].map(F4::to_array);
        Self([a, b, c, d, e, f, g].map(L::splat))
    }

    pub(super) fn zero() -> Self {
        Self([L::splat(0.0); PARTS])
    }

    /// Each number times its factor.
    #[inline(always)]
    pub(super) fn times(&self, factors: &Self) -> Self {
        let ([a, b, c, d, e, f, g], [p, q, r, s, t, u, v]) = (self.0, factors.0);
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

    /// Adds a sample of each trace, decayed by `left`.
    #[inline(always)]
    pub(super) fn add(&mut self, sample: L, left: &Self) {
        for part in 0..PARTS {
            self.0[part] = self.0[part] + left.0[part] * sample;
        }
    }

    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut sum = *self;
        for part in 0..PARTS {
            sum.0[part] = sum.0[part] + other.0[part];
        }
        sum
    }

    /// Output of the filter with these residues.
    #[inline(always)]
    pub(super) fn response(&self, residues: &Self) -> L {
        let ([a, b, c, d, e, f, g], [p, q, r, s, t, u, v]) = (self.0, residues.0);
        ((a * p - e * t) + (b * q - f * u)) + ((c * r - g * v) + d * s)
    }
}
