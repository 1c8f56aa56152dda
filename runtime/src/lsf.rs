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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shape {
    pub(crate) ar_order: usize,
    pub(crate) ma_order: usize,
    /// Zero pairs of each polynomial.
    pairs: [u8; LANES],
    /// Twos of pairs that every polynomial in use has.
    full: usize,
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

impl Shape {
    pub(crate) const fn new(ar_order: usize, ma_order: usize) -> Self {
        let pairs = [
            ar_order.div_ceil(2) as u8,
            (ar_order / 2) as u8,
            ma_order.div_ceil(2) as u8,
            (ma_order / 2) as u8,
        ];
        let fewest = if ma_order == 0 || ar_order < ma_order {
            ar_order / 2
        } else {
            ma_order / 2
        };
        Self {
            ar_order,
            ma_order,
            pairs,
            full: fewest / 2,
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

    /// Steps of a unit: coefficients that it changes.
    pub(crate) const fn steps(&self, unit: usize) -> usize {
        if unit / 2 < self.full {
            unit / 2 + 1
        } else {
            unit + 1
        }
    }

    /// One unit of work on `L` polynomials, two without B(z); `ar` and `ma` hold −2 cos ω in
    /// [`stage`] order, 0 beyond the order.
    #[inline(always)]
    pub(crate) fn multiply<const L: usize>(
        &self,
        products: &mut Products,
        ar: &Line,
        ma: &Line,
        unit: usize,
    ) {
        let (two, upper) = (unit / 2, unit.is_multiple_of(2));
        let (Some(ar), Some(ma)) = (ar.0.get(two), ma.0.get(two)) else {
            return;
        };
        let low = [ar[0], ar[1], ma[0], ma[1]];
        let high = [ar[2], ar[3], ma[2], ma[3]];
        let c = &mut products.0;
        if two >= self.full {
            return self.one_pair(c, if upper { low } else { high }, unit);
        }
        let factors = Two::new(low, high);
        match two {
            0 => factors.multiply::<0>(c, upper),
            1 => factors.multiply::<1>(c, upper),
            2 => factors.multiply::<2>(c, upper),
            3 => factors.multiply::<3>(c, upper),
            4 => factors.multiply::<4>(c, upper),
            _ => factors.multiply::<5>(c, upper),
        }
    }

    /// Multiplies polynomials of `done` pairs by one more where they have one.
    #[inline(always)]
    fn one_pair(&self, c: &mut [[f32; LANES]; COEFFICIENTS], m: [f32; LANES], done: usize) {
        let busy = self
            .pairs
            .map(|pairs| if done < usize::from(pairs) { 1.0 } else { 0.0 });
        let (busy, m) = (F4::load(&busy), F4::load(&m));
        let zero = F4::splat(0.0);
        // The new middle's old value mirrors the one two before it.
        let mirrored = done
            .checked_sub(1)
            .and_then(|k| c.get(k))
            .map_or(zero, F4::load);
        if let Some(middle) = c.get_mut(done + 1) {
            *middle = (busy * mirrored).to_array();
        }
        let (mut two_before, mut before) = (zero, F4::load(&c[0]));
        for here in c.iter_mut().skip(1).take(done + 1) {
            let old = F4::load(here);
            *here = (old + busy * two_before + m * before).to_array();
            (two_before, before) = (before, old);
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

/// Two zero pairs at once: 1 + s z⁻¹ + q z⁻² + s z⁻³ + z⁻⁴.
struct Two {
    s: F4,
    q: F4,
}

impl Two {
    #[inline(always)]
    fn new(low: [f32; LANES], high: [f32; LANES]) -> Self {
        let (low, high) = (F4::load(&low), F4::load(&high));
        Self {
            s: low + high,
            q: F4::splat(2.0) + low * high,
        }
    }

    /// Multiplies polynomials of degree 4·`TWO`, the upper half of the coefficients or
    /// the lower one. From the highest down, in place.
    #[inline(always)]
    fn multiply<const TWO: usize>(&self, c: &mut [[f32; LANES]; COEFFICIENTS], upper: bool) {
        let (middle, top) = (TWO + 1, 2 * TWO + 2);
        if upper {
            // Symmetry gives the two coefficients beyond the middle.
            if TWO == 0 {
                (c[1], c[2]) = ([0.0; LANES], [0.0; LANES]);
            } else {
                (c[top - 1], c[top]) = (c[top - 3], c[top - 4]);
            }
            for k in (middle + 1..=top).rev() {
                self.step(c, k);
            }
        } else {
            for k in (1..=middle).rev() {
                self.step(c, k);
            }
        }
    }

    #[inline(always)]
    fn step(&self, c: &mut [[f32; LANES]; COEFFICIENTS], k: usize) {
        let back = |by: usize| F4::load(if k < by { &[0.0; LANES] } else { &c[k - by] });
        let outer = F4::load(&c[k]) + back(4);
        c[k] = (outer + self.q * back(2) + self.s * (back(1) + back(3))).to_array();
    }
}

/// a_k = (q_k + p_k)/2 and, by symmetry, a_{p+1−k} = (q_k − p_k)/2, where Q = sum·(1 + z⁻¹)
/// and P = difference·(1 − z⁻¹) for even orders, Q = sum and P = difference·(1 − z⁻²)
/// for odd ones. The products carry the ½.
#[inline(always)]
fn assemble<const LANE: usize>(c: &[[f32; LANES]; COEFFICIENTS], order: usize, a: &mut Line) {
    let half = order / 2;
    let (low, high) =
        a.0.as_flattened_mut()
            .split_at_mut(order.div_ceil(2).min(MAX_ORDER));
    let (Some(ends), Some(high), Some(c)) = (
        low.get_mut(..half),
        high.get_mut(..half),
        c.get(..=order.div_ceil(2)),
    ) else {
        return;
    };
    if order.is_multiple_of(2) {
        for k in 0..half {
            let q = c[k + 1][LANE] + c[k][LANE];
            let p = c[k + 1][LANE + 1] - c[k][LANE + 1];
            (ends[k], high[half - 1 - k]) = (q + p, q - p);
        }
    } else {
        let mut two_before = 0.0;
        for k in 0..half {
            let (q, p) = (c[k + 1][LANE], c[k + 1][LANE + 1] - two_before);
            two_before = c[k][LANE + 1];
            (ends[k], high[half - 1 - k]) = (q + p, q - p);
        }
        if let (Some(middle), Some(c)) = (low.last_mut(), c.last()) {
            *middle = c[LANE];
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
                for unit in 0..shape.units() {
                    shape.multiply::<4>(&mut products, &staged(ar), &staged(ma), unit);
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
