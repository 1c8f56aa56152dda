//! Which method predicts best what it has not seen.

use super::{Model, burg, covariance, prediction_error, two_stage, yule_walker};
use serde::Serialize;

/// A way to a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// [`yule_walker`].
    YuleWalker,
    /// [`burg`].
    Burg,
    /// [`covariance`].
    Covariance,
    /// [`two_stage`].
    TwoStage,
    /// [`prediction_error`] from the two-stage model.
    PredictionError,
}

/// All of them.
pub const METHODS: [Method; 5] = [
    Method::YuleWalker,
    Method::Burg,
    Method::Covariance,
    Method::TwoStage,
    Method::PredictionError,
];

impl Method {
    /// The model of a stretch. ARMA models have `order`/2 coefficients on each side, as many as AR
    /// models in all.
    #[must_use]
    pub fn fit(self, signal: &[f64], order: usize) -> Option<Model> {
        let half = (order / 2).max(1);
        match self {
            Self::YuleWalker => Some(yule_walker(signal, order)),
            Self::Burg => Some(burg(signal, order)),
            Self::Covariance => covariance(signal, order),
            Self::TwoStage => two_stage(signal, half, half),
            Self::PredictionError => prediction_error(signal, &two_stage(signal, half, half)?),
        }
    }
}

/// How a method does: the mean prediction error of second halves by models of first halves, dB
/// relative to their variance, and the part of the stretches of which it gave a stable model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Score {
    /// The method.
    pub method: Method,
    /// Mean held-out error, dB.
    pub error_db: f64,
    /// Stable models, 0..=1.
    pub stable: f64,
}

/// Scores of all methods over stretches.
#[must_use]
pub fn compare<'a>(stretches: impl Iterator<Item = &'a [f64]> + Clone, order: usize) -> Vec<Score> {
    let power = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>() / x.len().max(1) as f64;
    METHODS
        .into_iter()
        .map(|method| {
            let (mut sum, mut stable, mut all) = (0.0, 0.0, 0.0);
            for stretch in stretches.clone() {
                let (seen, held_out) = stretch.split_at(stretch.len() / 2);
                all += 1.0;
                if let Some(model) = method.fit(seen, order) {
                    stable += 1.0;
                    sum += 10.0
                        * libm::log10(
                            power(&model.residual(held_out)) / power(held_out).max(1e-300),
                        );
                }
            }
            Score {
                method,
                error_db: if stable > 0.0 { sum / stable } else { 0.0 },
                stable: stable / f64::max(all, 1.0),
            }
        })
        .collect()
}

/// The AR order with the least Bayesian information criterion, of errors by order from 0.
#[must_use]
pub fn information_order(variances: &[f64], samples: f64) -> usize {
    let criterion =
        |order: usize| samples * libm::log(variances[order]) + order as f64 * libm::log(samples);
    (0..variances.len())
        .min_by(|&a, &b| criterion(a).total_cmp(&criterion(b)))
        .unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::noise::white;
    use asperity_texture::signal::reflection::is_stable;

    /// Gaussian enough noise through A(z) and B(z).
    fn synthetic(a: &[f64], b: &[f64], count: usize) -> Vec<f64> {
        let e = white(1, count, 12);
        let mut y: Vec<f64> = Vec::new();
        for n in 0..count {
            let past = |x: &[f64], c: &[f64]| -> f64 {
                c.iter()
                    .enumerate()
                    .skip(1)
                    .take(n)
                    .map(|(k, c)| c * x[n - k])
                    .sum()
            };
            y.push(e[n] + past(&e, b) - past(&y, a));
        }
        y
    }

    #[test]
    fn every_method_finds_the_model_that_made_a_signal() {
        let a = [1.0, -1.2, 0.8];
        let signal = synthetic(&a, &[1.0], 20_000);
        for model in [
            yule_walker(&signal, 2),
            burg(&signal, 2),
            covariance(&signal, 2).expect("stable"),
        ] {
            for (found, expected) in model.a.iter().zip(&a) {
                assert!((found - expected).abs() < 0.03, "{:?}", model.a);
            }
            assert!((model.variance - 1.0).abs() < 0.05);
        }
        let b = [1.0, 0.5, 0.2];
        let signal = synthetic(&a, &b, 20_000);
        let first = two_stage(&signal, 2, 2).expect("stable");
        let best = prediction_error(&signal, &first).expect("stable");
        assert!(best.variance <= first.variance);
        for (found, expected) in best.a.iter().chain(&best.b).zip(a.iter().chain(&b)) {
            assert!((found - expected).abs() < 0.05, "{best:?}");
        }
    }

    #[test]
    fn burg_and_yule_walker_are_stable_on_anything() {
        for length in [4, 30, 300] {
            let ramp: Vec<f64> = (0..length).map(f64::from).collect();
            for model in [burg(&ramp, 3), yule_walker(&ramp, 3)] {
                assert!(is_stable(&model.a), "{:?}", model.a);
            }
        }
    }

    #[test]
    fn the_information_criterion_finds_the_order() {
        let signal = synthetic(&[1.0, -1.2, 0.8, -0.3], &[1.0], 5000);
        let variances: Vec<f64> = (0..12).map(|order| burg(&signal, order).variance).collect();
        assert_eq!(information_order(&variances, 5000.0), 3);
    }
}
