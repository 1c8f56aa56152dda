//! Prediction of held-out measured models by interpolation.
//!
//! Every interior model is taken out in turn, with all its copies. The other models and the silent ones on the axes
//! v = 0 and F = 0 are triangulated anew, and each interpolation predicts the missing model. Its region is *towards
//! rest* where a corner of its triangle is silent, and *inside* elsewhere. A model outside the triangles lies *beyond*:
//! it is predicted like an edge model, from the nearest point of their border, with its level raised by powers of speed
//! and force.

mod method;
mod predict;
mod summary;

pub use method::{Exponents, Method, Prediction, Region};
pub use predict::{exponents, predictions};
pub use summary::{MethodSummary, summaries};
