//! Decibels of many powers at a time.

use multiversion::multiversion;

/// `10·log10` of a positive, normal number, to 1e-11 dB; anything else gives a number without
/// meaning, far beyond what a spectrum spans for 0, ∞ and NaN.
///
/// Compilers turn a loop over it into vector instructions, which they cannot for a call.
#[inline(always)]
#[must_use]
pub fn decibels(power: f64) -> f64 {
    /// Bits of √½, the least mantissa.
    const LEAST: u64 = 0x3FE6_A09E_667F_3BCD;
    const ONE: u64 = 0x3FF0_0000_0000_0000;
    const MANTISSA_BITS: u32 = 52;
    /// A number with these bits below is 2⁵² and the integer they are.
    const TWO_52: u64 = 0x4330_0000_0000_0000;
    let shifted = power.to_bits().wrapping_add(ONE - LEAST);
    let exponent =
        f64::from_bits(TWO_52 | shifted >> MANTISSA_BITS) - (f64::from_bits(TWO_52) + 1023.0);
    let mantissa = f64::from_bits((shifted & ((1 << MANTISSA_BITS) - 1)) + LEAST);
    // ln m = 2·artanh t, |t| ≤ 0.172.
    let t = (mantissa - 1.0) / (mantissa + 1.0);
    let square = t * t;
    let mut series = 0.0;
    for n in (0..8).rev() {
        series = series * square + 1.0 / f64::from(2 * n + 1);
    }
    10.0 / std::f64::consts::LN_10 * (exponent * std::f64::consts::LN_2 + 2.0 * t * series)
}

/// Numbers that are added up apart: what fits the registers of a processor.
const LANES: usize = 8;

/// Root of the mean square of [`decibels`]; NaN for none.
#[must_use]
pub fn rms_db(powers: &[f64]) -> f64 {
    (sum_of_squares(powers) / powers.len() as f64).sqrt()
}

/// In wider registers where there are some: element i belongs to lane i mod 8 on every processor.
#[multiversion(targets("x86_64+avx2"))]
fn sum_of_squares(powers: &[f64]) -> f64 {
    let (blocks, rest) = powers.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for block in blocks {
        add_squares(&mut sums, block);
    }
    add_squares(&mut sums, rest);
    sums.iter().sum()
}

#[inline(always)]
fn add_squares(sums: &mut [f64], powers: &[f64]) {
    for (sum, &power) in sums.iter_mut().zip(powers) {
        let db = decibels(power);
        *sum += db * db;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decibels_are_ten_times_the_logarithm() {
        for n in -3000..3000 {
            let power = 1.07_f64.powi(n);
            assert!(
                (decibels(power) - 10.0 * power.log10()).abs() < 1e-11,
                "{power}"
            );
        }
        assert_eq!(decibels(1.0), 0.0);
        for odd in [0.0, f64::INFINITY, f64::NAN] {
            assert!(decibels(odd).abs() > 3000.0);
        }
    }

    #[test]
    fn every_power_counts_once() {
        for count in 1..40 {
            let powers: Vec<f64> = (0..count).map(|n| 0.3 + f64::from(n)).collect();
            let squares = powers.iter().map(|&power| decibels(power).powi(2));
            let expected = (squares.sum::<f64>() / f64::from(count)).sqrt();
            assert!((rms_db(&powers) / expected - 1.0).abs() < 1e-14, "{count}");
        }
    }
}
