//! The stability of a filter, by the step-down recursion, and how much rounding it bears.

use std::f64::consts::PI;

/// Largest magnitude of the reflection coefficients of A(z) = 1 + Σ a_k z⁻ᵏ. The filter is
/// stable if and only if it is below 1. NaN and infinities give infinity.
///
/// # Panics
/// If the order exceeds 24.
#[must_use]
pub fn largest_reflection(coefficients: &[f32]) -> f64 {
    let mut a = [0.0; 24];
    for (a, c) in a.iter_mut().zip(coefficients) {
        *a = f64::from(*c);
    }
    let mut largest = 0.0_f64;
    for order in (0..coefficients.len()).rev() {
        let k = a[order];
        if !k.is_finite() {
            return f64::INFINITY;
        }
        if k.abs() >= 1.0 {
            return k.abs();
        }
        largest = largest.max(k.abs());
        let above = a;
        for i in 0..order {
            a[i] = (above[i] - k * above[order - 1 - i]) / (1.0 - k * k);
        }
    }
    largest
}

/// The least and the largest |A(e^jω)| of the filter whose LSFs have these cosines, from a search of eight points
/// between neighbours: within 2 % of the exact ones.
#[must_use]
pub fn magnitudes(cosines: &[f64]) -> (f64, f64) {
    let even = cosines.len().is_multiple_of(2);
    let magnitude = |omega: f64| {
        let product = |first: usize| {
            let factors = cosines.iter().skip(first).step_by(2);
            factors.fold(1.0, |product, x| product * 2.0 * (omega.cos() - x))
        };
        let (q, p) = if even {
            (
                2.0 * (omega / 2.0).cos() * product(0),
                2.0 * (omega / 2.0).sin() * product(1),
            )
        } else {
            (product(0), 2.0 * omega.sin() * product(1))
        };
        q.hypot(p) / 2.0
    };
    let lines = cosines.iter().map(|x| x.acos());
    let points: Vec<f64> = [0.0].into_iter().chain(lines).chain([PI]).collect();
    let between = points.windows(2).flat_map(|gap| {
        (0..=8).map(|eighth| magnitude(gap[0] + (gap[1] - gap[0]) * f64::from(eighth) / 8.0))
    });
    between.fold((f64::INFINITY, 0.0), |(least, most), magnitude| {
        (least.min(magnitude), most.max(magnitude))
    })
}

#[cfg(test)]
mod tests {
    use super::{largest_reflection, magnitudes};

    /// 1 − r z⁻¹ has the LSF arccos r and its extremes, 1 ∓ r, at ω = 0 and π; the LSFs of 1 are evenly spaced.
    #[test]
    fn the_magnitudes_of_filters_that_are_known() {
        for r in [0.0, 0.5, 0.9, -0.99] {
            let (least, most) = magnitudes(&[r]);
            assert!((least - (1.0 - f64::abs(r))).abs() < 1e-9, "{r}");
            assert!((most - (1.0 + f64::abs(r))).abs() < 1e-9, "{r}");
        }
        let (least, most) = magnitudes(&[0.5, -0.5]);
        assert!((least - 1.0).abs() < 1e-9 && (most - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_unit_circle_is_the_border() {
        for radius in [0.5_f32, 0.9, 0.99, 0.999] {
            // A pole pair at ±60°, and its mirror image outside the unit circle.
            assert!(largest_reflection(&[-radius, radius * radius]) < 1.0);
            let outside = 1.0 / radius;
            assert!(largest_reflection(&[-outside, outside * outside]) > 1.0);
        }
        assert!(largest_reflection(&[f32::NAN, 0.0]).is_infinite());
        assert!(largest_reflection(&[0.0, f32::INFINITY]).is_infinite());
        assert_eq!(largest_reflection(&[0.0; 24]), 0.0);
    }
}
