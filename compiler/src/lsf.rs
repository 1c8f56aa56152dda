//! Line spectral frequencies in f64: to a polynomial, and back.
//!
//! With `A(z)` monic of order p, `Q(z) = A(z) + z⁻⁽ᵖ⁺¹⁾A(z⁻¹)` is the sum polynomial
//! and `P(z) = A(z) − z⁻⁽ᵖ⁺¹⁾A(z⁻¹)` the difference polynomial, so `A = (P + Q)/2`.
//! The roots of both lie on the unit circle where A is stable, and alternate; their
//! angles in (0, π) are the LSFs, the first of which belongs to Q.

use crate::reflection::step_down;
use multiversion::multiversion;
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

/// Roots that are sought side by side: what fits the registers of a processor.
const LANES: usize = 8;
/// Halvings of [0, 1]: to the last bit of a number near 1.
const HALVINGS: usize = 54;
/// A step that small is rounding.
const PRECISION: f64 = f64::EPSILON;

#[derive(Clone, Copy, PartialEq)]
enum Side {
    Sum,
    Difference,
}

/// `s_{k+1}(x) = 2x·s_k(x) − α_k·s_{k−1}(x)` from `s₀ = 1`, all α positive.
struct Sturm {
    alpha: Vec<f64>,
}

impl Sturm {
    fn new(reflection: &[f64], side: Side) -> Self {
        let sign = if side == Side::Sum { 1.0 } else { -1.0 };
        let r = |k: usize| {
            if k == 0 {
                0.0
            } else {
                sign * reflection[k - 1]
            }
        };
        // S₀ = 2, S₁ = 1 + z⁻¹; the difference side, freed of its factor 1 − z⁻¹,
        // starts one order later.
        let first = if side == Side::Sum { 1 } else { 2 };
        let mut alpha: Vec<f64> = (first..=reflection.len())
            .map(|k| (1.0 - r(k)) * (1.0 + r(k - 1)))
            .collect();
        if side == Side::Sum
            && let Some(first) = alpha.first_mut()
        {
            *first *= 2.0;
        }
        Self { alpha }
    }

    /// The angles of roots, numbered from the smallest angle.
    ///
    /// Halvings until every root is alone in its bracket, then Newton's method inside it.
    fn roots(&self, indices: &[usize]) -> impl Iterator<Item = f64> {
        let mut brackets = Brackets::around(indices);
        for _ in 0..HALVINGS {
            let middle = brackets.middle();
            brackets.keep(&middle, &roots_beyond(&self.alpha, &middle));
            if brackets.are_isolating() {
                break;
            }
        }
        let mut x = brackets.middle();
        for _ in 0..HALVINGS {
            let (value, slope) = value_and_slope(&self.alpha, &x);
            let before = x;
            x = brackets.newton(&x, &value, &slope);
            if (0..LANES).all(|lane| (x[lane] - before[lane]).abs() <= PRECISION) {
                break;
            }
        }
        (0..indices.len()).map(move |lane| 2.0 * libm::acos(x[lane]))
    }
}

/// Where the roots of [`LANES`] indices lie.
struct Brackets {
    index: [f64; LANES],
    low: [f64; LANES],
    high: [f64; LANES],
    /// Roots beyond either end.
    beyond_low: [f64; LANES],
    beyond_high: [f64; LANES],
}

impl Brackets {
    /// [0, 1] for every index; lanes without one repeat the first.
    fn around(indices: &[usize]) -> Self {
        let index = std::array::from_fn(|lane| indices.get(lane).map_or(indices[0], |i| *i) as f64);
        Self {
            index,
            low: [0.0; LANES],
            high: [1.0; LANES],
            beyond_low: [f64::INFINITY; LANES],
            beyond_high: [0.0; LANES],
        }
    }

    fn middle(&self) -> [f64; LANES] {
        std::array::from_fn(|lane| 0.5 * (self.low[lane] + self.high[lane]))
    }

    /// Whether every bracket holds one root.
    fn are_isolating(&self) -> bool {
        (0..LANES).all(|lane| self.beyond_low[lane] - self.beyond_high[lane] == 1.0)
    }

    /// Keeps the side of x where the root is, given how many roots lie beyond x.
    fn keep(&mut self, x: &[f64; LANES], beyond: &[f64; LANES]) {
        for lane in 0..LANES {
            if beyond[lane] > self.index[lane] {
                (self.low[lane], self.beyond_low[lane]) = (x[lane], beyond[lane]);
            } else {
                (self.high[lane], self.beyond_high[lane]) = (x[lane], beyond[lane]);
            }
        }
    }

    /// A step of Newton's method from x; where it would leave the bracket, a halving.
    fn newton(
        &mut self,
        x: &[f64; LANES],
        value: &[f64; LANES],
        slope: &[f64; LANES],
    ) -> [f64; LANES] {
        std::array::from_fn(|lane| {
            // Positive beyond the first root, negative beyond the second, and so on.
            let is_even = self.index[lane] % 2.0 == 0.0;
            if (value[lane] < 0.0) == is_even {
                self.low[lane] = x[lane];
            } else {
                self.high[lane] = x[lane];
            }
            let (low, high) = (self.low[lane], self.high[lane]);
            let next = x[lane] - value[lane] / slope[lane];
            if low <= next && next <= high {
                next
            } else {
                0.5 * (low + high)
            }
        })
    }
}

/// Of every x in [0, 1] the number of roots with a larger one, that is with a smaller angle.
///
/// No lane meets another: wider registers give the same bits.
#[multiversion(targets("x86_64+avx2"))]
fn roots_beyond(alpha: &[f64], x: &[f64; LANES]) -> [f64; LANES] {
    let mut before = [1.0; LANES];
    let mut here = x.map(|x| 2.0 * x);
    let mut was_negative = [0.0; LANES];
    let mut count = [0.0; LANES];
    for alpha in alpha {
        for lane in 0..LANES {
            let next = 2.0 * x[lane] * here[lane] - alpha * before[lane];
            // A zero counts as positive: the next one has the sign opposite to the last.
            // Counted in f64, for which there are lanes everywhere.
            let negative = if next < 0.0 { 1.0 } else { 0.0_f64 };
            count[lane] += (negative - was_negative[lane]).abs();
            was_negative[lane] = negative;
            before[lane] = here[lane];
            here[lane] = next;
        }
    }
    count
}

/// The last of the sequence and its derivative at every x.
#[multiversion(targets("x86_64+avx2"))]
fn value_and_slope(alpha: &[f64], x: &[f64; LANES]) -> ([f64; LANES], [f64; LANES]) {
    let (mut before, mut here) = ([1.0; LANES], [0.0; LANES]);
    let (mut slope_before, mut slope) = ([0.0; LANES], [2.0; LANES]);
    for lane in 0..LANES {
        here[lane] = 2.0 * x[lane];
    }
    for alpha in alpha {
        for lane in 0..LANES {
            let twice = 2.0 * x[lane];
            let next = twice * here[lane] - alpha * before[lane];
            let next_slope = twice * slope[lane] + 2.0 * here[lane] - alpha * slope_before[lane];
            (before[lane], here[lane]) = (here[lane], next);
            (slope_before[lane], slope[lane]) = (slope[lane], next_slope);
        }
    }
    (here, slope)
}

/// Whether the frequencies ascend strictly inside (0, π): the condition for the
/// polynomial to be stable.
#[must_use]
pub fn is_ordered(lsf_rad: &[f64]) -> bool {
    let inside = |omega: &f64| *omega > 0.0 && *omega < PI;
    lsf_rad.iter().all(inside) && lsf_rad.windows(2).all(|pair| pair[0] < pair[1])
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
    use crate::reflection::{is_stable, step_up};
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

    proptest! {
        #[test]
        fn a_frequency_is_where_the_count_of_roots_changes(
            r in prop::collection::vec(-0.99_f64..0.99, 1..=24),
        ) {
            let lsf = from_reflection(&r);
            for (n, omega) in lsf.iter().enumerate() {
                let side = if n % 2 == 0 { Side::Sum } else { Side::Difference };
                let alpha = Sturm::new(&r, side).alpha;
                let x = libm::cos(0.5 * omega);
                let beyond = |x: f64| roots_beyond(&alpha, &[x; LANES])[0];
                prop_assert!(beyond(x + 1e-13) <= (n / 2) as f64, "{:?}", r);
                prop_assert!(beyond(x - 1e-13) > (n / 2) as f64, "{:?}", r);
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
