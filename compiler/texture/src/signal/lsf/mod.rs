//! Line spectral frequencies in f64: to a polynomial, and back.
//!
//! With `A(z)` monic of order p, `Q(z) = A(z) + z⁻⁽ᵖ⁺¹⁾A(z⁻¹)` is the sum polynomial
//! and `P(z) = A(z) − z⁻⁽ᵖ⁺¹⁾A(z⁻¹)` the difference polynomial, so `A = (P + Q)/2`.
//! The roots of both lie on the unit circle where A is stable, and alternate; their
//! angles in (0, π) are the LSFs, the first of which belongs to Q.
//!
//! A polynomial is stable exactly when its frequencies ascend, and a convex mixture of ascending frequencies ascends.
//! So models are stored and mixed in this form:
//!
//! ```
//! use asperity_texture::signal::lsf;
//!
//! let (a, b) = ([1.0, -1.2, 0.9], [1.0, 0.4, 0.8]);
//! let (a, b) = (lsf::from_polynomial(&a).expect("stable"), lsf::from_polynomial(&b).expect("stable"));
//! let middle: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 0.5 * (a + b)).collect();
//! assert!(lsf::is_ordered(&middle));
//! assert!(lsf::from_polynomial(&lsf::to_polynomial(&middle)).is_some());
//! assert_eq!(lsf::from_polynomial(&[1.0, -2.5, 1.2]), None); // not stable
//! ```

mod roots;

use crate::signal::reflection::step_down;
use roots::{LANES, Side, Sturm};
use std::f64::consts::PI;

/// The monic polynomial `[1, a_1, …, a_p]` of `p` line spectral frequencies (rad).
///
/// Defined for any order and any frequencies; stable where they ascend strictly
/// inside (0, π).
#[must_use]
pub fn to_polynomial(lsf_rad: &[f64]) -> Vec<f64> {
    let cosines: Vec<f64> = lsf_rad.iter().map(|&omega| libm::cos(omega)).collect();
    from_cosines(&cosines)
}

/// [`to_polynomial`] of frequencies given by their cosines.
#[must_use]
pub fn from_cosines(cosines: &[f64]) -> Vec<f64> {
    let order = cosines.len();
    let mut sum = vec![1.0];
    let mut difference = vec![1.0];
    for (index, &cosine) in cosines.iter().enumerate() {
        let factor = [1.0, -2.0 * cosine, 1.0];
        let side = if index % 2 == 0 {
            &mut sum
        } else {
            &mut difference
        };
        *side = multiply(side, &factor);
    }
    if order.is_multiple_of(2) {
        sum = multiply(&sum, &[1.0, 1.0]);
        difference = multiply(&difference, &[1.0, -1.0]);
    } else {
        difference = multiply(&difference, &[1.0, 0.0, -1.0]);
    }
    let mut monic: Vec<f64> = sum
        .iter()
        .zip(&difference)
        .map(|(q, p)| 0.5 * (q + p))
        .collect();
    // The last coefficients of P and Q cancel exactly.
    monic.truncate(order + 1);
    monic
}

/// The largest |A(e^jω)| over the least, at the frequencies, half-way between neighbours, at 0 and at π: how exact an
/// arithmetic has to be that renders A(z). Infinite where two frequencies are the same.
#[must_use]
pub fn magnitude_range(lsf_rad: &[f64]) -> f64 {
    let cosines: Vec<f64> = lsf_rad.iter().map(|&omega| libm::cos(omega)).collect();
    let even = lsf_rad.len().is_multiple_of(2);
    let squared = |omega: f64| {
        let x = libm::cos(omega);
        let product = |first: usize| {
            let zeros = cosines.iter().skip(first).step_by(2);
            zeros.fold(1.0, |product, zero| product * 2.0 * (x - zero))
        };
        let (q, p) = (product(0).powi(2), product(1).powi(2));
        // |1 + z⁻¹|², |1 − z⁻¹|² and |1 − z⁻²|².
        if even {
            (q * 2.0 * (1.0 + x) + p * 2.0 * (1.0 - x)) / 4.0
        } else {
            (q + p * 4.0 * (1.0 - x * x)) / 4.0
        }
    };
    let all: Vec<f64> = std::iter::once(0.0)
        .chain(lsf_rad.iter().copied())
        .chain([PI])
        .collect();
    let between = all.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let (least, most) = all
        .iter()
        .copied()
        .chain(between)
        .map(squared)
        .fold((f64::INFINITY, 0.0_f64), |(least, most), squared| {
            (least.min(squared), most.max(squared))
        });
    (most / least).sqrt()
}

fn multiply(x: &[f64], y: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; x.len() + y.len() - 1];
    for (i, a) in x.iter().enumerate() {
        for (j, b) in y.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// The line spectral frequencies (rad, ascending) of the monic polynomial
/// `[1, a_1, …, a_p]`; `None` unless it is stable.
///
/// On the unit circle the sum and the difference polynomials obey three-term
/// recurrences in `x = cos(ω/2)` with positive coefficients (Delsarte and Genin,
/// "The split Levinson algorithm", 1986), hence are Sturm sequences: bisection on
/// the count of sign changes finds every root, however close it lies to the next.
#[must_use]
pub fn from_polynomial(monic: &[f64]) -> Option<Vec<f64>> {
    if monic.first() != Some(&1.0) {
        return None;
    }
    Some(from_reflection(&step_down(monic)?))
}

/// [`from_polynomial`] of the polynomial with the given reflection coefficients, all of
/// them inside (−1, 1).
#[must_use]
pub fn from_reflection(reflection: &[f64]) -> Vec<f64> {
    let order = reflection.len();
    let mut lsf_rad = vec![0.0; order];
    for (first, side) in [Side::Sum, Side::Difference].into_iter().enumerate() {
        let sequence = Sturm::new(reflection, side);
        let indices: Vec<usize> = (0..order.saturating_sub(first).div_ceil(2)).collect();
        for block in indices.chunks(LANES) {
            for (&index, root) in block.iter().zip(sequence.roots(block)) {
                lsf_rad[2 * index + first] = root;
            }
        }
    }
    lsf_rad
}

/// Returns true if the frequencies ascend strictly inside (0, π): the condition for the polynomial to be stable.
#[must_use]
pub fn is_ordered(lsf_rad: &[f64]) -> bool {
    let inside = |omega: &f64| *omega > 0.0 && *omega < PI;
    lsf_rad.iter().all(inside) && lsf_rad.windows(2).all(|pair| pair[0] < pair[1])
}

/// The frequencies moved this fraction of the way to even spacing, which is white noise. Ordered
/// frequencies stay ordered, because both ends of the way are.
#[must_use]
pub fn towards_white_noise(lsf_rad: &[f64], fraction: f64) -> Vec<f64> {
    let step = PI / (lsf_rad.len() + 1) as f64;
    let mixed = lsf_rad.iter().enumerate();
    mixed
        .map(|(index, omega)| omega + fraction * ((index + 1) as f64 * step - omega))
        .collect()
}

/// Smallest distance between neighbouring frequencies, 0 and π included, rad.
#[must_use]
pub fn smallest_gap(lsf_rad: &[f64]) -> f64 {
    let mut previous = 0.0;
    let mut gap = f64::INFINITY;
    for &omega in lsf_rad.iter().chain(&[PI]) {
        gap = gap.min(omega - previous);
        previous = omega;
    }
    gap
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::reflection::{is_stable, step_up};
    use proptest::prelude::*;

    /// Ordered LSFs with a gap no smaller than a quarter of the mean gap.
    fn ordered() -> impl Strategy<Value = Vec<f64>> {
        prop::collection::vec(0.25_f64..1.0, 2..=25).prop_map(|gaps| {
            let total: f64 = gaps.iter().sum();
            let mut omega = 0.0;
            gaps[..gaps.len() - 1]
                .iter()
                .map(|gap| {
                    omega += gap / total * PI;
                    omega
                })
                .collect()
        })
    }

    proptest! {
        #[test]
        fn the_range_of_a_magnitude_is_that_of_its_polynomial(lsf_rad in ordered()) {
            let monic = to_polynomial(&lsf_rad);
            let squares = (0..=4096).map(|n| {
                crate::signal::spectrum::squared_magnitude(&monic, PI * f64::from(n) / 4096.0)
            });
            let (least, most) = squares.fold((f64::INFINITY, 0.0_f64), |(least, most), squared| {
                (least.min(squared), most.max(squared))
            });
            let exact = (most / least).sqrt();
            let found = magnitude_range(&lsf_rad);
            prop_assert!((0.7 * exact..1.01 * exact).contains(&found), "{} for {}", found, exact);
        }

        #[test]
        fn ordered_frequencies_give_a_stable_polynomial(lsf in ordered()) {
            prop_assert!(is_stable(&to_polynomial(&lsf)));
        }

        #[test]
        fn from_polynomial_inverts_to_polynomial(lsf in ordered()) {
            let back = from_polynomial(&to_polynomial(&lsf)).expect("stable");
            prop_assert_eq!(back.len(), lsf.len());
            for (found, expected) in back.iter().zip(&lsf) {
                prop_assert!((found - expected).abs() < 1e-8, "{} for {}", found, expected);
            }
        }

        #[test]
        fn to_polynomial_inverts_from_polynomial(
            r in prop::collection::vec(-0.9_f64..0.9, 1..=24),
        ) {
            let monic = step_up(&r);
            let lsf = from_polynomial(&monic).expect("stable");
            prop_assert!(is_ordered(&lsf), "{:?}", lsf);
            let scale = monic.iter().fold(1.0_f64, |m, a| m.max(a.abs()));
            for (found, expected) in to_polynomial(&lsf).iter().zip(&monic) {
                prop_assert!((found - expected).abs() < 1e-6 * scale);
            }
        }
    }

    #[test]
    fn the_first_frequency_belongs_to_the_sum_polynomial() {
        // A = 1 + a z⁻¹: Q = 1 + 2a z⁻¹·… has its root where cos ω = −a.
        for a in [-0.9, -0.2, 0.0, 0.5] {
            let lsf = from_polynomial(&[1.0, a]).unwrap();
            assert!((libm::cos(lsf[0]) + a).abs() < 1e-12);
            assert!((to_polynomial(&lsf)[1] - a).abs() < 1e-12);
        }
    }

    #[test]
    fn zeros_next_to_the_circle_keep_their_angles() {
        // A zero pair at radius 0.999998 squeezes two LSFs together.
        let (radius, omega) = (0.999_998_f64, 1.3_f64);
        let monic = [1.0, -2.0 * radius * omega.cos(), radius * radius];
        let lsf = from_polynomial(&monic).unwrap();
        assert!(lsf.iter().all(|found| (found - omega).abs() < 1e-5));
        assert!(lsf[0] < lsf[1]);
    }

    #[test]
    fn unstable_polynomials_have_no_frequencies() {
        assert_eq!(from_polynomial(&[1.0, -2.5, 1.2]), None);
        assert_eq!(from_polynomial(&[0.5, 0.1]), None);
        assert_eq!(from_polynomial(&[1.0, f64::NAN]), None);
    }
}
