//! Orders of A(z) and B(z), and what follows from them.

use super::row::LANES;
use crate::arithmetic::Arithmetic;

/// Orders of A(z) and B(z), each at most [`MAX_ORDER`](asperity_formats::limits::MAX_ORDER).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Orders {
    ar: u8,
    ma: u8,
    /// Second-order sections of each polynomial: Q and P of A(z), Q and P of B(z).
    pub(super) sections: [u8; LANES],
    /// The smallest number of sections of a polynomial in use.
    pub(super) fewest: u8,
}

impl Orders {
    /// The orders of a slot that was never loaded.
    pub(crate) const NONE: Self = Self {
        ar: 0,
        ma: 0,
        sections: [0; LANES],
        fewest: 0,
    };

    /// From the orders of A(z) and B(z).
    pub(crate) const fn new(ar: usize, ma: usize) -> Self {
        let (ar, ma) = (ar as u8, ma as u8);
        let shorter = if ma == 0 || ar < ma { ar } else { ma };
        Self {
            ar,
            ma,
            sections: [ar.div_ceil(2), ar / 2, ma.div_ceil(2), ma / 2],
            fewest: shorter / 2,
        }
    }

    /// Order of A(z).
    #[inline(always)]
    pub(crate) const fn ar(&self) -> usize {
        self.ar as usize
    }

    /// Order of B(z).
    #[inline(always)]
    pub(crate) const fn ma(&self) -> usize {
        self.ma as usize
    }

    /// Section pairs of the longest polynomial.
    pub(crate) const fn section_pairs(&self) -> usize {
        let longer = if self.ar > self.ma { self.ar } else { self.ma };
        longer.div_ceil(4) as usize
    }

    /// Parts in which a section pair is multiplied in: A(z) and B(z) at once where registers hold
    /// four numbers, else one after the other.
    #[inline(always)]
    pub(crate) const fn parts<A: Arithmetic>(&self) -> usize {
        if A::IN_REGISTERS {
            1
        } else {
            self.parts_one_by_one()
        }
    }

    /// [`Orders::parts`] without such registers.
    #[inline(always)]
    pub(crate) const fn parts_one_by_one(&self) -> usize {
        if self.ma == 0 { 1 } else { 2 }
    }
}
