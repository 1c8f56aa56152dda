//! Barycentric weights: which triangle of the speed–force grid a query falls into.
//!
//! Triangles stand in blocks of four neighbours. Each axis is cut into strips, and each strip
//! knows the blocks that it meets: those that both strips of a query meet are looked at, from that
//! of the triangle found last on, until one has a triangle with the query in it. There is no path
//! to walk, so nothing can hang on an edge. On a shared edge or vertex either neighbour wins and
//! both give the same mixture; where the triangles leave a gap, the one whose smallest barycentric
//! weight is largest wins, where they overlap, the first. Weights below zero are cut, so the
//! mixture is convex whatever the query.
//!
//! Outside the measured range the query is moved to the nearest point of the border
//! (edge model): constant extrapolation, continuous with the inside.
//! An [`Extent`](super::edge::Extent) first moves a query into the grid.

mod grid;
mod order;
mod search;
mod strips;
mod triangle;
mod weight;
mod weights;

pub(crate) use self::{grid::Grid, search::Search};
pub use self::{weight::WeightSearch, weights::Barycentric};
