//! From the similarity of a prompt to how far its texture can be trusted.

use asperity::learned::description::CertaintyCurve;

/// Knots of a curve, at most.
const KNOTS: usize = 8;

/// The curve through trials, each a similarity and how well it went (0..=1): means of
/// groups of equal size, made monotone by pooling neighbours that are out of order.
///
/// Without trials it is certain of nothing.
#[must_use]
pub fn certainty_curve(trials: &[(f64, f64)]) -> CertaintyCurve {
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn without_trials_nothing_is_certain() {
        assert_eq!(certainty_curve(&[]).certainty, vec![0.0]);
    }
}
