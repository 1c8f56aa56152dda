//! Barycentric weights: which triangle of the speed–force grid a query falls into.
//!
//! Triangles stand in blocks of four neighbours. Each axis is cut into strips, and each strip knows
//! the blocks that it meets. A search looks at the blocks that both strips of the query meet,
//! beginning with the block of the last triangle found, until a triangle contains the query. There
//! is no path to walk, so nothing can hang on an edge. On a shared edge or vertex either neighbour
//! wins, and both give the same mixture. Where the triangles leave a gap, the triangle whose
//! smallest barycentric weight is largest wins; where they overlap, the first one. Weights below
//! zero are cut, so the mixture is convex whatever the query.
//!
//! An [`Extent`](super::edge::Extent) first moves a query outside the measured range to the nearest
//! point of the border.

mod grid;
mod order;
mod search;
mod strips;
mod triangle;
mod weight;
mod weights;

pub(crate) use self::{grid::Grid, search::Search};
pub use self::{weight::WeightSearch, weights::Barycentric};
