//! In what a renderer computes.

use asperity_runtime::{Float, RenderArithmetic};

/// `AsperityConfig::arithmetic`: floats, which need an FPU to be fast.
pub const ASPERITY_ARITHMETIC_FLOAT: u32 = 0;
/// `AsperityConfig::arithmetic`: fixed point, for processors without an FPU. Samples and outputs
/// stay floats, which are converted.
pub const ASPERITY_ARITHMETIC_FIXED: u32 = 1;

/// An arithmetic that C can name.
pub(crate) trait Numbered: RenderArithmetic + 'static {
    /// Its number.
    const NUMBER: u32;
}

impl Numbered for Float {
    const NUMBER: u32 = ASPERITY_ARITHMETIC_FLOAT;
}

#[cfg(feature = "fixed")]
impl Numbered for asperity_runtime::Fixed {
    const NUMBER: u32 = ASPERITY_ARITHMETIC_FIXED;
}

/// Evaluates `$body` with `$A` as the arithmetic of a number, or `$none` where the library has no
/// such arithmetic.
macro_rules! by_arithmetic {
    ($number:expr, $A:ident => $body:expr, else $none:expr) => {
        match $number {
            $crate::arithmetic::ASPERITY_ARITHMETIC_FLOAT => {
                type $A = asperity_runtime::Float;
                $body
            }
            #[cfg(feature = "fixed")]
            $crate::arithmetic::ASPERITY_ARITHMETIC_FIXED => {
                type $A = asperity_runtime::Fixed;
                $body
            }
            _ => Err($none.into()),
        }
    };
}
pub(crate) use by_arithmetic;
