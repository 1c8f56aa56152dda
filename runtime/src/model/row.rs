//! Up to 24 numbers of a model, in blocks of four.

use crate::{
    arithmetic::{Arithmetic, Float, Zero as _},
    quantity::{
        Raw,
        unit::{Coefficient, Unit},
    },
};
use asperity_formats::limits::MAX_ORDER;

/// Numbers of a block.
pub(crate) const LANES: usize = 4;
/// Blocks of the longest row.
pub(crate) const BLOCKS: usize = MAX_ORDER / LANES;

/// Numbers of up to 24 lags, from lag 1 on, zeros behind the last.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(not(target_arch = "arm"), repr(align(16)))]
pub(crate) struct PaddedRow<A: Arithmetic = Float, U: Unit = Coefficient>(
    pub(crate) [[Raw<A, U>; LANES]; BLOCKS],
);

impl<A: Arithmetic, U: Unit> PaddedRow<A, U> {
    /// All zero.
    pub(crate) const ZERO: Self = Self([[A::Scalar::ZERO; LANES]; BLOCKS]);

    /// All 24 numbers.
    #[must_use]
    pub(crate) fn to_array(self) -> [Raw<A, U>; MAX_ORDER] {
        let mut all = [A::Scalar::ZERO; MAX_ORDER];
        all.copy_from_slice(self.0.as_flattened());
        all
    }
}
