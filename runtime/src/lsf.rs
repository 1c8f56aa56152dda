//! Line spectral frequencies, kept as −2 cos ω, to direct-form coefficients.
//!
//! For A(z) = 1 + Σ a_k z⁻ᵏ of order p, the sum polynomial Q(z) = A(z) + z⁻⁽ᵖ⁺¹⁾A(z⁻¹)
//! and the difference polynomial P(z) = A(z) − z⁻⁽ᵖ⁺¹⁾A(z⁻¹) have their zeros on the
//! unit circle, alternating; the first belongs to Q. Hence A = (P + Q)/2. A convex
//! mixture of ordered frequencies is ordered, in ω and in cos ω, so its A(z) is
//! stable; in cos ω it needs no trigonometry.
//!
//! Each zero pair multiplies its polynomial by 1 + m z⁻¹ + z⁻², m = −2 cos ω. Pairs come in
//! low and high in turn ([`stage`]): partial products of neighbouring zeros grow large and
//! cancel later, which in f32 costs up to 0.4 dB on real models; this order costs less than
//! 0.001 dB. A low pair and a high one, a two, are multiplied in at once, Q and P of A(z) and
//! B(z) side by side; the twos can be done one at a time.

mod assembly;
mod product;

pub(crate) use product::Two;

use crate::{
    arithmetic::{Arithmetic, Four, Number, units::Pair},
    synthesis::Line,
    workspace::{LANES, Workspace},
};
use product::{Lane, Polynomial as _, Products};

/// Orders of A(z) and B(z), and what follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shape {
    ar_order: u8,
    ma_order: u8,
    /// Pairs of each polynomial: Q and P of A(z), Q and P of B(z).
    pairs: [u8; LANES],
    /// The fewest of those in use.
    fewest: u8,
}

/// −2 cos ω of a mixture, in [`stage`] order, 0 beyond the order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pairs<A: Arithmetic> {
    pub(crate) ar: Line<A, Pair>,
    pub(crate) ma: Line<A, Pair>,
}

impl<A: Arithmetic> Pairs<A> {
    pub(crate) const ZERO: Self = Self {
        ar: Line::ZERO,
        ma: Line::ZERO,
    };
}

impl Shape {
    /// Of a slot that was never loaded.
    pub(crate) const NONE: Self = Self {
        ar_order: 0,
        ma_order: 0,
        pairs: [0; LANES],
        fewest: 0,
    };

    /// Of orders that are at most [`MAX_ORDER`](asperity_formats::limits::MAX_ORDER).
    pub(crate) const fn new(ar_order: usize, ma_order: usize) -> Self {
        let (ar_order, ma_order) = (ar_order as u8, ma_order as u8);
        let shorter = if ma_order == 0 || ar_order < ma_order {
            ar_order
        } else {
            ma_order
        };
        Self {
            ar_order,
            ma_order,
            pairs: [
                ar_order.div_ceil(2),
                ar_order / 2,
                ma_order.div_ceil(2),
                ma_order / 2,
            ],
            fewest: shorter / 2,
        }
    }

    /// Order of A(z).
    #[inline(always)]
    pub(crate) const fn ar_order(&self) -> usize {
        self.ar_order as usize
    }

    /// Order of B(z).
    #[inline(always)]
    pub(crate) const fn ma_order(&self) -> usize {
        self.ma_order as usize
    }

    /// Twos of pairs of the longest polynomial.
    pub(crate) const fn twos(&self) -> usize {
        let longer = if self.ar_order > self.ma_order {
            self.ar_order
        } else {
            self.ma_order
        };
        longer.div_ceil(4) as usize
    }

    /// Parts in which a two is multiplied in: A(z) and B(z) at once where registers hold four
    /// numbers, else one after the other.
    #[inline(always)]
    pub(crate) const fn parts<A: Arithmetic>(&self) -> usize {
        if A::IN_REGISTERS {
            1
        } else {
            self.parts_one_by_one()
        }
    }

    /// [`Shape::parts`] without such registers.
    #[inline(always)]
    pub(crate) const fn parts_one_by_one(&self) -> usize {
        if self.ma_order == 0 { 1 } else { 2 }
    }

    /// Multiplies one part of a two in, in the order of twos.
    #[inline(always)]
    pub(crate) fn multiply<A: Arithmetic>(
        &self,
        workspace: &mut Workspace,
        pairs: &Pairs<A>,
        part: usize,
    ) {
        let parts = self.parts::<A>();
        let (two, part) = (part / parts, part % parts);
        if A::IN_REGISTERS {
            let (Some(ar), Some(ma)) = (pairs.ar.0.get(two), pairs.ma.0.get(two)) else {
                return;
            };
            let low = Four::<A, Pair>::load(&[ar[0], ar[1], ma[0], ma[1]]);
            let high = Four::<A, Pair>::load(&[ar[2], ar[3], ma[2], ma[3]]);
            Products::<A>::of(workspace).multiply(two, [low, high], self.pairs, self.fewest);
            return;
        }
        let line = if part == 0 { &pairs.ar } else { &pairs.ma };
        let Some(row) = line.0.get(two) else {
            return;
        };
        for side in 0..2 {
            let cosines = [Number(row[side]), Number(row[side + 2])];
            let polynomial = (2 * part + side) % LANES;
            if let Some(mut lane) = Lane::<A>::of(workspace, polynomial) {
                let pairs = self.pairs[polynomial];
                lane.multiply(two, cosines, pairs, pairs);
            }
        }
    }
}

/// Where −2 cos ω of LSF `index` of `order` is stored: its position in the order of
/// multiplication, Q's pairs at even places, P's at odd ones.
#[must_use]
pub(crate) const fn stage(index: usize, order: usize) -> usize {
    let of_difference = index % 2;
    let pair = index / 2;
    let pairs = if of_difference == 0 {
        order.div_ceil(2)
    } else {
        order / 2
    };
    let stage = if pair < pairs.div_ceil(2) {
        2 * pair
    } else {
        2 * (pairs - 1 - pair) + 1
    };
    2 * stage + of_difference
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::arithmetic::Float;
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
            let staged = |omegas: &[f64]| {
                let mut line = Line::<Float, _>::ZERO;
                for (index, omega) in omegas.iter().enumerate() {
                    line.0.as_flattened_mut()[stage(index, omegas.len())] =
                        (-2.0 * omega.cos()) as f32;
                }
                line
            };
            let polynomials = |ar: &[f64], ma: &[f64]| {
                let shape = Shape::new(ar.len(), ma.len());
                let mut workspace = Workspace::IDLE;
                let (mut a, mut b) = (Line::<Float>::ZERO, Line::<Float>::ZERO);
                let pairs = Pairs {
                    ar: staged(ar),
                    ma: staged(ma),
                };
                for part in 0..shape.twos() * shape.parts::<Float>() {
                    shape.multiply(&mut workspace, &pairs, part);
                }
                shape.ar(&workspace, &mut a);
                shape.ma(&workspace, &mut b);
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
