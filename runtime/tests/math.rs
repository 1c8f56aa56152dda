//! The public functions of `math` agree with f64, in every component and at every border.

use asperity_runtime::math::{
    Vec3, add, clamp_from_zero, cos_pi, cross, dot, exp, ln, max, min, norm, rounds_to_nearest,
    scale, sin_pi, sqrt, sub, tangential,
};
use asperity_tests::draw::Draw;
use std::f64::consts::PI;

/// Whole numbers up to ±16, whose sums and products are exact.
fn vector(draw: &mut Draw) -> Vec3 {
    [0; 3].map(|_| draw.below(33) as f32 - 16.0)
}

#[test]
fn products_of_vectors_are_exact_on_whole_numbers() {
    let mut draw = Draw::new(1);
    for _ in 0..500 {
        let (a, b) = (vector(&mut draw), vector(&mut draw));
        let along = |f: fn(f32, f32) -> f32| [0, 1, 2].map(|i| f(a[i], b[i]));
        let wide = |v: Vec3| v.map(f64::from);
        let (x, y) = (wide(a), wide(b));
        let inner = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        assert_eq!(f64::from(dot(a, b)), inner);
        assert_eq!(add(a, b), along(|a, b| a + b));
        assert_eq!(sub(a, b), along(|a, b| a - b));
        assert_eq!(scale(a, b[0]), a.map(|x| x * b[0]));
        // Across both, and of the length that the angle gives.
        let c = cross(a, b);
        assert_eq!([dot(a, c), dot(b, c)], [0.0; 2]);
        assert_eq!(dot(c, c), dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b));
        let root = dot(a, a).sqrt();
        assert_eq!(norm(a), root);
    }
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        assert_eq!(cross(axes[i], axes[j]), axes[k], "a right hand");
        assert_eq!(cross(axes[j], axes[i]), axes[k].map(|x| 0.0 - x));
        let mut within = [3.0, -5.0, 7.0];
        within[i] = 0.0;
        assert_eq!(tangential([3.0, -5.0, 7.0], axes[i]), within);
    }
    assert_eq!(
        tangential([5.0, 1.0, 10.0], [0.6, 0.0, 0.8]),
        [5.0 - 11.0 * 0.6, 1.0, 10.0 - 11.0 * 0.8]
    );
}

#[test]
fn the_smaller_the_larger_and_the_cut_of_numbers_that_are_none() {
    for (a, b) in [(1.0, 2.0), (-2.0, -1.0), (0.0, 3.0), (2.5, 2.5)] {
        assert_eq!([min(a, b), min(b, a)], [a; 2]);
        assert_eq!([max(a, b), max(b, a)], [b; 2]);
    }
    // Of two zeros it is the second one, whose sign is a bit like any other.
    for f in [min, max] {
        assert_eq!(f(0.0, -0.0).to_bits(), (-0.0_f32).to_bits());
        assert_eq!(f(-0.0, 0.0).to_bits(), 0);
    }
    for f in [min, max] {
        assert_eq!(f(f32::NAN, 1.0), 1.0);
        assert!(f(1.0, f32::NAN).is_nan());
    }
    for (x, cut) in [
        (-1.0, 0.0),
        (0.5, 0.5),
        (2.0, 2.0),
        (2.5, 2.0),
        (f32::NAN, 0.0),
    ] {
        assert_eq!(clamp_from_zero(x, 2.0), cut);
    }
    assert!(rounds_to_nearest());
    assert_eq!([0.0, 1.0, 2.25].map(sqrt), [0.0, 1.0, 1.5]);
    assert!(sqrt(-1.0).is_nan());
}

#[test]
fn sines_and_cosines_are_exact_where_they_should_be() {
    assert_eq!([cos_pi(0.5), sin_pi(0.0), sin_pi(1.0)], [0.0; 3]);
    for i in 0..=1000 {
        let x = i as f32 / 1000.0;
        let wide = PI * f64::from(x);
        assert!((f64::from(cos_pi(x)) - wide.cos()).abs() < 2e-7, "{x}");
        assert!((f64::from(sin_pi(x)) - wide.sin()).abs() < 2e-7, "{x}");
    }
}

#[test]
fn exponentials_and_logarithms_agree_with_f64_over_their_whole_ranges() {
    for i in -8000..=8000 {
        let x = i as f32 / 100.0;
        let exact = f64::from(x).exp();
        assert!((f64::from(exp(x)) / exact - 1.0).abs() < 1e-5, "e^{x}");
    }
    // Each binade, also those above 1.
    for exponent in -120..=120 {
        for step in 0..64 {
            let x = 2.0_f32.powi(exponent) * (1.0 + step as f32 / 64.0);
            let exact = f64::from(x).ln();
            let error = (f64::from(ln(x)) - exact).abs();
            assert!(error < 2e-6 + 1e-7 * exact.abs(), "ln {x}: {error}");
        }
    }
}
