//! Ranges of values that an axis or a colour scale can cover.

/// The smallest and the largest finite value; `None` if no value is finite.
pub(crate) fn extent(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .into_iter()
        .filter(|value| value.is_finite())
        .fold(None, |range, value| match range {
            None => Some((value, value)),
            Some((min, max)) => Some((value.min(min), value.max(max))),
        })
}

/// The range, or one near it that is finite and not empty.
pub(crate) fn widened(min: f64, max: f64) -> (f64, f64) {
    if !(min.is_finite() && max.is_finite()) {
        return (0.0, 1.0);
    }
    let span = (max - min).abs();
    let least = 1e-9 * min.abs().max(max.abs()).max(1e-9);
    if span > least {
        (min.min(max), min.max(max))
    } else if min == 0.0 {
        (0.0, 1.0)
    } else {
        (min - 0.5 * min.abs(), min + 0.5 * min.abs())
    }
}
