//! Memory of a cycle of the parameters: location and conversion have it in turn.

use crate::arithmetic::Scalar;
use asperity_formats::limits::MAX_ORDER;

/// Numbers side by side.
pub(crate) const LANES: usize = 4;
/// Coefficients 1..=12 of symmetric polynomials of degree up to 24.
pub(crate) const ROWS: usize = MAX_ORDER / 2;

/// Bits of numbers: of the [`Search`](crate::locate::Search) until the mixture is made, then of
/// the products of conversion. Whatever stands here, a conversion begins anew.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
pub(crate) struct Workspace(pub(crate) [[u32; LANES]; ROWS]);

impl Workspace {
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
