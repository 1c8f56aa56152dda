//! Quotients and reciprocal roots from multiplications of 32 bits, and a division of 32 bits.

use super::rounding::round;

/// a/b·2^points, the end of the range beyond it, 0 for 0/0.
#[inline(always)]
pub(super) fn quotient(a: i32, b: u32, points: i32) -> i32 {
    if b == 0 {
        return if a == 0 {
            0
        } else if a < 0 {
            i32::MIN
        } else {
            i32::MAX
        };
    }
    let zeros = b.leading_zeros();
    let product = i64::from(a) * i64::from(reciprocal(b << zeros));
    // b is d·2^(32 − zeros), 1/d has 30 bits behind the point.
    let shift = 62 - zeros as i32 - points;
    let shifted = if shift >= 63 {
        0
    } else if shift > 0 {
        round(product, shift)
    } else {
        product.clamp(i32::MIN.into(), i32::MAX.into()) << (-shift).min(31)
    };
    shifted.clamp(i32::MIN.into(), i32::MAX.into()) as i32
}

/// 1/d for d in [½, 1) of 32 bits, in (1, 2] with 30 bits behind the point: a guess good to 15
/// bits and a Newton step.
#[inline(always)]
fn reciprocal(d: u32) -> u32 {
    // The bit that is set tells the compiler that nothing is divided by zero.
    let guess = (u32::MAX / ((d >> 16) | 0x8000)) << 14;
    let near_one = (u64::from(d) * u64::from(guess)) >> 32;
    let two = 1_u64 << 31;
    ((u64::from(guess) * (two - near_one)) >> 30) as u32
}

/// 1/√m for m in [¼, 1) of 32 bits, in (1, 2] with 30 bits behind the point: a parabola within
/// 2.4 %, and three Newton steps.
#[inline(always)]
pub(crate) fn reciprocal_root(m: u32) -> u32 {
    const fn q30(x: f64) -> u32 {
        (x * (1_u64 << 30) as f64) as u32
    }
    let high = |a: u32, b: u32| ((u64::from(a) * u64::from(b)) >> 32) as u32;
    let slope = q30(3.279_408_14) - high(q30(1.634_450_86), m);
    let mut r = q30(2.668_863_66) - high(slope, m);
    for _ in 0..3 {
        // r·(3 − m·r²)/2
        let left = (3 << 28) - high(high(r, r), m);
        r = ((u64::from(r) * u64::from(left)) >> 29) as u32;
    }
    r
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    /// Numbers from 1 to 2³² − 1, by 0.1 % and one apart.
    fn numbers() -> impl Iterator<Item = u32> {
        std::iter::successors(Some(1_u32), |&n| n.checked_add(n / 1000 + 1))
    }

    #[test]
    fn reciprocals_are_good_to_29_bits() {
        let worst = (numbers().map(|n| n | 1 << 31))
            .map(|d| {
                let exact = 2_f64.powi(62) / f64::from(d);
                (f64::from(reciprocal(d)) / exact - 1.0).abs()
            })
            .fold(0.0, f64::max);
        assert!(worst < 2_f64.powi(-29), "{worst}");
    }

    #[test]
    fn reciprocal_roots_are_good_to_27_bits() {
        let worst = (numbers().filter(|&m| m >= 1 << 30))
            .map(|m| {
                let exact = 2_f64.powi(46) / f64::from(m).sqrt();
                (f64::from(reciprocal_root(m)) / exact - 1.0).abs()
            })
            .fold(0.0, f64::max);
        assert!(worst < 2_f64.powi(-27), "{worst}");
    }

    #[test]
    fn quotients_are_rounded_or_at_the_end_of_the_range() {
        for a in numbers().step_by(37).map(|a| (a >> 1) as i32) {
            for b in numbers().step_by(41) {
                for points in [-4, 0, 9, 30] {
                    let exact = f64::from(a) / f64::from(b) * 2_f64.powi(points);
                    let clamped = exact.clamp(f64::from(i32::MIN), f64::from(i32::MAX));
                    for sign in [1, -1] {
                        let found = f64::from(quotient(sign * a, b, points));
                        let wanted = f64::from(sign) * clamped;
                        let error = (found - wanted).abs();
                        assert!(
                            error <= 0.501 + 4e-9 * clamped.abs(),
                            "{a}/{b}·2^{points}: {found}, {wanted}"
                        );
                    }
                }
            }
        }
        assert_eq!(quotient(0, 0, 30), 0);
        assert_eq!(quotient(1, 0, 30), i32::MAX);
        assert_eq!(quotient(-1, 0, 30), i32::MIN);
    }
}
