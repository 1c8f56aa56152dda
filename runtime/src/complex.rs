//! Four complex numbers side by side: the poles of a filter in parallel sections, or their state.

use crate::lanes::{F4, GRID};

/// Four complex numbers, one a pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Complex4 {
    pub(crate) re: F4,
    pub(crate) im: F4,
}

impl Complex4 {
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        Self {
            re: self.re * other.re - self.im * other.im,
            im: self.re * other.im + self.im * other.re,
        }
    }

    /// See [`Arithmetic::settled`](crate::arithmetic::Arithmetic::settled).
    #[inline(always)]
    pub(crate) fn settled(self) -> Self {
        Self {
            re: self.re.settled(GRID),
            im: self.im.settled(GRID),
        }
    }

    /// Output of a filter with these residues, from its state.
    #[inline(always)]
    pub(crate) fn response(self, residues: &Self) -> f32 {
        (self.re * residues.re - self.im * residues.im).sum()
    }
}
