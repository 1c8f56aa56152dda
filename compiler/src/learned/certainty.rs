//! How certain a texture is, from the distance of its prompt to anything trained.

use super::description::CertaintyCurve;

/// Certainty, 0..=1, of a prompt of this familiarity. It is piecewise linear, falls to zero below the first knot, and is constant beyond
/// the last.
#[must_use]
pub fn certainty(curve: &CertaintyCurve, familiarity: f64) -> f64 {
    let (x, y) = (&curve.similarity, &curve.certainty);
    let Some(after) = x.iter().position(|&knot| familiarity < knot) else {
        return y.last().copied().unwrap_or(0.0);
    };
    if after == 0 {
        return y[0] * (familiarity / x[0]).clamp(0.0, 1.0);
    }
    let share = (familiarity - x[after - 1]) / (x[after] - x[after - 1]);
    y[after - 1] + share * (y[after] - y[after - 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_linear_between_knots_flat_above_and_falls_to_nothing_below() {
        let curve = CertaintyCurve {
            similarity: vec![0.2, 0.4, 0.6],
            certainty: vec![0.1, 0.5, 0.9],
        };
        for (similarity, expected) in [
            (-1.0, 0.0),
            (0.1, 0.05),
            (0.2, 0.1),
            (0.3, 0.3),
            (0.5, 0.7),
            (0.9, 0.9),
        ] {
            assert!((certainty(&curve, similarity) - expected).abs() < 1e-12);
        }
    }
}
