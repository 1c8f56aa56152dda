//! Against what was measured: every interior model predicted from the others.
//!
//! A measured model is taken out with all its copies; the others, and the silent models on
//! the axes v = 0 and F = 0, are triangulated anew, and the gap is filled by each
//! interpolation. Where a corner of the triangle is silent the level is predicted *towards
//! rest*, else *inside*. A model outside the triangles is predicted from the nearest point
//! of their border as an edge model would be, its level raised by powers of speed and force.

mod locate;
mod method;
mod predict;
mod summary;

pub use method::{Exponents, Method, Prediction, Region};
pub use predict::{exponents, predictions};
pub use summary::{MethodSummary, summaries};
