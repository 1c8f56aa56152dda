//! The numerator of a model, times a filter.

use asperity::lsf;
use asperity::model::{GridVertex, ModelGrid, Numerator};
use asperity_formats::limits::MAX_ORDER;

/// A zero on the unit circle is moved to this radius, because its frequencies would coincide.
const RADIUS: f64 = 0.999;

/// Order that a filter may add to the numerators of a grid.
pub(super) fn room(grid: &ModelGrid) -> usize {
    let orders = grid
        .vertices
        .iter()
        .map(|vertex| order(grid.numerator, vertex));
    MAX_ORDER.saturating_sub(orders.max().unwrap_or(0))
}

fn order(numerator: Numerator, vertex: &GridVertex) -> usize {
    match numerator {
        Numerator::None => 0,
        Numerator::Nyquist => 1,
        Numerator::Lsf => vertex.ma_lsf_rad.as_ref().map_or(0, Vec::len),
    }
}

/// B(z) of a vertex, 1 first.
pub(super) fn of(numerator: Numerator, vertex: &GridVertex) -> Vec<f64> {
    match numerator {
        Numerator::None => vec![1.0],
        Numerator::Nyquist => vec![1.0, 1.0],
        Numerator::Lsf => lsf::to_polynomial(vertex.ma_lsf_rad.as_deref().unwrap_or_default()),
    }
}

/// The product of two polynomials.
pub(super) fn product(b: &[f64], c: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; b.len() + c.len() - 1];
    for (i, b) in b.iter().enumerate() {
        for (j, c) in c.iter().enumerate() {
            product[i + j] += b * c;
        }
    }
    product
}

/// Line spectral frequencies of a polynomial whose zeros lie within the unit circle or on it.
pub(super) fn frequencies(monic: &[f64]) -> Option<Vec<f64>> {
    lsf::from_polynomial(monic).or_else(|| {
        let inwards = monic.iter().enumerate();
        let moved: Vec<f64> = inwards.map(|(k, b)| b * RADIUS.powi(k as i32)).collect();
        lsf::from_polynomial(&moved)
    })
}
