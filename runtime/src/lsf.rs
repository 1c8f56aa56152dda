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

use crate::{
    arithmetic::{
        Arithmetic, Four, Number, Zero as _,
        units::{Coefficient, Pair},
    },
    synthesis::Line,
};
use asperity_formats::limits::MAX_ORDER;

/// Q and P of A(z), Q and P of B(z).
const LANES: usize = 4;
/// Coefficients 0..=12 of symmetric polynomials of degree up to 24.
const COEFFICIENTS: usize = MAX_ORDER / 2 + 1;

/// Orders of A(z) and B(z), and what follows from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shape<A: Arithmetic> {
    pub(crate) ar_order: usize,
    pub(crate) ma_order: usize,
    /// Twos that every polynomial in use has.
    full: usize,
    /// Pairs of each polynomial.
    pairs: Four<A, Coefficient>,
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

/// Partial products, the half of each that symmetry leaves, times ½.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(16))]
pub(crate) struct Products<A: Arithmetic>([[A::Scalar<Coefficient>; LANES]; COEFFICIENTS]);

impl<A: Arithmetic> Products<A> {
    /// No pair yet.
    pub(crate) const ONE: Self = {
        let mut c = [[A::Scalar::ZERO; LANES]; COEFFICIENTS];
        c[0] = [A::ONE_HALF; LANES];
        Self(c)
    };
}

/// The coefficients of polynomials side by side, or of one of them.
trait Polynomial<A: Arithmetic> {
    type Number: Copy;
    /// What multiplies them.
    type By;

    const ZERO: Self::Number;

    fn get(&self, k: usize) -> Self::Number;

    fn set(&mut self, k: usize, x: Self::Number);

    /// See [`Arithmetic::extend`].
    fn extend<const FULL: bool>(by: &Self::By, c: [Self::Number; 5]) -> Self::Number;
}

impl<A: Arithmetic> Polynomial<A> for Products<A> {
    type Number = A::Four<Coefficient>;
    type By = Two<A::Four<Pair>>;

    const ZERO: Self::Number = A::Four::ZERO;

    #[inline(always)]
    fn get(&self, k: usize) -> Self::Number {
        A::four(&self.0[k])
    }

    #[inline(always)]
    fn set(&mut self, k: usize, x: Self::Number) {
        self.0[k] = A::numbers(x);
    }

    #[inline(always)]
    fn extend<const FULL: bool>(by: &Self::By, c: [Self::Number; 5]) -> Self::Number {
        A::extend_four::<FULL>(by, c)
    }
}

/// One polynomial: every fourth number.
struct Lane<'a, A: Arithmetic>(&'a mut [A::Scalar<Coefficient>; LANES * (COEFFICIENTS - 1) + 1]);

impl<A: Arithmetic> Polynomial<A> for Lane<'_, A> {
    type Number = A::Scalar<Coefficient>;
    type By = Two<A::Scalar<Pair>>;

    const ZERO: Self::Number = A::Scalar::ZERO;

    #[inline(always)]
    fn get(&self, k: usize) -> Self::Number {
        self.0[LANES * k]
    }

    #[inline(always)]
    fn set(&mut self, k: usize, x: Self::Number) {
        self.0[LANES * k] = x;
    }

    #[inline(always)]
    fn extend<const FULL: bool>(by: &Self::By, c: [Self::Number; 5]) -> Self::Number {
        A::extend::<FULL>(by, c)
    }
}

/// A two: 1 + s z⁻¹ + q z⁻² + r z⁻³ + o z⁻⁴, of polynomials side by side or of one.
#[derive(Debug, Clone, Copy)]
pub struct Two<T> {
    pub(crate) s: T,
    pub(crate) q: T,
    pub(crate) r: T,
    pub(crate) o: T,
}

/// One of four twos.
#[inline(always)]
fn lane<A: Arithmetic>(by: &Two<A::Four<Pair>>, lane: usize) -> Two<A::Scalar<Pair>> {
    let one = |four| A::numbers(four)[lane % LANES];
    Two {
        s: one(by.s),
        q: one(by.q),
        r: one(by.r),
        o: one(by.o),
    }
}

/// Multiplies polynomials of degree 4·`two` in place; with `FULL`, r = s and o = 1.
#[inline(always)]
fn multiply<A: Arithmetic, const FULL: bool, C: Polynomial<A>>(by: &C::By, two: usize, c: &mut C) {
    match two {
        0 => extend::<A, FULL, 0, C>(by, c),
        1 => extend::<A, FULL, 1, C>(by, c),
        2 => extend::<A, FULL, 2, C>(by, c),
        3 => extend::<A, FULL, 3, C>(by, c),
        4 => extend::<A, FULL, 4, C>(by, c),
        _ => extend::<A, FULL, 5, C>(by, c),
    }
}

/// From the highest coefficient down, so that nothing is overwritten before it is read.
#[inline(always)]
fn extend<A: Arithmetic, const FULL: bool, const TWO: usize, C: Polynomial<A>>(
    by: &C::By,
    c: &mut C,
) {
    // Symmetry gives what lies beyond the middle.
    let old = |c: &C, k: usize| {
        if k <= 2 * TWO {
            c.get(k)
        } else if TWO == 0 {
            C::ZERO
        } else {
            c.get(4 * TWO - k)
        }
    };
    for k in (1..2 * TWO + 3).rev() {
        let back = |by: usize| if k < by { C::ZERO } else { old(c, k - by) };
        let x = C::extend::<FULL>(by, [old(c, k), back(1), back(2), back(3), back(4)]);
        c.set(k, x);
    }
}

impl<A: Arithmetic> Shape<A> {
    /// Of a slot that was never loaded.
    pub(crate) const NONE: Self = Self {
        ar_order: 0,
        ma_order: 0,
        full: 0,
        pairs: Four::ZERO,
    };

    pub(crate) fn new(ar_order: usize, ma_order: usize) -> Self {
        let pairs = [
            ar_order.div_ceil(2),
            ar_order / 2,
            ma_order.div_ceil(2),
            ma_order / 2,
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
            pairs: Four::load(&pairs.map(|pairs| A::whole(pairs as i32))),
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
        if A::IN_REGISTERS || self.ma_order == 0 {
            1
        } else {
            2
        }
    }

    /// Multiplies one part of a two in, in the order of twos.
    #[inline(always)]
    pub(crate) fn multiply(&self, products: &mut Products<A>, pairs: &Pairs<A>, part: usize) {
        let parts = self.parts();
        let (two, part) = (part / parts, part % parts);
        let (Some(ar), Some(ma)) = (pairs.ar.0.get(two), pairs.ma.0.get(two)) else {
            return;
        };
        let low = Four::<A, Pair>::load(&[ar[0], ar[1], ma[0], ma[1]]);
        let high = Four::<A, Pair>::load(&[ar[2], ar[3], ma[2], ma[3]]);
        let (s, product) = (low + high, low.times::<Pair, Pair>(high));
        let number = |n| Four::splat(Number::whole(n));
        if two < self.full {
            let q = number(2) + product;
            let factors = Two {
                s: s.0,
                q: q.0,
                r: s.0,
                o: number(1).0,
            };
            multiply_by::<A, true>(products, &factors, two, part);
        } else {
            // A polynomial may have fewer pairs than others. What it gets beyond its own middle
            // is not used.
            let left = self.pairs - Four::splat(Number::whole(2 * two as i32));
            // 1 where it has the low pair, and the high one.
            let one = Four::splat(Number::whole(1));
            let [first, o] = [left, left - one].map(|x| x.max(Four::ZERO).min(one).to::<Pair>());
            let (q, r) = (first + o + product, s.times::<Pair, Pair>(o));
            let factors = Two {
                s: s.0,
                q: q.0,
                r: r.0,
                o: o.0,
            };
            multiply_by::<A, false>(products, &factors, two, part);
        }
    }

    /// Coefficients of A(z).
    #[inline]
    pub(crate) fn ar(&self, products: &Products<A>, a: &mut Line<A>) {
        assemble::<A, 0>(&products.0, self.ar_order, a);
    }

    /// Coefficients of B(z).
    #[inline]
    pub(crate) fn ma(&self, products: &Products<A>, b: &mut Line<A>) {
        assemble::<A, 2>(&products.0, self.ma_order, b);
    }
}

/// All polynomials at once, or the two of a part one by one: the bits are the same.
#[inline(always)]
fn multiply_by<A: Arithmetic, const FULL: bool>(
    products: &mut Products<A>,
    by: &Two<A::Four<Pair>>,
    two: usize,
    part: usize,
) {
    if A::IN_REGISTERS {
        multiply::<A, FULL, _>(by, two, products);
    } else {
        for polynomial in 2 * part..2 * part + 2 {
            let from = products.0.as_flattened_mut().get_mut(polynomial..);
            if let Some(numbers) = from.and_then(|from| from.first_chunk_mut()) {
                multiply::<A, FULL, _>(&lane::<A>(by, polynomial), two, &mut Lane(numbers));
            }
        }
    }
}

/// a_k = (q_k + p_k)/2 and, by symmetry, a_{p+1−k} = (q_k − p_k)/2, where Q = sum·(1 + z⁻¹)
/// and P = difference·(1 − z⁻¹) for even orders, Q = sum and P = difference·(1 − z⁻²)
/// for odd ones. The products carry the ½.
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
    use crate::{arithmetic::Float, lanes::F4};

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
                let shape = Shape::<Float>::new(ar.len(), ma.len());
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
                multiply::<Float, true, _>(&by, two, &mut at_once);
            } else {
                multiply::<Float, false, _>(&by, two, &mut at_once);
            }
            for polynomial in 0..LANES {
                let from = &mut singly.0.as_flattened_mut()[polynomial..];
                let mut numbers = Lane(from.first_chunk_mut().unwrap());
                let by = lane::<Float>(&by, polynomial);
                if full {
                    multiply::<Float, true, _>(&by, two, &mut numbers);
                } else {
                    multiply::<Float, false, _>(&by, two, &mut numbers);
                }
            }
            let bits = |products: &Products<Float>| products.0.map(|c| c.map(f32::to_bits));
            assert_eq!(bits(&at_once), bits(&singly), "two {two}");
        }
    }
}
