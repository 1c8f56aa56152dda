//! Reflection coefficients: the step-down recursion, and stability by it.
//!
//! ```
//! use asperity_texture::signal::reflection::{is_stable, step_down, step_up};
//!
//! assert_eq!(step_up(&[0.5]), [1.0, 0.5]);
//! assert_eq!(step_down(&[1.0, 0.5]), Some(vec![0.5]));
//! assert!(is_stable(&[1.0, -0.999]) && !is_stable(&[1.0, -1.0]));
//! ```

use multiversion::multiversion;

/// Number of polynomials that are stepped down side by side, as many as fit a register.
pub const LANES: usize = 8;

/// Reflection coefficients of a monic polynomial `A(z) = 1 + Σ a_k z⁻ᵏ`, given as
/// `[1, a_1, …, a_p]`, from the first to the last; `None` unless every root lies
/// strictly inside the unit circle.
///
/// Convention: `A_k(z) = A_{k−1}(z) + r_k z⁻ᵏ A_{k−1}(z⁻¹)`, so `r_p = a_p`.
#[must_use]
pub fn step_down(monic: &[f64]) -> Option<Vec<f64>> {
    let order = monic.len().checked_sub(1)?;
    let mut current = monic.to_vec();
    let mut reflection = vec![0.0; order];
    for k in (1..=order).rev() {
        let r = current[k];
        if r.is_nan() || r.abs() >= 1.0 {
            return None;
        }
        reflection[k - 1] = r;
        let scale = 1.0 / ((1.0 - r) * (1.0 + r));
        // The entries i and k − i depend on each other alone, so they are replaced in place.
        for i in 0..=k / 2 {
            let (x, y) = (current[i], current[k - i]);
            current[i] = (x - r * y) * scale;
            current[k - i] = (y - r * x) * scale;
        }
    }
    Some(reflection)
}

/// The largest magnitude of a reflection coefficient of each of [`LANES`] monic polynomials, where
/// `monic[k]` are their coefficients of z⁻ᵏ. It is infinite for a polynomial that is not stable.
///
/// This is the recursion of [`step_down`], to the bit. Lanes never mix, so wider registers give
/// the same bits.
#[multiversion(targets("x86_64+avx2"))]
#[must_use]
pub fn largest_reflections(monic: &mut [[f64; LANES]]) -> [f64; LANES] {
    let mut largest = [0.0_f64; LANES];
    for k in (1..monic.len()).rev() {
        let r = monic[k];
        let mut scale = [0.0; LANES];
        for lane in 0..LANES {
            let inside = r[lane].abs() < 1.0;
            let magnitude = if inside { r[lane].abs() } else { f64::INFINITY };
            largest[lane] = largest[lane].max(magnitude);
            scale[lane] = 1.0 / ((1.0 - r[lane]) * (1.0 + r[lane]));
        }
        for i in 0..=k / 2 {
            let (x, y) = (monic[i], monic[k - i]);
            for lane in 0..LANES {
                monic[i][lane] = (x[lane] - r[lane] * y[lane]) * scale[lane];
                monic[k - i][lane] = (y[lane] - r[lane] * x[lane]) * scale[lane];
            }
        }
    }
    largest
}

/// The monic polynomial of given reflection coefficients.
#[must_use]
pub fn step_up(reflection: &[f64]) -> Vec<f64> {
    let mut current = vec![1.0];
    for &r in reflection {
        let k = current.len();
        let at = |i: usize| current.get(i).copied().unwrap_or(0.0);
        current = (0..=k).map(|i| at(i) + r * at(k - i)).collect();
        current[0] = 1.0;
    }
    current
}

/// Returns true if every root of the monic polynomial lies strictly inside the unit circle.
#[must_use]
pub fn is_stable(monic: &[f64]) -> bool {
    monic.first().is_some_and(|&first| first == 1.0) && step_down(monic).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn step_down_inverts_step_up(r in prop::collection::vec(-0.95_f64..0.95, 1..=24)) {
            let monic = step_up(&r);
            let back = step_down(&monic).expect("reflection coefficients below one are stable");
            // The recursion divides by 1 − r² at every step, so the error grows by their product.
            let growth: f64 = r.iter().map(|r| (1.0 + r.abs()) / (1.0 - r.abs())).product();
            for (found, expected) in back.iter().zip(&r) {
                prop_assert!((found - expected).abs() <= 1e-15 * (10.0 + growth));
            }
        }
    }

    #[test]
    fn side_by_side_is_one_by_one_to_the_bit() {
        let polynomial = |lane: usize| {
            let radius = 0.3 + 0.1 * lane as f64;
            step_up(&[radius, -0.7, 0.2, radius * radius, -0.4])
        };
        let mut together = [[0.0; LANES]; 6];
        for (k, row) in together.iter_mut().enumerate() {
            for (lane, coefficient) in row.iter_mut().enumerate() {
                *coefficient = polynomial(lane)[k];
            }
        }
        let largest = largest_reflections(&mut together);
        for (lane, found) in largest.into_iter().enumerate() {
            let expected = step_down(&polynomial(lane)).map_or(f64::INFINITY, |reflection| {
                reflection.iter().fold(0.0, |m: f64, r| m.max(r.abs()))
            });
            assert_eq!(found.to_bits(), expected.to_bits(), "lane {lane}");
        }
        assert_eq!(largest[7], f64::INFINITY, "one of them is not stable");
    }

    #[test]
    fn a_root_on_or_outside_the_circle_is_unstable() {
        assert!(is_stable(&[1.0, -0.999]));
        assert!(!is_stable(&[1.0, -1.0]));
        assert!(!is_stable(&[1.0, -1.6, 0.6]));
        assert!(!is_stable(&[1.0, f64::NAN]));
        assert!(!is_stable(&[]));
    }
}
