//! Coefficients of a structure, after conversion.

use crate::convert::OrderArray;
use crate::number::Number;
use asperity_formats::limits::MAX_ORDER;

/// Coefficients with which a structure computes a sample.
#[derive(Debug, Clone)]
pub(crate) struct Coefficients<S> {
    /// Coefficients of A(z), its cosines or its reflection coefficients.
    pub(crate) ar: OrderArray<S>,
    /// √(1 − k²), for the normalised lattice.
    pub(crate) complement: OrderArray<S>,
    /// Coefficients of B(z), or its cosines.
    pub(crate) ma: OrderArray<S>,
    /// Gain on the excitation of the normalised lattice: Π 1/√(1 − k²).
    pub(crate) gain: S,
}

impl<S: Number> Coefficients<S> {
    /// Zeros, and a gain of 1.
    pub(crate) fn zero() -> Self {
        Self {
            ar: [S::ZERO; MAX_ORDER],
            complement: [S::ZERO; MAX_ORDER],
            ma: [S::ZERO; MAX_ORDER],
            gain: S::of(1.0),
        }
    }

    /// The set that lies at `fraction` of the way from one to another.
    pub(crate) fn between(from: &Self, to: &Self, fraction: S, lanes: (usize, usize)) -> Self {
        let mix = |x: &OrderArray<S>, y: &OrderArray<S>, used: usize| {
            let mut row = [S::ZERO; MAX_ORDER];
            for ((row, x), y) in row.iter_mut().zip(x).zip(y).take(used) {
                *row = x.plus(fraction.times(y.minus(*x)));
            }
            row
        };
        Self {
            ar: mix(&from.ar, &to.ar, lanes.0),
            complement: mix(&from.complement, &to.complement, lanes.0),
            ma: mix(&from.ma, &to.ma, lanes.1),
            gain: from.gain.plus(fraction.times(to.gain.minus(from.gain))),
        }
    }
}
