//! A mixture of three vertices.

use crate::{
    arithmetic::{Arithmetic, Float},
    quantity::{Quantity, unit::Fraction},
};

/// A convex mixture of three vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Barycentric<A: Arithmetic = Float> {
    /// Vertex indices.
    pub vertices: [u8; 3],
    /// Weights in [0, 1] that sum to 1 within rounding.
    pub weights: [Quantity<A, Fraction>; 3],
    /// True if the query lay outside the grid and was moved to its border.
    pub outside: bool,
}

impl<A: Arithmetic> Barycentric<A> {
    /// The weights as floats.
    #[must_use]
    pub fn values(&self) -> [f32; 3] {
        self.weights.map(Quantity::value)
    }
}
