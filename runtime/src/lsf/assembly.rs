//! Coefficients of A(z) and B(z) from the finished products.
//!
//! a_k = (q_k + p_k)/2 and, by symmetry, a_{p+1−k} = (q_k − p_k)/2, where Q = sum·(1 + z⁻¹)
//! and P = difference·(1 − z⁻¹) for even orders, Q = sum and P = difference·(1 − z⁻²)
//! for odd ones. The products carry the ½.

use super::{LANES, Products, Shape, product::COEFFICIENTS};
use crate::{
    arithmetic::{Arithmetic, Four, Zero as _, units::Coefficient},
    synthesis::Line,
};

impl Shape {
    /// Coefficients of A(z).
    #[inline]
    pub(crate) fn ar<A: Arithmetic>(&self, products: &Products<A>, a: &mut Line<A>) {
        assemble::<A, 0>(&products.0, self.ar_order(), a);
    }

    /// Coefficients of B(z).
    #[inline]
    pub(crate) fn ma<A: Arithmetic>(&self, products: &Products<A>, b: &mut Line<A>) {
        assemble::<A, 2>(&products.0, self.ma_order(), b);
    }
}

/// Coefficients of the polynomial whose lanes begin at `LANE`.
#[inline(always)]
fn assemble<A: Arithmetic, const LANE: usize>(
    c: &[[A::Scalar<Coefficient>; LANES]; COEFFICIENTS],
    order: usize,
    a: &mut Line<A>,
) {
    let half = order / 2;
    let Some(a) = a.0.as_flattened_mut().get_mut(..order) else {
        return;
    };
    if order.is_multiple_of(2) && half >= LANES {
        // The last four overlap those before where four does not divide the half.
        let last = half - LANES;
        for first in (0..last).step_by(LANES) {
            assemble_four::<A, LANE>(c, first, a);
        }
        assemble_four::<A, LANE>(c, last, a);
    } else {
        assemble_singly::<A, LANE>(c, a);
    }
}

/// Four coefficients from `first` on and their four mirror images, of an even order.
#[inline(always)]
fn assemble_four<A: Arithmetic, const LANE: usize>(
    c: &[[A::Scalar<Coefficient>; LANES]; COEFFICIENTS],
    first: usize,
    a: &mut [A::Scalar<Coefficient>],
) {
    let last = a.len() - first;
    let Some(c) = c.get(first..).and_then(|c| c.first_chunk::<5>()) else {
        return;
    };
    let [c0, c1, c2, c3, c4] = c.each_ref().map(Four::<A, Coefficient>::load);
    let t0 = (c1 + c0.alternating()).to_array();
    let t1 = (c2 + c1.alternating()).to_array();
    let t2 = (c3 + c2.alternating()).to_array();
    let t3 = (c4 + c3.alternating()).to_array();
    let across =
        |lane: usize| Four::<A, Coefficient>::load(&[t0[lane], t1[lane], t2[lane], t3[lane]]);
    let (q, p) = (across(LANE), across(LANE + 1));
    if let Some(place) = a.get_mut(first..first + LANES) {
        place.copy_from_slice(&(q + p).to_array());
    }
    if let Some(place) = a.get_mut(last - LANES..last) {
        let [a0, a1, a2, a3] = (q - p).to_array();
        place.copy_from_slice(&[a3, a2, a1, a0]);
    }
}

/// The same for every order, one after the other.
fn assemble_singly<A: Arithmetic, const LANE: usize>(
    c: &[[A::Scalar<Coefficient>; LANES]; COEFFICIENTS],
    a: &mut [A::Scalar<Coefficient>],
) {
    let order = a.len();
    let even = order.is_multiple_of(2);
    let number = |k: usize, lane: usize| c.get(k).map_or(A::Scalar::ZERO, |c| c[lane]);
    for k in 0..order / 2 {
        let (q, p) = (number(k + 1, LANE), number(k + 1, LANE + 1));
        let (q, p) = if even {
            (q + number(k, LANE), p - number(k, LANE + 1))
        } else {
            (q, p - number(k.wrapping_sub(1), LANE + 1))
        };
        if let Some(low) = a.get_mut(k) {
            *low = q + p;
        }
        if let Some(high) = a.get_mut(order - 1 - k) {
            *high = q - p;
        }
    }
    if !even && let Some(middle) = a.get_mut(order / 2) {
        *middle = number(order / 2 + 1, LANE);
    }
}
