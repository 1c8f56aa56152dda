//! The parameters that are mixed: from a vertex's LSFs, and on to coefficients.

use crate::convert::{self, OrderArray, stage};
use crate::design::{Design, Shape};
use crate::number::Number;
use crate::texture::Vertex;
use alloc::vec::Vec;
use asperity_formats::limits::MAX_ORDER;
use core::f64::consts::PI;

/// Parameters of the poles and of the zeros.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parameters<P> {
    /// Parameters of the poles.
    pub(crate) ar: OrderArray<P>,
    /// Parameters of the zeros.
    pub(crate) ma: OrderArray<P>,
}

/// Parameters of a vertex whose LSFs are stored as the design says; `None` where two LSFs
/// coincide and no filter has such parameters.
pub(crate) fn parameters<P: Number>(design: &Design, vertex: &Vertex<'_>) -> Option<Parameters<P>> {
    Some(Parameters {
        ar: row(design.shape, &stored(design, vertex.lsf_rad))?,
        // Zeros may lie on the circle, but a step-down through one would divide by zero.
        ma: row(design.shape, &apart(stored(design, vertex.ma_lsf_rad)))?,
    })
}

fn stored(design: &Design, lsf_rad: &[f64]) -> Vec<f64> {
    lsf_rad
        .iter()
        .map(|&omega| quantised(omega, design.lsf_bits))
        .collect()
}

/// A frequency rounded to `bits` bits, in steps of π/2ᵇ.
fn quantised(omega_rad: f64, bits: u32) -> f64 {
    if bits > 32 {
        return omega_rad;
    }
    let step = PI / (1_u64 << bits) as f64;
    let last = ((1_u64 << bits) - 1) as f64;
    libm::round(omega_rad / step).clamp(1.0, last) * step
}

/// Moves apart by 1e-7 rad frequencies that rounding made equal.
fn apart(mut lsf_rad: Vec<f64>) -> Vec<f64> {
    let mut least = 0.0;
    for omega in &mut lsf_rad {
        *omega = omega.max(least);
        least = *omega + 1e-7;
    }
    lsf_rad
}

fn row<P: Number>(shape: Shape, lsf_rad: &[f64]) -> Option<OrderArray<P>> {
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

/// Cosines of the LSFs, from LSFs or their cosines.
#[inline]
pub(crate) fn cosines<P: Number>(
    shape: Shape,
    mixed: &OrderArray<P>,
    order: usize,
) -> OrderArray<P> {
    let mut row = *mixed;
    if shape == Shape::LsfOmega {
        for x in row.iter_mut().take(order) {
            *x = convert::cosine(*x);
        }
    }
    row
}

/// Coefficients 1..=p of A(z) from mixed parameters.
#[inline]
pub(crate) fn coefficients<P: Number>(
    shape: Shape,
    mixed: &OrderArray<P>,
    order: usize,
) -> OrderArray<P> {
    match shape {
        Shape::Coefficients => *mixed,
        Shape::LsfOmega | Shape::LsfCosine => {
            convert::from_cosines(&cosines(shape, mixed, order), order)
        }
        Shape::Reflection | Shape::LogArea => {
            convert::step_up(&reflections(shape, mixed, order), order)
        }
    }
}

/// Reflection coefficients of A(z) from mixed parameters.
#[inline]
pub(crate) fn reflections<P: Number>(
    shape: Shape,
    mixed: &OrderArray<P>,
    order: usize,
) -> OrderArray<P> {
    match shape {
        Shape::Reflection => *mixed,
        Shape::LogArea => {
            let mut row = *mixed;
            for x in row.iter_mut().take(order) {
                *x = convert::from_log_area(*x);
            }
            row
        }
        Shape::Coefficients | Shape::LsfOmega | Shape::LsfCosine => {
            convert::step_down(&coefficients(shape, mixed, order), order)
        }
    }
}
