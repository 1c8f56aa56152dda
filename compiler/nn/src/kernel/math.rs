//! Functions of one f32, the same on every platform.

use multiversion::multiversion;

/// √x, which IEEE 754 rounds correctly on every processor.
#[allow(
    clippy::disallowed_methods,
    reason = "IEEE 754 defines the square root"
)]
pub(crate) fn sqrt(x: f32) -> f32 {
    x.sqrt()
}

/// aᵇ. Squares and square roots are computed as a product and as a root.
pub(crate) fn pow(a: f32, b: f32) -> f32 {
    if b == 2.0 {
        a * a
    } else if b == 0.5 {
        sqrt(a)
    } else {
        libm::powf(a, b)
    }
}

/// ln x.
pub(crate) fn log(x: f32) -> f32 {
    libm::logf(x)
}

/// tanh x.
pub(crate) fn tanh(x: f32) -> f32 {
    libm::tanhf(x)
}

/// 1 / (1 + e⁻ˣ), without overflow.
pub(crate) fn sigmoid(x: f32) -> f32 {
    let small = exp(-x.abs());
    let rest = small / (1.0 + small);
    if x < 0.0 { rest } else { 1.0 - rest }
}

/// eˣ of each, within 1 ulp.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn exp_all(values: &mut [f32]) {
    for x in values {
        *x = exp(*x);
    }
}

/// erf x of each, within 1.2e-7.
#[multiversion(targets("x86_64+avx2"))]
pub(crate) fn erf_all(values: &mut [f32]) {
    for x in values {
        *x = erf(*x);
    }
}

/// eˣ = 2ⁿ·eʳ, |r| ≤ ln 2 / 2, without a branch, so that the compiler can vectorise it.
#[inline(always)]
fn exp(x: f32) -> f32 {
    /// 1.5·2²³. Near it every f32 is an integer, so adding it rounds, and the low bits of the sum
    /// are n.
    const ROUND: f32 = 12_582_912.0;
    /// ln 2 in two parts. The first has few digits, so its product with n is exact.
    const LN_2: [f32; 2] = [0.693_359_4, -2.121_944_4e-4];
    // Beyond these bounds the result is 0 or infinite; a NaN stays.
    let x = if x < -105.0 { -105.0 } else { x };
    let x = if x > 90.0 { 90.0 } else { x };
    let shifted = x * std::f32::consts::LOG2_E + ROUND;
    let n = shifted - ROUND;
    let r = (x - n * LN_2[0]) - n * LN_2[1];
    // Minimax of (eʳ − 1 − r) / r², relative error of eʳ 3.1e-9.
    let p = 1.381_446_7e-3;
    let p = p * r + 8.368_781e-3;
    let p = p * r + 4.166_839_3e-2;
    let p = p * r + 0.166_665_2;
    let p = p * r + 0.499_999_94;
    let power = (p * r * r + r) + 1.0;
    // 2ⁿ is applied as two normal factors, so that results below 2⁻¹²⁶ are right too.
    let n = shifted.to_bits().wrapping_sub(ROUND.to_bits()) as i32;
    let half = n >> 1;
    power * power_of_two(half) * power_of_two(n - half)
}

/// 2ⁿ for −126 ≤ n ≤ 127.
#[inline(always)]
fn power_of_two(n: i32) -> f32 {
    f32::from_bits((n.wrapping_add(127) as u32) << 23)
}

/// erf x: a polynomial times x where x is small, else 1 − exp of a polynomial. Both are computed
/// and one is chosen, without a branch.
#[inline(always)]
fn erf(x: f32) -> f32 {
    let a = x.abs();
    // Minimax of erf(x)/x − 1 in x² up to 0.9375, relative error 5.1e-10.
    let u = x * x;
    let p = 8.267_462e-5;
    let p = p * u - 8.118_076e-4;
    let p = p * u + 5.198_83e-3;
    let p = p * u - 2.685_849_7e-2;
    let p = p * u + 0.112_836_79;
    let p = p * u - 0.376_126_32;
    let p = p * u + 0.128_379_17;
    let near = p * x + x;
    // Minimax of −ln erfc(x) up to 4, where erf is 1 in f32; error of erf 1.4e-9.
    let b = if a > 4.0 { 4.0 } else { a };
    let q = -1.929_501e-4;
    let q = q * b + 3.013_943_3e-3;
    let q = q * b - 2.211_035_6e-2;
    let q = q * b + 0.103_690_08;
    let q = q * b + 0.637_457_1;
    let q = q * b + 1.127_512_6;
    let q = q * b + 2.350_763e-4;
    let far = (1.0 - exp(-q)).copysign(x);
    if a < 0.9375 { near } else { far }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every 997th f32 of both signs, and special values.
    fn sweep() -> impl Iterator<Item = f32> {
        let finite = (0..=f32::MAX.to_bits()).step_by(997).map(f32::from_bits);
        finite
            .flat_map(|x| [x, -x])
            .chain([f32::INFINITY, f32::NEG_INFINITY])
    }

    #[test]
    fn exp_is_within_one_ulp() {
        for x in sweep() {
            let [result] = applied(exp_all, [x]);
            let exact = libm::exp(f64::from(x));
            let rounded = exact as f32;
            if !rounded.is_finite() || !result.is_finite() {
                assert_eq!(result, rounded, "exp({x})");
                continue;
            }
            let ulp = f64::from(rounded.next_up()) - f64::from(rounded);
            let error = (f64::from(result) - exact).abs() / ulp;
            assert!(error <= 1.0, "exp({x}) = {result}, {error} ulp off");
        }
    }

    #[test]
    fn erf_is_within_1_2e_7() {
        for x in sweep() {
            let [result] = applied(erf_all, [x]);
            let error = (f64::from(result) - libm::erf(f64::from(x))).abs();
            assert!(error <= 1.2e-7, "erf({x}) = {result}, {error} off");
        }
    }

    #[test]
    fn nan_stays_nan() {
        let [a, b] = applied(exp_all, [f32::NAN, 0.0]);
        assert!(a.is_nan() && b == 1.0);
        assert!(applied(erf_all, [f32::NAN])[0].is_nan());
        assert!(
            [log(f32::NAN), tanh(f32::NAN), sigmoid(f32::NAN)]
                .iter()
                .all(|x| x.is_nan())
        );
    }

    #[test]
    fn lanes_do_not_change_a_bit() {
        let values: Vec<f32> = (0..10_000).map(|i| (i - 5_000) as f32 * 0.013).collect();
        let (mut exps, mut erfs) = (values.clone(), values.clone());
        exp_all(&mut exps);
        erf_all(&mut erfs);
        for ((x, exp_x), erf_x) in values.iter().zip(exps).zip(erfs) {
            assert_eq!(exp(*x).to_bits(), exp_x.to_bits());
            assert_eq!(erf(*x).to_bits(), erf_x.to_bits());
        }
    }

    #[test]
    fn sigmoid_does_not_overflow() {
        assert_eq!(
            [sigmoid(-200.0), sigmoid(0.0), sigmoid(200.0)],
            [0.0, 0.5, 1.0]
        );
        assert_eq!(
            [pow(3.0, 2.0), pow(9.0, 0.5), pow(2.0, 3.0)],
            [9.0, 3.0, 8.0]
        );
    }

    fn applied<const N: usize>(function: impl Fn(&mut [f32]), mut values: [f32; N]) -> [f32; N] {
        function(&mut values);
        values
    }
}
