//! What is mixed: the parameters that stand for a vertex's LSFs.

use crate::convert::{self, Row, stage};
use crate::design::{Design, Shape};
use crate::number::Number;
use crate::texture::Vertex;
use alloc::vec::Vec;
use asperity_formats::limits::MAX_ORDER;
use core::f64::consts::PI;

/// Of the poles and of the zeros.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parameters<P> {
    pub(crate) ar: Row<P>,
    pub(crate) ma: Row<P>,
}

/// Of a vertex whose LSFs are stored as the design says; `None` where two of them meet and
/// no filter has such parameters.
pub(crate) fn parameters<P: Number>(design: &Design, vertex: &Vertex<'_>) -> Option<Parameters<P>> {
    Some(Parameters {
        ar: row(design.shape, &stored(design, vertex.lsf_rad))?,
        // Zeros may lie on the circle, but not where a recursion ends.
        ma: row(design.shape, &apart(stored(design, vertex.ma_lsf_rad)))?,
    })
}

fn stored(design: &Design, lsf_rad: &[f64]) -> Vec<f64> {
    lsf_rad
        .iter()
        .map(|&omega| quantised(omega, design.lsf_bits))
        .collect()
}

/// A frequency as some bits hold it: steps of π/2ᵇ.
fn quantised(omega_rad: f64, bits: u32) -> f64 {
    if bits > 32 {
        return omega_rad;
    }
    let step = PI / (1_u64 << bits) as f64;
    let last = ((1_u64 << bits) - 1) as f64;
    libm::round(omega_rad / step).clamp(1.0, last) * step
}

/// Frequencies that rounding made one, a little apart.
fn apart(mut lsf_rad: Vec<f64>) -> Vec<f64> {
    let mut least = 0.0;
    for omega in &mut lsf_rad {
        *omega = omega.max(least);
        least = *omega + 1e-7;
    }
    lsf_rad
}

fn row<P: Number>(shape: Shape, lsf_rad: &[f64]) -> Option<Row<P>> {
    let order = lsf_rad.len();
    let staged = |value: fn(f64) -> f64| {
        let mut row = [0.0; MAX_ORDER];
        for (index, &omega) in lsf_rad.iter().enumerate() {
            row[stage(index, order)] = value(omega);
        }
        row
    };
    let coefficients = || convert::from_cosines(&staged(libm::cos), order);
    let exact = match shape {
        Shape::LsfOmega => staged(|omega| omega),
        Shape::LsfCosine => staged(libm::cos),
        Shape::Coefficients => coefficients(),
        Shape::Reflection | Shape::LogArea => {
            let reflection = convert::step_down(&coefficients(), order);
            if !reflection.iter().all(|k| k.abs() < 1.0) {
                return None;
            }
            if shape == Shape::Reflection {
                reflection
            } else {
                reflection.map(|k| libm::log((1.0 + k) / (1.0 - k)))
            }
        }
    };
    Some(exact.map(P::of))
}
