//! Line spectral frequencies, kept as x = cos ω, to direct-form coefficients.
//!
//! For A(z) = 1 + Σ a_k z⁻ᵏ of order p, the sum polynomial Q(z) = A(z) + z⁻⁽ᵖ⁺¹⁾A(z⁻¹)
//! and the difference polynomial P(z) = A(z) − z⁻⁽ᵖ⁺¹⁾A(z⁻¹) have their zeros on the
//! unit circle, alternating; the first belongs to Q. Hence A = (P + Q)/2. A convex
//! mixture of ordered frequencies is ordered, in ω and in cos ω, so its A(z) is
//! stable; in cos ω it needs no trigonometry.

use asperity_formats::limits::MAX_ORDER;

/// Half a polynomial of degree 24, and one more.
const HALF: usize = MAX_ORDER / 2 + 1;

/// Half of a symmetric polynomial of even degree.
type Half = [f32; HALF];

/// Coefficients a_1..a_p of the monic polynomial whose LSF cosines are
/// `cosines[..order]`, in descending order; zeros above. `order` ≤ 24.
#[must_use]
pub fn polynomial(cosines: &[f32; MAX_ORDER], order: usize) -> [f32; MAX_ORDER] {
    let order = if order < MAX_ORDER { order } else { MAX_ORDER };
    let sum_pairs = order.div_ceil(2);
    let difference_pairs = order / 2;
    let mut sum: Half = [0.0; HALF];
    let mut difference: Half = [0.0; HALF];
    sum[0] = 1.0;
    difference[0] = 1.0;
    for done in 0..sum_pairs {
        let pair = from_both_ends(done, sum_pairs);
        multiply(&mut sum, done, cosines[2 * pair % MAX_ORDER]);
    }
    for done in 0..difference_pairs {
        let pair = from_both_ends(done, difference_pairs);
        multiply(&mut difference, done, cosines[(2 * pair + 1) % MAX_ORDER]);
    }
    let sum = |k| mirrored(&sum, sum_pairs, k);
    let difference = |k| mirrored(&difference, difference_pairs, k);
    // Q = sum·(1 + z⁻¹), P = difference·(1 − z⁻¹) for even orders;
    // Q = sum, P = difference·(1 − z⁻²) for odd ones.
    let odd = order % 2 == 1;
    let mut a = [0.0; MAX_ORDER];
    for (index, a) in a.iter_mut().enumerate().take(order) {
        let k = index + 1;
        *a = 0.5
            * if odd {
                sum(k) + (difference(k) - earlier(difference, k, 2))
            } else {
                (sum(k) + sum(k - 1)) + (difference(k) - difference(k - 1))
            };
    }
    a
}

/// Which of `pairs` zero pairs comes in after `done` others: low and high frequencies in
/// turn. Partial products of neighbouring zeros grow large and cancel later; in f32 that
/// costs up to 0.4 dB on real models, this order less than 0.001 dB.
#[inline]
const fn from_both_ends(done: usize, pairs: usize) -> usize {
    if done.is_multiple_of(2) {
        done / 2
    } else {
        pairs - 1 - done / 2
    }
}

/// Multiplies half of a symmetric polynomial of degree `2·pairs` by
/// 1 − 2x z⁻¹ + z⁻².
#[inline]
fn multiply(half: &mut Half, pairs: usize, x: f32) {
    let minus_2x = -2.0 * x;
    let middle = pairs + 1;
    // Coefficient `middle` of the old polynomial mirrors `middle − 2`.
    for k in (1..HALF.min(middle + 1)).rev() {
        let two_before = if k >= 2 { half[k - 2] } else { 0.0 };
        let here = if k == middle { two_before } else { half[k] };
        half[k] = (here + two_before) + minus_2x * half[k - 1];
    }
}

/// Coefficient `k` of a symmetric polynomial of degree `2·pairs`; 0 beyond it.
#[inline]
fn mirrored(half: &Half, pairs: usize, k: usize) -> f32 {
    let degree = 2 * pairs;
    let index = if k <= pairs {
        k
    } else {
        degree.wrapping_sub(k)
    };
    if k > degree { 0.0 } else { half[index % HALF] }
}

#[inline]
fn earlier(f: impl Fn(usize) -> f32, k: usize, by: usize) -> f32 {
    if k >= by { f(k - by) } else { 0.0 }
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
            let mut cosines = [0.0; MAX_ORDER];
            for (x, omega) in cosines.iter_mut().zip(&omegas) {
                *x = omega.cos() as f32;
            }
            let a = polynomial(&cosines, order);
            for (ours, exact) in a.iter().zip(reference(&omegas)) {
                let error = (f64::from(*ours) - exact).abs();
                assert!(error < 1e-5, "order {order}: {error}");
            }
            assert!(a[order..].iter().all(|&a| a == 0.0));
        }
    }
}
