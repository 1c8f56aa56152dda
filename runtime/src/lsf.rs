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
//! 0.001 dB. A low pair and a high one are multiplied in at once, Q and P of A(z) and B(z)
//! side by side, in [`Shape::units`] units of work that can be done one at a time.

use crate::{lanes::F4, synthesis::Line};
use asperity_formats::limits::MAX_ORDER;

/// Q and P of A(z), Q and P of B(z).
const LANES: usize = 4;
/// Coefficients 0..=12 of symmetric polynomials of degree up to 24.
const COEFFICIENTS: usize = MAX_ORDER / 2 + 1;

/// Orders of A(z) and B(z), and what follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shape {
    pub(crate) ar_order: usize,
    pub(crate) ma_order: usize,
    /// Twos of pairs that every polynomial in use has.
    full: usize,
    /// Pairs of each polynomial.
    pairs: F4,
}

/// −2 cos ω of a mixture, in [`stage`] order, 0 beyond the order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pairs {
    pub(crate) ar: Line,
    pub(crate) ma: Line,
}

impl Pairs {
    pub(crate) const ZERO: Self = Self {
        ar: Line::ZERO,
        ma: Line::ZERO,
    };
}

/// Partial products, the half of each that symmetry leaves, times ½.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Products([F4; COEFFICIENTS]);

impl Products {
    /// No pair yet.
    pub(crate) const ONE: Self = {
        let mut c = [F4::ZERO; COEFFICIENTS];
        c[0] = F4::HALF;
        Self(c)
    };
}

impl Shape {
    pub(crate) const fn new(ar_order: usize, ma_order: usize) -> Self {
        let pairs = [
            ar_order.div_ceil(2) as f32,
            (ar_order / 2) as f32,
            ma_order.div_ceil(2) as f32,
            (ma_order / 2) as f32,
        ];
        let fewest = if ma_order == 0 || ar_order < ma_order {
            ar_order / 2
        } else {
            ma_order / 2
        };
        Self {
            ar_order,
            ma_order,
            full: fewest / 2,
            pairs: F4::load(&pairs),
        }
    }

    /// Units of work of a conversion: two for every two pairs.
    pub(crate) const fn units(&self) -> usize {
        let order = if self.ar_order > self.ma_order {
            self.ar_order
        } else {
            self.ma_order
        };
        2 * order.div_ceil(4)
    }

    /// Whether every polynomial in use has both pairs of a two.
    pub(crate) const fn is_full(&self, two: usize) -> bool {
        two < self.full
    }

    /// One unit of work on all polynomials.
    #[inline(always)]
    pub(crate) fn multiply(&self, products: &mut Products, pairs: &Pairs, unit: usize) {
        let two = unit / 2;
        let (Some(ar), Some(ma)) = (pairs.ar.0.get(two), pairs.ma.0.get(two)) else {
            return;
        };
        let low = F4::load(&[ar[0], ar[1], ma[0], ma[1]]);
        let high = F4::load(&[ar[2], ar[3], ma[2], ma[3]]);
        let (s, product) = (low + high, low * high);
        if self.is_full(two) {
            let q = F4::TWO + product;
            Full { s, q }.multiply(&mut products.0, unit);
        } else {
            // 1 where a polynomial has the low pair, and the high one.
            let left = self.pairs - F4::splat((2 * two) as f32);
            let [first, second] = [left, left - F4::ONE].map(|x| x.max(F4::ZERO).min(F4::ONE));
            Partial {
                s,
                q: first + second + product,
                r: s * second,
                o: second,
            }
            .multiply(&mut products.0, unit);
        }
    }

    /// Coefficients of A(z).
    #[inline]
    pub(crate) fn ar(&self, products: &Products, a: &mut Line) {
        assemble::<0>(&products.0, self.ar_order, a);
    }

    /// Coefficients of B(z).
    #[inline]
    pub(crate) fn ma(&self, products: &Products, b: &mut Line) {
        assemble::<2>(&products.0, self.ma_order, b);
    }
}

/// Symmetric polynomials of degree up to 4 that multiply others in place.
trait Factors: Sized {
    /// The new coefficient from the old one and the four before it.
    fn coefficient(&self, old: F4, before: [F4; 4]) -> F4;

    /// The upper half of the coefficients, from the highest down, of polynomials of degree
    /// 4·`TWO`.
    #[inline(always)]
    fn upper<const TWO: usize>(&self, c: &mut [F4; COEFFICIENTS]) {
        let (middle, top) = (TWO + 1, 2 * TWO + 2);
        // Symmetry gives the two coefficients beyond the middle.
        (c[top - 1], c[top]) = if TWO == 0 {
            (F4::ZERO, F4::ZERO)
        } else {
            (c[top - 3], c[top - 4])
        };
        for k in (middle + 1..top + 1).rev() {
            self.step(c, k);
        }
    }

    /// The lower half.
    #[inline(always)]
    fn lower<const TWO: usize>(&self, c: &mut [F4; COEFFICIENTS]) {
        for k in (1..TWO + 2).rev() {
            self.step(c, k);
        }
    }

    #[inline(always)]
    fn step(&self, c: &mut [F4; COEFFICIENTS], k: usize) {
        let back = |by: usize| if k < by { F4::ZERO } else { c[k - by] };
        c[k] = self.coefficient(c[k], [back(1), back(2), back(3), back(4)]);
    }

    /// Unit 2·n is the upper half of two n, the next one the lower half.
    #[inline(always)]
    fn multiply(&self, c: &mut [F4; COEFFICIENTS], unit: usize) {
        match unit {
            0 => self.upper::<0>(c),
            1 => self.lower::<0>(c),
            2 => self.upper::<1>(c),
            3 => self.lower::<1>(c),
            4 => self.upper::<2>(c),
            5 => self.lower::<2>(c),
            6 => self.upper::<3>(c),
            7 => self.lower::<3>(c),
            8 => self.upper::<4>(c),
            9 => self.lower::<4>(c),
            10 => self.upper::<5>(c),
            _ => self.lower::<5>(c),
        }
    }
}

/// Two zero pairs at once: 1 + s z⁻¹ + q z⁻² + s z⁻³ + z⁻⁴.
struct Full {
    s: F4,
    q: F4,
}

impl Factors for Full {
    #[inline(always)]
    fn coefficient(&self, old: F4, [one, two, three, four]: [F4; 4]) -> F4 {
        (old + four) + self.q * two + self.s * (one + three)
    }
}

/// Two pairs, one or none: 1 + s z⁻¹ + q z⁻² + r z⁻³ + o z⁻⁴. What a polynomial with fewer
/// pairs than others gets beyond its own middle is not used.
struct Partial {
    s: F4,
    q: F4,
    r: F4,
    o: F4,
}

impl Factors for Partial {
    #[inline(always)]
    fn coefficient(&self, old: F4, [one, two, three, four]: [F4; 4]) -> F4 {
        (old + self.o * four) + self.q * two + (self.s * one + self.r * three)
    }
}

/// a_k = (q_k + p_k)/2 and, by symmetry, a_{p+1−k} = (q_k − p_k)/2, where Q = sum·(1 + z⁻¹)
/// and P = difference·(1 − z⁻¹) for even orders, Q = sum and P = difference·(1 − z⁻²)
/// for odd ones. The products carry the ½.
#[inline(always)]
fn assemble<const LANE: usize>(c: &[F4; COEFFICIENTS], order: usize, a: &mut Line) {
    let half = order / 2;
    let Some(a) = a.0.as_flattened_mut().get_mut(..order) else {
        return;
    };
    if order.is_multiple_of(2) && half >= LANES {
        // The last four overlap those before where four does not divide the half.
        let last = half - LANES;
        for first in (0..last).step_by(LANES) {
            assemble_four::<LANE>(c, first, a);
        }
        assemble_four::<LANE>(c, last, a);
    } else {
        assemble_singly::<LANE>(c, a);
    }
}

/// Four coefficients from `first` on and their four mirror images, of an even order.
#[inline(always)]
fn assemble_four<const LANE: usize>(c: &[F4; COEFFICIENTS], first: usize, a: &mut [f32]) {
    let last = a.len() - first;
    let Some(c) = c.get(first..).and_then(|c| c.first_chunk::<5>()) else {
        return;
    };
    let alternating = F4::load(&[1.0, -1.0, 1.0, -1.0]);
    let [c0, c1, c2, c3, c4] = *c;
    let t0 = (c1 + alternating * c0).to_array();
    let t1 = (c2 + alternating * c1).to_array();
    let t2 = (c3 + alternating * c2).to_array();
    let t3 = (c4 + alternating * c3).to_array();
    let across = |lane: usize| F4::load(&[t0[lane], t1[lane], t2[lane], t3[lane]]);
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
fn assemble_singly<const LANE: usize>(c: &[F4; COEFFICIENTS], a: &mut [f32]) {
    let order = a.len();
    let even = order.is_multiple_of(2);
    let number = |k: usize, lane: usize| c.get(k).map_or(0.0, |c| c.to_array()[lane]);
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
                let mut line = Line::ZERO;
                for (index, omega) in omegas.iter().enumerate() {
                    line.0.as_flattened_mut()[stage(index, omegas.len())] =
                        (-2.0 * omega.cos()) as f32;
                }
                line
            };
            let polynomials = |ar: &[f64], ma: &[f64]| {
                let shape = Shape::new(ar.len(), ma.len());
                let (mut products, mut a, mut b) = (Products::ONE, Line::ZERO, Line::ZERO);
                let pairs = Pairs {
                    ar: staged(ar),
                    ma: staged(ma),
                };
                for unit in 0..shape.units() {
                    shape.multiply(&mut products, &pairs, unit);
                }
                shape.ar(&products, &mut a);
                shape.ma(&products, &mut b);
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
