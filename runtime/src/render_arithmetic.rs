//! An arithmetic with everything that the stages of a tick need.

use crate::{
    arithmetic::{Fixed, Float},
    model::{barycentric::WeightSearch, mixture::RowMixture, section_pair::SectionProduct},
    range::Checked,
    stage::{
        excitation::GaussianCubic, friction_law::FactorLookup, limiter::Shortening,
        recursion::InnerProduct, sample_gate::Positions, velocity::Differences, wall::Pushing,
    },
};

/// [`Arithmetic`](crate::Arithmetic) and the traits beside the stages: [`Float`] or [`Fixed`].
pub trait RenderArithmetic:
    Checked
    + Positions
    + Differences
    + WeightSearch
    + RowMixture
    + SectionProduct
    + GaussianCubic
    + InnerProduct
    + Shortening
    + Pushing
    + FactorLookup
{
}

impl RenderArithmetic for Float {}
impl RenderArithmetic for Fixed {}
