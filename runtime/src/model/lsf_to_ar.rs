//! Line spectral frequencies, kept as −2 cos ω, to direct-form coefficients.
//!
//! For A(z) = 1 + Σ a_k z⁻ᵏ of order p, the sum polynomial Q(z) = A(z) + z⁻⁽ᵖ⁺¹⁾A(z⁻¹)
//! and the difference polynomial P(z) = A(z) − z⁻⁽ᵖ⁺¹⁾A(z⁻¹) have their zeros on the
//! unit circle, alternating; the first belongs to Q. Hence A = (P + Q)/2. A convex
//! mixture of ordered frequencies is ordered, in ω and in cos ω, so its A(z) is
//! stable; in cos ω it needs no trigonometry.
//!
//! Each frequency is a second-order section 1 + m z⁻¹ + z⁻², m = −2 cos ω, of its polynomial.
//! Sections come low and high in turn ([`place`]): partial products of neighbouring zeros grow
//! large and cancel later, which in f32 costs up to 0.4 dB on real models; this order costs less
//! than 0.001 dB. A low section and a high one, a section pair, are multiplied in at once, Q and P
//! of A(z) and B(z) side by side. [`super::partial_products`] multiplies one pair in,
//! [`super::assembly`] turns the finished products into coefficients.

use super::{
    orders::Orders,
    partial_products::{Lane, Polynomial as _, Products},
    row::{LANES, PaddedRow},
    scratch::Scratch,
    section_pair::SectionProduct,
};
use crate::{
    arithmetic::Arithmetic,
    quantity::{Four, Quantity, unit::LineCosine},
};

/// −2 cos ω of the LSFs of a mixture, in the order of [`place`], 0 beyond the order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LineSpectrum<A: Arithmetic> {
    /// The line spectrum of A(z).
    pub(crate) ar: PaddedRow<A, LineCosine>,
    /// The line spectrum of B(z).
    pub(crate) ma: PaddedRow<A, LineCosine>,
}

impl<A: Arithmetic> LineSpectrum<A> {
    /// The line spectrum before the first mixture.
    pub(crate) const ZERO: Self = Self {
        ar: PaddedRow::ZERO,
        ma: PaddedRow::ZERO,
    };
}

impl<A: SectionProduct> LineSpectrum<A> {
    /// Multiplies one part of a section pair into the products, in the order of pairs.
    #[inline(always)]
    pub(crate) fn multiply(&self, orders: &Orders, scratch: &mut Scratch, part: usize) {
        let parts = orders.parts::<A>();
        let (pair, part) = (part / parts, part % parts);
        if A::IN_REGISTERS {
            let (Some(ar), Some(ma)) = (self.ar.0.get(pair), self.ma.0.get(pair)) else {
                return;
            };
            let low = Four::<A, LineCosine>::load(&[ar[0], ar[1], ma[0], ma[1]]);
            let high = Four::<A, LineCosine>::load(&[ar[2], ar[3], ma[2], ma[3]]);
            let mut products = Products::<A>::of(scratch);
            products.multiply(pair, [low, high], orders.sections, orders.fewest);
            return;
        }
        let row = if part == 0 { &self.ar } else { &self.ma };
        let Some(row) = row.0.get(pair) else {
            return;
        };
        for side in 0..2 {
            let cosines = [Quantity(row[side]), Quantity(row[side + 2])];
            let polynomial = (2 * part + side) % LANES;
            if let Some(mut lane) = Lane::<A>::of(scratch, polynomial) {
                let sections = orders.sections[polynomial];
                lane.multiply(pair, cosines, sections, sections);
            }
        }
    }
}

/// Where −2 cos ω of LSF `index` of `order` is stored: its position in the order of
/// multiplication, Q's sections at even places, P's at odd ones.
#[must_use]
pub(crate) const fn place(index: usize, order: usize) -> usize {
    let of_difference = index % 2;
    let section = index / 2;
    let sections = if of_difference == 0 {
        order.div_ceil(2)
    } else {
        order / 2
    };
    let turn = if section < sections.div_ceil(2) {
        2 * section
    } else {
        2 * (sections - 1 - section) + 1
    };
    2 * turn + of_difference
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::{arithmetic::Float, model::assembly};
    use asperity_formats::limits::MAX_ORDER;

    /// The roots of Q and P, multiplied out over full length in f64.
    fn reference(omegas: &[f64]) -> std::vec::Vec<f64> {
        let product = |first: usize, mut poly: std::vec::Vec<f64>| {
            for omega in omegas.iter().skip(first).step_by(2) {
                let factor = [1.0, -2.0 * omega.cos(), 1.0];
                let mut next = std::vec![0.0; poly.len() + 2];
                for (i, p) in poly.iter().enumerate() {
                    for (j, f) in factor.iter().enumerate() {
                        next[i + j] += p * f;
                    }
                }
                poly = next;
            }
            poly
        };
        let even = omegas.len().is_multiple_of(2);
        let q = product(
            0,
            if even {
                std::vec![1.0, 1.0]
            } else {
                std::vec![1.0]
            },
        );
        let p = product(
            1,
            if even {
                std::vec![1.0, -1.0]
            } else {
                std::vec![1.0, 0.0, -1.0]
            },
        );
        (1..=omegas.len()).map(|k| 0.5 * (q[k] + p[k])).collect()
    }

    #[test]
    fn every_order_agrees_with_multiplying_out() {
        for order in 1..=MAX_ORDER {
            let omegas: std::vec::Vec<f64> = (0..order)
                .map(|i| {
                    let even = (i as f64 + 1.0) / (order as f64 + 1.0);
                    core::f64::consts::PI * (even + 0.3 / (order as f64 + 1.0) * (i as f64).sin())
                })
                .collect();
            let placed = |omegas: &[f64]| {
                let mut row = PaddedRow::<Float, LineCosine>::ZERO;
                for (index, omega) in omegas.iter().enumerate() {
                    row.0.as_flattened_mut()[place(index, omegas.len())] =
                        (-2.0 * omega.cos()) as f32;
                }
                row
            };
            let polynomials = |ar: &[f64], ma: &[f64]| {
                let orders = Orders::new(ar.len(), ma.len());
                let mut scratch = Scratch::IDLE;
                let (mut a, mut b) = (PaddedRow::<Float>::ZERO, PaddedRow::<Float>::ZERO);
                let spectrum = LineSpectrum {
                    ar: placed(ar),
                    ma: placed(ma),
                };
                for part in 0..orders.section_pairs() * orders.parts::<Float>() {
                    spectrum.multiply(&orders, &mut scratch, part);
                }
                assembly::ar(&orders, &scratch, &mut a);
                assembly::ma(&orders, &scratch, &mut b);
                (a.to_array(), b.to_array())
            };
            let shorter = &omegas[..order / 2];
            let (a, b) = polynomials(&omegas, shorter);
            let (_, swapped) = polynomials(shorter, &omegas);
            if order > 1 {
                assert_eq!(a, swapped, "A(z) and B(z) are converted alike");
            }
            for (ours, exact) in a.iter().zip(reference(&omegas)) {
                let error = (f64::from(*ours) - exact).abs();
                assert!(error < 1e-5, "order {order}: {error}");
            }
            assert!(a[order..].iter().all(|&a| a == 0.0));
            for (ours, exact) in b.iter().zip(reference(shorter)) {
                assert!((f64::from(*ours) - exact).abs() < 1e-2 * exact.abs().max(1.0));
            }
            assert!(b[order / 2..].iter().all(|&b| b == 0.0));
        }
    }
}
