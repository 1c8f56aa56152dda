//! Arithmetic in a fixed order: the same bits on every processor.
//!
//! Only `+ − × ÷ √` and comparisons of f32, which IEEE 754 defines, never a fused multiply–add.
//! What is compiled for several instruction sets runs its lanes across independent results,
//! so a wider set changes the time and not one bit.

pub(crate) mod lanes;
pub(crate) mod math;
pub(crate) mod product;
