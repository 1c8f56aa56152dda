//! AR models: Levinson's recursion, Yule–Walker, Burg, covariance.

use super::{Model, least_squares::solve};
use asperity_texture::signal::{levinson::recursion, reflection::is_stable};

fn ar(a: Vec<f64>, variance: f64) -> Model {
    Model {
        a,
        b: vec![1.0],
        variance,
    }
}

/// The polynomial one order higher with the reflection coefficient `k`.
fn raised(a: &[f64], k: f64) -> Vec<f64> {
    let order = a.len();
    let at = |i: usize| a.get(i).copied().unwrap_or(0.0);
    (0..=order).map(|i| at(i) + k * at(order - i)).collect()
}

/// The AR model whose autocorrelation begins with these lags. It stops at the order at which they
/// cease to be those of a signal, so it is always stable.
#[must_use]
pub fn levinson(lags: &[f64]) -> Model {
    let (a, variance) = recursion(lags);
    ar(a, variance)
}

/// Yule–Walker: Levinson's recursion on the biased autocorrelation, which is stable.
#[must_use]
pub fn yule_walker(signal: &[f64], order: usize) -> Model {
    let lags: Vec<f64> = (0..=order)
        .map(|lag| {
            signal
                .iter()
                .zip(&signal[lag.min(signal.len())..])
                .map(|(x, y)| x * y)
                .sum::<f64>()
                / signal.len() as f64
        })
        .collect();
    levinson(&lags)
}

/// Burg's method: least forward and backward error, order by order. It is stable.
#[must_use]
pub fn burg(signal: &[f64], order: usize) -> Model {
    let mut forward = signal.to_vec();
    let mut backward = signal.to_vec();
    let mut a = vec![1.0];
    let mut error = signal.iter().map(|x| x * x).sum::<f64>() / signal.len().max(1) as f64;
    for step in 1..=order.min(signal.len().saturating_sub(1)) {
        let (mut product, mut energy) = (0.0, 0.0);
        for n in step..signal.len() {
            product += forward[n] * backward[n - 1];
            energy += forward[n] * forward[n] + backward[n - 1] * backward[n - 1];
        }
        let k = if energy > 0.0 {
            -2.0 * product / energy
        } else {
            0.0
        };
        for n in (step..signal.len()).rev() {
            let (f, b) = (forward[n], backward[n - 1]);
            forward[n] = f + k * b;
            backward[n] = b + k * f;
        }
        a = raised(&a, k);
        error *= (1.0 - k) * (1.0 + k);
    }
    ar(a, error)
}

/// The covariance method: least forward error. `None` where the model is not stable.
#[must_use]
pub fn covariance(signal: &[f64], order: usize) -> Option<Model> {
    let rows = order..signal.len();
    let count = rows.len() as f64;
    let product =
        |i: usize, j: usize| -> f64 { rows.clone().map(|n| signal[n - i] * signal[n - j]).sum() };
    let matrix: Vec<Vec<f64>> = (1..=order)
        .map(|i| (1..=order).map(|j| product(i, j)).collect())
        .collect();
    let right: Vec<f64> = (1..=order).map(|i| -product(i, 0)).collect();
    let mut a = vec![1.0];
    a.extend(solve(matrix, right)?);
    let error: f64 = a.iter().enumerate().map(|(i, a)| a * product(i, 0)).sum();
    is_stable(&a).then(|| ar(a, error / count))
}
