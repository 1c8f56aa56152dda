//! Mean, RMS, peak and percentiles of a list of numbers.

/// Mean; 0 for an empty list.
pub(super) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values
        .into_iter()
        .fold((0.0, 0_u64), |(s, n), v| (s + v, n + 1));
    if count == 0 { 0.0 } else { sum / count as f64 }
}

/// Root mean square; 0 for an empty list.
pub(super) fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    mean(values.into_iter().map(|v| v * v)).sqrt()
}

/// Largest magnitude; 0 for an empty list.
pub(super) fn peak(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |max: f64, v| max.max(v.abs()))
}

/// The value below which a fraction `p` of the list lies, by nearest rank; 0 for an empty list.
pub(super) fn percentile(sorted: &[f64], p: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    let rank = (p.clamp(0.0, 1.0) * last as f64).round() as usize;
    sorted.get(rank).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_known_numbers() {
        assert_eq!(mean([1.0, 2.0, 6.0]), 3.0);
        assert_eq!(rms([3.0, -4.0, 0.0, 0.0]), 2.5);
        assert_eq!(peak([1.0, -7.0, 3.0]), 7.0);
        let sorted: Vec<f64> = (0..=100).map(f64::from).collect();
        assert_eq!(percentile(&sorted, 0.05), 5.0);
        assert_eq!(percentile(&sorted, 1.0), 100.0);
        assert_eq!(
            (mean([]), rms([]), peak([]), percentile(&[], 0.5)),
            (0.0, 0.0, 0.0, 0.0)
        );
    }
}
