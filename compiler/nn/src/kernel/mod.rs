//! Arithmetic in a fixed order: the same bits on every processor.
//!
//! The kernels use only `+ − × ÷ √` and comparisons of f32, which IEEE 754 defines, and no fused
//! multiply–add. Code that is compiled for several instruction sets vectorises across independent
//! results, so wider registers change the time and not a single bit.

pub(crate) mod lanes;
pub(crate) mod math;
pub(crate) mod product;
