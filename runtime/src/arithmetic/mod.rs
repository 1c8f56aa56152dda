//! Arithmetic of a tick: [`Float`], or [`Fixed`] point for processors without an FPU.
//!
//! [`Arithmetic`] holds what every stage needs: a dozen scalar operations and their four-lane
//! counterparts. An operation of a single stage is a small trait beside that stage, implemented for
//! each arithmetic; [`RenderArithmetic`](crate::RenderArithmetic) is the union of them. A number
//! here has a binary point but no unit: stages compute with [quantities](crate::quantity).

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
