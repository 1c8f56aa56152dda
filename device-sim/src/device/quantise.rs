//! Rounding to the steps of a sensor or a converter.

/// Rounds to whole steps; a step of 0 leaves the value unchanged.
#[must_use]
pub fn to_step(value: f64, step: f64) -> f64 {
    if step > 0.0 {
        (value / step).round() * step
    } else {
        value
    }
}

/// Step of a converter with `bits` over `±peak`: `2·peak / (2^bits − 2)`.
///
/// The number of levels is odd, so zero is one of them. A converter of 0 bits is perfect.
#[must_use]
pub fn converter_step(peak: f64, bits: u32) -> f64 {
    match bits {
        0 => 0.0,
        1 => peak,
        bits => 2.0 * peak / ((1_u64 << bits.min(52)) - 2) as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_to_the_nearest_step_and_idempotent() {
        let step = 5.5e-5;
        for n in -2000..2000 {
            let value = f64::from(n) * 1.37e-6;
            let rounded = to_step(value, step);
            assert!((rounded - value).abs() <= 0.5 * step * (1.0 + 1e-12));
            assert_eq!(to_step(rounded, step), rounded);
            let count = rounded / step;
            assert!((count - count.round()).abs() < 1e-9);
        }
        assert_eq!(to_step(0.123, 0.0), 0.123);
    }

    #[test]
    fn a_converter_has_exactly_its_levels_with_zero_and_both_peaks() {
        for bits in [2_u32, 8, 12, 16] {
            let step = converter_step(3.3, bits);
            let mut levels: Vec<i64> = (-100_000..=100_000)
                .map(|n| (to_step(f64::from(n) * 3.3e-5, step) / step).round() as i64)
                .collect();
            levels.dedup();
            assert_eq!(levels.len(), (1_usize << bits) - 1);
            assert!(levels.contains(&0));
            assert!((to_step(3.3, step) - 3.3).abs() < 1e-12);
        }
    }
}
