//! The roots of a polynomial, all at once, by the Ehrlich–Aberth iteration.

use num_complex::Complex64;

const MAX_ITERATIONS: usize = 200;

/// The roots in z of `c_0 + c_1 z⁻¹ + … + c_p z⁻ᵖ`, that is of `c_0 zᵖ + … + c_p`.
///
/// There are `p` roots for finite coefficients with `c_0 ≠ 0`, and none otherwise. Simple roots are
/// accurate to rounding, clusters of m roots to about the m-th root of that, which is enough for a
/// plot. Aberth, "Iteration methods for finding all zeros of a polynomial simultaneously", 1973.
pub(super) fn roots_of(coefficients: &[f64]) -> Vec<Complex64> {
    let degree = coefficients.len().saturating_sub(1);
    let usable = coefficients.iter().all(|c| c.is_finite());
    if !usable || coefficients.first().is_none_or(|&c| c == 0.0) {
        return Vec::new();
    }
    // Starting points inside the unit circle, not symmetric about the real axis.
    let mut roots: Vec<Complex64> = (0..degree)
        .map(|k| {
            let angle = std::f64::consts::TAU * (k as f64 + 0.35) / degree as f64;
            Complex64::from_polar(0.8, angle)
        })
        .collect();
    for _ in 0..MAX_ITERATIONS {
        let mut largest_step = 0.0_f64;
        for k in 0..degree {
            let z = roots[k];
            let (value, slope) = value_and_slope(coefficients, z);
            if value.norm() == 0.0 {
                continue;
            }
            let newton = value / slope;
            let repulsion: Complex64 = (0..degree)
                .filter(|&other| other != k && roots[other] != z)
                .map(|other| (z - roots[other]).inv())
                .sum();
            let step = newton / (1.0 - newton * repulsion);
            if step.is_finite() {
                roots[k] -= step;
                largest_step = largest_step.max(step.norm());
            }
        }
        if largest_step < 1e-14 {
            break;
        }
    }
    roots
}

/// Value and derivative of `c_0 zᵖ + … + c_p` by Horner's rule.
fn value_and_slope(coefficients: &[f64], z: Complex64) -> (Complex64, Complex64) {
    let zero = Complex64::new(0.0, 0.0);
    coefficients
        .iter()
        .fold((zero, zero), |(value, slope), &c| {
            (value * z + c, slope * z + value)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(roots: &[Complex64]) -> Vec<f64> {
        let mut coefficients = vec![Complex64::new(1.0, 0.0)];
        for root in roots {
            let mut next = coefficients.clone();
            next.push(Complex64::new(0.0, 0.0));
            for (k, c) in coefficients.iter().enumerate() {
                next[k + 1] -= c * root;
            }
            coefficients = next;
        }
        coefficients.iter().map(|c| c.re).collect()
    }

    fn farthest(expected: &[Complex64], found: &[Complex64]) -> f64 {
        expected
            .iter()
            .map(|e| {
                found
                    .iter()
                    .map(|f| (e - f).norm())
                    .fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max)
    }

    /// Claim: at every order up to 24 the conjugate pairs that a polynomial was made of are found to
    /// within a hundredth of a pixel.
    #[test]
    fn roots_come_back_at_every_order() {
        for order in 1..=24_usize {
            let mut expected = Vec::new();
            for pair in 0..order / 2 {
                let t = (pair as f64 + 0.7) / (order as f64 / 2.0 + 0.5);
                let radius = 0.75 + 0.23 * ((pair * 7 % 5) as f64 / 5.0);
                let root = Complex64::from_polar(radius, std::f64::consts::PI * t);
                expected.extend([root, root.conj()]);
            }
            if order % 2 == 1 {
                expected.push(Complex64::new(-0.97, 0.0));
            }
            let found = roots_of(&polynomial(&expected));
            assert_eq!(found.len(), order);
            let error = farthest(&expected, &found);
            assert!(error < 1e-5, "order {order}: {error}");
        }
    }

    /// Claim: double roots and roots at zero are found, and invalid polynomials have no roots.
    #[test]
    fn degenerate_polynomials() {
        let double = [Complex64::new(-1.0, 0.0); 2];
        assert!(farthest(&double, &roots_of(&[1.0, 2.0, 1.0])) < 1e-6);
        let origin = [Complex64::new(0.0, 0.0)];
        assert!(farthest(&origin, &roots_of(&[1.0, -0.5, 0.0, 0.0])) < 1e-3);
        assert!(roots_of(&[1.0]).is_empty());
        assert!(roots_of(&[]).is_empty());
        assert!(roots_of(&[0.0, 1.0]).is_empty());
        assert!(roots_of(&[1.0, f64::NAN]).is_empty());
    }
}
