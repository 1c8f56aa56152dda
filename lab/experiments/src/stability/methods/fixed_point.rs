//! Coefficients in 16 bits.

/// Coefficients in saturating Q1.15, a DSP's native format with range [−1, 1 − 2⁻¹⁵].
#[must_use]
pub fn q1_15(monic: &[f64]) -> Vec<f64> {
    let step = 2.0_f64.powi(-15);
    coefficients(monic, |a| {
        (a / step).round().clamp(-32768.0, 32767.0) * step
    })
}

/// Coefficients in 16 bits with the exponent that the largest of them needs.
#[must_use]
pub fn block_16(monic: &[f64]) -> Vec<f64> {
    let largest = monic[1..].iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let step = 2.0_f64.powi(largest.log2().floor() as i32 + 1 - 15);
    coefficients(monic, |a| (a / step).round() * step)
}

fn coefficients(monic: &[f64], quantise: impl Fn(f64) -> f64) -> Vec<f64> {
    monic
        .iter()
        .enumerate()
        .map(|(k, &a)| if k == 0 { 1.0 } else { quantise(a) })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_hold_what_fits_and_only_one_saturates() {
        assert_eq!(q1_15(&[1.0, 0.25, -3.0]), [1.0, 0.25, -1.0]);
        assert_eq!(block_16(&[1.0, 0.25, -3.0]), [1.0, 0.25, -3.0]);
    }
}
