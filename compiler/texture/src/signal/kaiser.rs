//! The Kaiser window: the taper of every interpolator and filter here.

/// Shape of the window, which leaves side lobes some 80 dB below the main lobe.
pub const BETA: f64 = 8.0;

/// The window at a place from −1 to 1; zero beyond.
#[must_use]
pub fn window(x: f64) -> f64 {
    if x.abs() >= 1.0 {
        return 0.0;
    }
    bessel_i0(BETA * ((1.0 - x) * (1.0 + x)).sqrt()) / bessel_i0(BETA)
}

/// Modified Bessel function of the first kind and order 0, by its series.
#[must_use]
pub fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..60 {
        term *= quarter / f64::from(k * k);
        sum += term;
        if term < 1e-16 * sum {
            break;
        }
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
