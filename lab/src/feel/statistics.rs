//! Mean, RMS and peak of a list of numbers.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_known_numbers() {
        assert_eq!(mean([1.0, 2.0, 6.0]), 3.0);
        assert_eq!(rms([3.0, -4.0, 0.0, 0.0]), 2.5);
        assert_eq!(peak([1.0, -7.0, 3.0]), 7.0);
        assert_eq!((mean([]), rms([]), peak([])), (0.0, 0.0, 0.0));
    }
}
