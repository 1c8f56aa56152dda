//! The Kaiser window: the taper of every interpolator and filter here.
//!
//! ```
//! use asperity_texture::signal::kaiser;
//!
//! assert_eq!((kaiser::window(0.0), kaiser::window(1.0)), (1.0, 0.0));
//! assert!(kaiser::window(0.5) < 1.0);
//! ```

/// Shape of the window, which leaves side lobes some 80 dB below the main lobe.
pub const BETA: f64 = 8.0;
/// Terms below this share of the sum change no bit of it.
const EXACT: f64 = 1e-16;

/// The window at a place from −1 to 1; zero beyond.
#[must_use]
pub fn window(x: f64) -> f64 {
    if x.abs() >= 1.0 {
        return 0.0;
    }
    bessel_i0(BETA * ((1.0 - x) * (1.0 + x)).sqrt(), EXACT) / bessel_i0(BETA, EXACT)
}

/// Modified Bessel function of the first kind and order 0, by its power series, up to the first term
/// that is no more than `tolerance` of the sum.
#[must_use]
pub fn bessel_i0(x: f64, tolerance: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum, mut k) = (1.0, 1.0, 1.0);
    while term > tolerance * sum {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

/// `sin(πx)/(πx)`.
#[must_use]
pub fn sinc(x: f64) -> f64 {
    let angle = std::f64::consts::PI * x;
    if angle.abs() < 1e-9 {
        1.0
    } else {
        libm::sin(angle) / angle
    }
}
