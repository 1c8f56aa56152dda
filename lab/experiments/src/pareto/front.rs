//! The Pareto front: points that no other point beats.

/// Coordinates whose ratio is smaller than this count as equal: 2 %.
const TIE: f64 = 1.02;

/// Returns true if no other point is at most as large in both coordinates and smaller in one.
///
/// Coordinates within 2 % of each other count as equal.
#[must_use]
pub fn on_front(points: &[(f64, f64)], index: usize) -> bool {
    let (x, y) = points[index];
    !points
        .iter()
        .any(|&(a, b)| a <= x * TIE && b <= y * TIE && (a * TIE < x || b * TIE < y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points = [
            (1.0, 5.0),
            (2.0, 2.0),
            (3.0, 1.99),
            (4.0, 1.0),
            (4.01, 1.01),
        ];
        let found: Vec<bool> = (0..5).map(|i| on_front(&points, i)).collect();
        assert_eq!(found, [true, true, false, true, true]);
    }
}
