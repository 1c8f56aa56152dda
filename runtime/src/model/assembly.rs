//! Coefficients of A(z) and B(z) from the finished products.
//!
//! a_k = (q_k + p_k)/2 and, by symmetry, a_{p+1−k} = (q_k − p_k)/2, where Q = sum·(1 + z⁻¹)
//! and P = difference·(1 − z⁻¹) for even orders, Q = sum and P = difference·(1 − z⁻²)
//! for odd ones. The products carry the ½.

use super::{
    orders::Orders,
    row::{LANES, PaddedRow},
    scratch::{Scratch, numbers},
    section_pair::SectionProduct,
};
use crate::{
    arithmetic::{Scalar as _, Zero as _},
    quantity::{Four, Quantity, Raw, unit::Coefficient},
};

/// Coefficients of A(z).
#[inline]
pub(crate) fn ar<A: SectionProduct>(orders: &Orders, products: &Scratch, a: &mut PaddedRow<A>) {
    assemble::<A, 0>(products, orders.ar(), a);
}

/// Coefficients of B(z).
#[inline]
pub(crate) fn ma<A: SectionProduct>(orders: &Orders, products: &Scratch, b: &mut PaddedRow<A>) {
    assemble::<A, 2>(products, orders.ma(), b);
}

/// Coefficients of the polynomial whose lanes begin at `LANE`.
#[inline(always)]
fn assemble<A: SectionProduct, const LANE: usize>(
    products: &Scratch,
    order: usize,
    a: &mut PaddedRow<A>,
) {
    let half = order / 2;
    let Some(a) = a.0.as_flattened_mut().get_mut(..order) else {
        return;
    };
    if order.is_multiple_of(2) && half >= LANES {
        let (last, mut before) = (half - LANES, Four::splat(Quantity(A::ONE_HALF)));
        for first in (0..last).step_by(LANES) {
            before = assemble_four::<A, LANE>(products, first, before, a);
        }
        // Where four does not divide the half, the last four overlap the four before them.
        if let Some(row) = last.checked_sub(1).and_then(|row| products.0.get(row)) {
            before = Four::load(&numbers(row));
        }
        assemble_four::<A, LANE>(products, last, before, a);
    } else {
        assemble_singly::<A, LANE>(products, a);
    }
}

/// Four coefficients from `first` on and their four mirror images, of an even order; `c0` has the
/// products before them. Returns the products before the next four.
#[inline(always)]
fn assemble_four<A: SectionProduct, const LANE: usize>(
    products: &Scratch,
    first: usize,
    c0: Four<A, Coefficient>,
    a: &mut [Raw<A, Coefficient>],
) -> Four<A, Coefficient> {
    let last = a.len() - first;
    let Some(c) = products.0.get(first..).and_then(|c| c.first_chunk::<4>()) else {
        return c0;
    };
    let [c1, c2, c3, c4] = c
        .each_ref()
        .map(|row| Four::<A, Coefficient>::load(&numbers(row)));
    let alternating = |c: Four<A, Coefficient>| Four::<A, Coefficient>(A::alternating(c.0));
    let t0 = (c1 + alternating(c0)).to_array();
    let t1 = (c2 + alternating(c1)).to_array();
    let t2 = (c3 + alternating(c2)).to_array();
    let t3 = (c4 + alternating(c3)).to_array();
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
    c4
}

/// The coefficients of any order, one pair after the other.
fn assemble_singly<A: SectionProduct, const LANE: usize>(
    products: &Scratch,
    a: &mut [Raw<A, Coefficient>],
) {
    let order = a.len();
    let even = order.is_multiple_of(2);
    let number = |k: usize, lane: usize| match k.checked_sub(1) {
        None => A::ONE_HALF,
        Some(row) => {
            let row = products.0.get(row);
            row.map_or(A::Scalar::ZERO, |row| A::Scalar::from_bits(row[lane]))
        }
    };
    for k in 0..order / 2 {
        let (q, p) = (number(k + 1, LANE), number(k + 1, LANE + 1));
        let (q, p) = if even {
            (q + number(k, LANE), p - number(k, LANE + 1))
        } else {
            (q, k.checked_sub(1).map_or(p, |k| p - number(k, LANE + 1)))
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
