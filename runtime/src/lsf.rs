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

use crate::{lanes::F4, synthesis::Line};
use asperity_formats::limits::MAX_ORDER;
use core::ops::{Add, Mul};

/// Q and P of A(z), Q and P of B(z).
const LANES: usize = 4;
/// Coefficients 0..=12 of symmetric polynomials of degree up to 24.
const COEFFICIENTS: usize = MAX_ORDER / 2 + 1;

/// Orders of A(z) and B(z), and what follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shape {
    pub(crate) ar_order: usize,
    pub(crate) ma_order: usize,
    /// Twos that every polynomial in use has.
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
#[repr(align(16))]
pub(crate) struct Products([[f32; LANES]; COEFFICIENTS]);

impl Products {
    /// No pair yet.
    pub(crate) const ONE: Self = {
        let mut c = [[0.0; LANES]; COEFFICIENTS];
        c[0] = [0.5; LANES];
        Self(c)
    };
}

/// The coefficients of polynomials side by side, or of one of them.
trait Coefficients {
    type Number: Copy + Default + Add<Output = Self::Number> + Mul<Output = Self::Number>;

    fn get(&self, k: usize) -> Self::Number;

    fn set(&mut self, k: usize, x: Self::Number);
}

impl Coefficients for Products {
    type Number = F4;

    #[inline(always)]
    fn get(&self, k: usize) -> F4 {
        F4::load(&self.0[k])
    }

    #[inline(always)]
    fn set(&mut self, k: usize, x: F4) {
        self.0[k] = x.to_array();
    }
}

/// One polynomial: every fourth number.
struct Lane<'a>(&'a mut [f32; LANES * (COEFFICIENTS - 1) + 1]);

impl Coefficients for Lane<'_> {
    type Number = f32;

    #[inline(always)]
    fn get(&self, k: usize) -> f32 {
        self.0[LANES * k]
    }

    #[inline(always)]
    fn set(&mut self, k: usize, x: f32) {
        self.0[LANES * k] = x;
    }
}

/// A two: 1 + s z⁻¹ + q z⁻² + r z⁻³ + o z⁻⁴, of polynomials side by side or of one.
#[derive(Debug, Clone, Copy)]
struct Two<T> {
    s: T,
    q: T,
    r: T,
    o: T,
}

impl Two<F4> {
    #[inline(always)]
    fn lane(&self, lane: usize) -> Two<f32> {
        Two {
            s: self.s.lane(lane),
            q: self.q.lane(lane),
            r: self.r.lane(lane),
            o: self.o.lane(lane),
        }
    }
}

impl<T: Copy + Default + Add<Output = T> + Mul<Output = T>> Two<T> {
    /// Multiplies polynomials of degree 4·`two` in place; with `FULL`, r = s and o = 1.
    #[inline(always)]
    fn multiply<const FULL: bool>(&self, two: usize, c: &mut impl Coefficients<Number = T>) {
        match two {
            0 => self.extend::<FULL, 0>(c),
            1 => self.extend::<FULL, 1>(c),
            2 => self.extend::<FULL, 2>(c),
            3 => self.extend::<FULL, 3>(c),
            4 => self.extend::<FULL, 4>(c),
            _ => self.extend::<FULL, 5>(c),
        }
    }

    /// From the highest coefficient down, so that nothing is overwritten before it is read.
    #[inline(always)]
    fn extend<const FULL: bool, const TWO: usize>(&self, c: &mut impl Coefficients<Number = T>) {
        // Symmetry gives what lies beyond the middle.
        let old = |c: &_, k: usize| {
            if k <= 2 * TWO {
                Coefficients::get(c, k)
            } else if TWO == 0 {
                T::default()
            } else {
                Coefficients::get(c, 4 * TWO - k)
            }
        };
        for k in (1..2 * TWO + 3).rev() {
            let back = |by: usize| if k < by { T::default() } else { old(c, k - by) };
            let [one, two, three, four] = [back(1), back(2), back(3), back(4)];
            let x = if FULL {
                (old(c, k) + four) + self.q * two + self.s * (one + three)
            } else {
                (old(c, k) + self.o * four) + self.q * two + (self.s * one + self.r * three)
            };
            c.set(k, x);
        }
    }
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

    /// Twos of pairs of the longest polynomial.
    pub(crate) const fn twos(&self) -> usize {
        let order = if self.ar_order > self.ma_order {
            self.ar_order
        } else {
            self.ma_order
        };
        order.div_ceil(4)
    }

    /// Parts in which a two is multiplied in: A(z) and B(z) at once where registers hold four
    /// numbers, else one after the other.
    #[inline(always)]
    pub(crate) const fn parts(&self) -> usize {
        if F4::IN_REGISTERS || self.ma_order == 0 {
            1
        } else {
            2
        }
    }

    /// Multiplies one part of a two in, in the order of twos.
    #[inline(always)]
    pub(crate) fn multiply(&self, products: &mut Products, pairs: &Pairs, part: usize) {
        let (two, part) = (part / self.parts(), part % self.parts());
        let (Some(ar), Some(ma)) = (pairs.ar.0.get(two), pairs.ma.0.get(two)) else {
            return;
        };
        let low = F4::load(&[ar[0], ar[1], ma[0], ma[1]]);
        let high = F4::load(&[ar[2], ar[3], ma[2], ma[3]]);
        let (s, product) = (low + high, low * high);
        if two < self.full {
            let q = F4::TWO + product;
            let factors = Two {
                s,
                q,
                r: s,
                o: F4::ONE,
            };
            self.multiply_by::<true>(products, &factors, two, part);
        } else {
            // A polynomial may have fewer pairs than others. What it gets beyond its own middle
            // is not used.
            let left = self.pairs - F4::splat((2 * two) as f32);
            // 1 where it has the low pair, and the high one.
            let [first, o] = [left, left - F4::ONE].map(|x| x.max(F4::ZERO).min(F4::ONE));
            let (q, r) = (first + o + product, s * o);
            self.multiply_by::<false>(products, &Two { s, q, r, o }, two, part);
        }
    }

    /// All polynomials at once, or the two of a part one by one: the bits are the same.
    #[inline(always)]
    fn multiply_by<const FULL: bool>(
        &self,
        products: &mut Products,
        by: &Two<F4>,
        two: usize,
        part: usize,
    ) {
        if F4::IN_REGISTERS {
            by.multiply::<FULL>(two, products);
        } else {
            for lane in 2 * part..2 * part + 2 {
                let from = products.0.as_flattened_mut().get_mut(lane..);
                if let Some(polynomial) = from.and_then(|from| from.first_chunk_mut()) {
                    by.lane(lane).multiply::<FULL>(two, &mut Lane(polynomial));
                }
            }
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

/// a_k = (q_k + p_k)/2 and, by symmetry, a_{p+1−k} = (q_k − p_k)/2, where Q = sum·(1 + z⁻¹)
/// and P = difference·(1 − z⁻¹) for even orders, Q = sum and P = difference·(1 − z⁻²)
/// for odd ones. The products carry the ½.
#[inline(always)]
fn assemble<const LANE: usize>(c: &[[f32; LANES]; COEFFICIENTS], order: usize, a: &mut Line) {
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
fn assemble_four<const LANE: usize>(c: &[[f32; LANES]; COEFFICIENTS], first: usize, a: &mut [f32]) {
    let last = a.len() - first;
    let Some(c) = c.get(first..).and_then(|c| c.first_chunk::<5>()) else {
        return;
    };
    let alternating = F4::load(&[1.0, -1.0, 1.0, -1.0]);
    let [c0, c1, c2, c3, c4] = c.each_ref().map(F4::load);
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
fn assemble_singly<const LANE: usize>(c: &[[f32; LANES]; COEFFICIENTS], a: &mut [f32]) {
    let order = a.len();
    let even = order.is_multiple_of(2);
    let number = |k: usize, lane: usize| c.get(k).map_or(0.0, |c| c[lane]);
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
#[expect(clippy::disallowed_methods, reason = "tests run on the host")]
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
                for part in 0..shape.twos() * shape.parts() {
                    shape.multiply(&mut products, &pairs, part);
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

    /// Processors without registers of four numbers take the lanes one by one.
    #[test]
    fn one_polynomial_at_a_time_gives_the_same_bits() {
        let number = |k: usize| F4::load(&[1, 2, 3, 4].map(|lane| ((7 * k + lane) as f32).sin()));
        let (mut at_once, mut singly) = (Products::ONE, Products::ONE);
        for two in 0..MAX_ORDER / 4 {
            let by = Two {
                s: number(two),
                q: number(two + 10),
                r: number(two + 20),
                o: number(two + 30),
            };
            let full = two % 2 == 0;
            if full {
                by.multiply::<true>(two, &mut at_once);
            } else {
                by.multiply::<false>(two, &mut at_once);
            }
            for lane in 0..LANES {
                let from = &mut singly.0.as_flattened_mut()[lane..];
                let mut polynomial = Lane(from.first_chunk_mut().unwrap());
                if full {
                    by.lane(lane).multiply::<true>(two, &mut polynomial);
                } else {
                    by.lane(lane).multiply::<false>(two, &mut polynomial);
                }
            }
            let bits = |products: &Products| products.0.map(|c| c.map(f32::to_bits));
            assert_eq!(bits(&at_once), bits(&singly), "two {two}");
        }
    }
}
