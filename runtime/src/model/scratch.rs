//! Memory for making a model: the search and the conversion use it in turn.

use super::row::LANES;
use crate::arithmetic::Scalar;
use asperity_formats::limits::MAX_ORDER;

/// Coefficients 1..=12 of symmetric polynomials of degree up to 24.
pub(crate) const ROWS: usize = MAX_ORDER / 2;

/// Bits of numbers. They are a [`Search`](super::barycentric::Search) until its mixture is made,
/// then the partial products of the conversion, which begins anew whatever stands here.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
pub(crate) struct Scratch(pub(crate) [[u32; LANES]; ROWS]);

impl Scratch {
    /// Nothing is under way.
    pub(crate) const IDLE: Self = Self([[0; LANES]; ROWS]);
}

/// The numbers of a row.
#[inline(always)]
pub(crate) fn numbers<S: Scalar>(row: &[u32; LANES]) -> [S; LANES] {
    row.map(S::from_bits)
}

/// The bits of a row.
#[inline(always)]
pub(crate) fn bits<S: Scalar>(row: [S; LANES]) -> [u32; LANES] {
    row.map(S::bits)
}
