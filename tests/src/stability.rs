//! The stability of a filter, by the step-down recursion.

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

#[cfg(test)]
mod tests {
    use super::largest_reflection;

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
