//! Four complex numbers side by side: the poles of a filter in parallel sections, or their state.

use crate::lanes::F4;

/// Four complex numbers, one a pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Complex4 {
    pub(crate) re: F4,
    pub(crate) im: F4,
}

impl Complex4 {
    pub(crate) const ZERO: Self = Self {
        re: F4::ZERO,
        im: F4::ZERO,
    };

    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    #[inline(always)]
    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            re: self.re + other.re,
            im: self.im + other.im,
        }
    }

    #[inline(always)]
    pub(crate) fn scaled(self, by: f32) -> Self {
        Self {
            re: self.re * F4::splat(by),
            im: self.im * F4::splat(by),
        }
    }

    /// What a filter with these residues gives of a state.
    #[inline(always)]
    pub(crate) fn response(self, residues: &Self) -> f32 {
        (self.re * residues.re - self.im * residues.im).sum()
    }
}
