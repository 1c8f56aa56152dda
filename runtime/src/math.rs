//! Approximations from + − × ÷ and √ alone, so that every platform that rounds to nearest gives the
//! same bits.
//!
//! Coefficients are Chebyshev interpolants; the errors stated were measured over
//! the whole range by the tests below.

use crate::lanes::F4;

/// Returns true if the processor rounds to nearest, as bit-exact results of this crate require. A
/// program can change the mode for a thread; loading, configuring and a servo loop refuse that.
#[must_use]
pub fn rounds_to_nearest() -> bool {
    // Hidden, so that the compiler does not add up what it takes to be rounded to nearest.
    let [one, little] = core::hint::black_box([1.0_f32, f32::EPSILON / 8.0]);
    one + little == one && one - little == one
}

/// Three components along the world's axes.
pub type Vec3 = [f32; 3];

/// Inner product.
#[inline]
#[must_use]
pub fn dot(a: Vec3, b: Vec3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Sum.
#[inline]
#[must_use]
pub fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Difference.
#[inline]
#[must_use]
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Multiple.
#[inline]
#[must_use]
pub fn scale(a: Vec3, k: f32) -> Vec3 {
    [a[0] * k, a[1] * k, a[2] * k]
}

/// Cross product.
#[inline]
#[must_use]
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The part of `a` in the plane with unit normal `n`.
#[inline]
#[must_use]
pub fn tangential(a: Vec3, n: Vec3) -> Vec3 {
    sub(a, scale(n, dot(a, n)))
}

/// The smaller one; `b` where either is NaN.
#[inline]
#[must_use]
pub fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger one; `b` where either is NaN.
#[inline]
#[must_use]
pub fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// `x` in `0..=limit`; 0 where `x` is NaN.
#[inline]
#[must_use]
pub fn clamp_from_zero(x: f32, limit: f32) -> f32 {
    min(max(x, 0.0), limit)
}

/// √x, correctly rounded; NaN below zero. Processors that have an instruction for it use that.
#[inline(always)]
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    #[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
    return asperity_vfp::sqrt(x);
    #[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
    F4::load(&[x, 0.0, 0.0, 0.0]).sqrt().to_array()[0]
}

/// Length of a vector whose components are below 1e18.
#[inline]
#[must_use]
pub fn norm(a: Vec3) -> f32 {
    sqrt(dot(a, a))
}

/// sin(πt) for t in [−½, ½], absolute error below 2e-7.
#[inline]
#[must_use]
fn sin_pi_central(t: f32) -> f32 {
    let u = t * t;
    t * (core::f32::consts::PI
        + u * (-5.167_712_7
            + u * (2.550_163_3 + u * (-0.599_252_2 + u * (0.082_050_35 + u * -0.007_028_295_6)))))
}

/// cos(πx) for x in [0, 1], absolute error below 2e-7.
#[inline]
#[must_use]
pub fn cos_pi(x: f32) -> f32 {
    sin_pi_central(0.5 - x)
}

/// [`cos_pi`] of four numbers side by side.
#[inline(always)]
#[must_use]
pub(crate) fn cos_pi_four(x: F4) -> F4 {
    let [twice] = minus_two_cos_pi([x]);
    // Adding nothing takes its sign from a zero.
    F4::splat(-0.5) * twice + F4::ZERO
}

/// −2 cos(πx) for x in [0, 1], of fours side by side: none waits for another. It equals −2 times
/// [`cos_pi`] to the bit, except for the sign of 0, because its coefficients differ by powers of
/// two only.
#[inline(always)]
#[must_use]
pub(crate) fn minus_two_cos_pi<const N: usize>(x: [F4; N]) -> [F4; N] {
    let number = F4::splat;
    let t = x.map(|x| x + x - F4::ONE);
    let u = t.map(|t| t * t);
    let mut series = [number(-0.007_028_295_6 / 1024.0); N];
    for c in [
        0.082_050_35 / 256.0,
        -0.599_252_2 / 64.0,
        2.550_163_3 / 16.0,
        -5.167_712_7 / 4.0,
        core::f32::consts::PI,
    ] {
        for (series, &u) in series.iter_mut().zip(&u) {
            *series = number(c) + u * *series;
        }
    }
    for (series, t) in series.iter_mut().zip(t) {
        *series = t * *series;
    }
    series
}

/// sin(πx) for x in [0, 1], absolute error below 2e-7.
#[inline]
#[must_use]
pub fn sin_pi(x: f32) -> f32 {
    cos_pi(if x < 0.5 { 0.5 - x } else { x - 0.5 })
}

/// eˣ for x in [−80, 80], relative error below 1e-5; not for the tick.
#[must_use]
pub fn exp(x: f32) -> f32 {
    let scaled = x * core::f32::consts::LOG2_E;
    // Truncation of a value moved above zero rounds to the nearest integer.
    let whole = (scaled + 128.5) as i32 - 128;
    let f = scaled - whole as f32;
    let two_f = 1.0
        + f * (core::f32::consts::LN_2
            + f * (0.240_226_5
                + f * (0.055_503_27
                    + f * (0.009_618_057 + f * (0.001_340_042_8 + f * 0.000_154_614_45)))));
    two_f * f32::from_bits(((whole + 127) as u32) << 23)
}

/// ln x for normal positive x, absolute error below 2e-6 for x in [2⁻²⁴, 1].
#[inline]
#[must_use]
pub fn ln(x: f32) -> f32 {
    // x = m · 2^e with m in [√½, √2): the bits of √½ are subtracted to carry.
    let shifted = x.to_bits().wrapping_sub(0x3f35_04f3);
    let exponent = (shifted as i32) >> 23;
    let m = f32::from_bits((shifted & 0x007f_ffff).wrapping_add(0x3f35_04f3));
    let t = m - 1.0;
    let series = 1.0
        + t * (-0.499_999_96
            + t * (0.333_341_93
                + t * (-0.250_013_52
                    + t * (0.199_559_33
                        + t * (-0.165_779_93
                            + t * (0.149_774_01 + t * (-0.142_692_58 + t * 0.085_333_13)))))));
    exponent as f32 * core::f32::consts::LN_2 + t * series
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    fn worst(range: (f64, f64), f: impl Fn(f32) -> f32, g: impl Fn(f64) -> f64) -> f64 {
        (0..=200_000)
            .map(|i| {
                let x = (range.0 + (range.1 - range.0) * f64::from(i) / 200_000.0) as f32;
                (f64::from(f(x)) - g(f64::from(x))).abs()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn errors_are_as_stated() {
        use core::f64::consts::PI;
        assert!(worst((0.0, 1.0), cos_pi, |x| (PI * x).cos()) < 2e-7);
        assert!(worst((0.0, 1.0), sin_pi, |x| (PI * x).sin()) < 2e-7);
        assert!(worst((6e-8, 1.0), ln, f64::ln) < 2e-6);
        assert!(
            worst(
                (-80.0, 80.0),
                |x| exp(x) / (f64::from(x).exp() as f32),
                |_| 1.0
            ) < 1e-5
        );
        assert_eq!(sqrt(0.0), 0.0);
        assert!(norm([1e-30, 0.0, 0.0]).is_finite());
    }

    /// The root of a platform is the one that IEEE 754 asks for: no number is nearer.
    #[test]
    fn roots_are_correctly_rounded() {
        let mut bits = 1_u32;
        while bits < f32::INFINITY.to_bits() {
            let x = f32::from_bits(bits);
            let root = sqrt(x);
            let exact = f64::from(x).sqrt();
            let miss = |root: f32| (f64::from(root) - exact).abs();
            let step = |by: i32| f32::from_bits(root.to_bits().wrapping_add_signed(by));
            assert!(
                miss(root) <= miss(step(1)) && miss(root) <= miss(step(-1)),
                "{x}"
            );
            bits += 4099;
        }
    }

    #[test]
    fn four_cosines_have_the_bits_of_one() {
        for i in 0..=65536_u32 {
            let x = i as f32 / 65536.0;
            let four = cos_pi_four(F4::load(&[x, 0.3, x, 1.0])).to_array();
            assert_eq!(
                four.map(f32::to_bits),
                [x, 0.3, x, 1.0].map(|x| cos_pi(x).to_bits())
            );
        }
    }

    #[test]
    fn a_nan_is_clamped_to_zero() {
        assert_eq!(clamp_from_zero(f32::NAN, 3.0), 0.0);
        assert_eq!(clamp_from_zero(f32::INFINITY, 3.0), 3.0);
        assert_eq!(clamp_from_zero(f32::NEG_INFINITY, 3.0), 0.0);
    }
}
