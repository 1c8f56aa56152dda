//! What a tick computes with: [`Float`], or [`Fixed`] point for processors without an FPU.
//!
//! [`Arithmetic`] is what every stage needs: a dozen operations on single numbers and on four
//! side by side. An operation that one stage alone needs is a small trait beside that stage, with
//! an implementation for each arithmetic; [`RenderArithmetic`](crate::RenderArithmetic) is all of
//! them together. A number here has a binary point but no unit: stages compute with
//! [quantities](crate::quantity).

pub(crate) mod fixed;
pub(crate) mod float;
mod operations;
mod reciprocal;
mod rounding;
mod scalar;

pub use self::{
    fixed::Fixed,
    float::Float,
    operations::{Arithmetic, Cut},
    scalar::{Point, Scalar, Zero},
};
pub(crate) use self::{fixed::Quad, reciprocal::reciprocal_root};
