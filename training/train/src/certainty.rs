//! From the similarity of a prompt to how far its texture can be trusted.

use asperity::learned::description::CertaintyCurve;

/// Knots of a curve, at most.
const KNOTS: usize = 8;
/// Bins of the calibration error.
const BINS: usize = 10;

/// The curve through trials, each a similarity and how well it went (0..=1): means of
/// groups of equal size, made monotone by pooling neighbours that are out of order.
///
/// Without trials it is certain of nothing.
#[must_use]
pub(crate) fn certainty_curve(trials: &[(f64, f64)]) -> CertaintyCurve {
    let mut sorted = trials.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let size = sorted.len().div_ceil(KNOTS).max(1);
    let mut groups: Vec<(f64, f64, f64)> = sorted
        .chunks(size)
        .map(|group| {
            let count = group.len() as f64;
            let mean = |value: fn(&(f64, f64)) -> f64| group.iter().map(value).sum::<f64>() / count;
            (mean(|trial| trial.0), mean(|trial| trial.1), count)
        })
        .collect();
    while let Some(index) = groups.windows(2).position(|pair| pair[0].1 >= pair[1].1) {
        let (a, b) = (groups[index], groups.remove(index + 1));
        let count = a.2 + b.2;
        let mean = |x: f64, y: f64| (x * a.2 + y * b.2) / count;
        groups[index] = (mean(a.0, b.0), mean(a.1, b.1), count);
    }
    if groups.is_empty() {
        groups.push((1.0, 0.0, 1.0));
    }
    CertaintyCurve {
        similarity: groups.iter().map(|group| group.0).collect(),
        certainty: groups.iter().map(|group| group.1).collect(),
    }
}

/// Certainty, 0..=1, of a prompt of this familiarity. It is piecewise linear, falls to zero below the first
/// knot, and is constant beyond the last.
fn certainty(curve: &CertaintyCurve, familiarity: f64) -> f64 {
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

/// Expected calibration error: |certainty − share that went well|, averaged over [`BINS`] bins of
/// certainty by how many trials each holds. Every second trial makes the curve that the others are
/// held against, and the other way round.
#[must_use]
pub(crate) fn calibration_error(trials: &[(f64, f64)]) -> f64 {
    let half = |first: usize| -> Vec<(f64, f64)> {
        let every_second = trials.iter().skip(first).step_by(2);
        every_second.copied().collect()
    };
    let halves = [half(0), half(1)];
    let mut bins = [(0.0, 0.0); BINS];
    for (known, asked) in [(&halves[0], &halves[1]), (&halves[1], &halves[0])] {
        let curve = certainty_curve(known);
        for &(similarity, well) in asked {
            let said = certainty(&curve, similarity);
            let bin = &mut bins[((said * BINS as f64) as usize).min(BINS - 1)];
            bin.0 += said;
            bin.1 += well;
        }
    }
    let apart: f64 = bins.iter().map(|(said, well)| f64::abs(said - well)).sum();
    apart / trials.len().max(1) as f64
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

    #[test]
    fn it_never_falls_and_keeps_the_mean() {
        let trials: Vec<(f64, f64)> = (0..160)
            .map(|n| (f64::from(n) / 160.0, f64::from(u8::from(n % 7 < n / 24))))
            .collect();
        let curve = certainty_curve(&trials);
        assert!(curve.certainty.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(curve.similarity.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(curve.certainty.iter().all(|c| (0.0..=1.0).contains(c)));
    }

    #[test]
    fn failure_at_high_similarity_is_pooled() {
        let curve = certainty_curve(&[(0.1, 1.0), (0.9, 0.0)]);
        assert_eq!((curve.similarity, curve.certainty), (vec![0.5], vec![0.5]));
    }

    #[test]
    fn a_certainty_that_holds_has_no_error_and_one_that_does_not_has_its_own() {
        // Every pair of neighbours is alike, so both halves say the same.
        let like = |n: u32| f64::from(u8::from(n / 2 % 10 < n / 200));
        let holds: Vec<(f64, f64)> = (0..2000).map(|n| (f64::from(n / 2), like(n))).collect();
        assert!(calibration_error(&holds) < 0.02);
        // One half goes well, the other never does.
        let fails: Vec<(f64, f64)> = (0..2000).map(|n| (0.5, f64::from(n % 2))).collect();
        assert!((calibration_error(&fails) - 1.0).abs() < 1e-9);
        assert_eq!(calibration_error(&[]), 0.0);
    }

    #[test]
    fn without_trials_nothing_is_certain() {
        assert_eq!(certainty_curve(&[]).certainty, vec![0.0]);
    }
}
