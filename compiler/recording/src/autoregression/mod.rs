//! AR and ARMA models of a stretch by the well-known methods, and how well each predicts.
//!
//! `A(z) = 1 + Σ a_k z⁻ᵏ`, `y[n] = −Σ a_k y[n−k] + e[n] + Σ b_k e[n−k]`.
//!
//! ```
//! use asperity_recording::autoregression::levinson;
//!
//! // The autocorrelation of y[n] = 0.5·y[n−1] + e[n] falls by half with every lag.
//! let model = levinson(&[1.0, 0.5]);
//! assert_eq!((model.a, model.variance), (vec![1.0, -0.5], 0.75));
//! ```

mod ar;
mod arma;
mod compare;
mod least_squares;

pub(crate) use least_squares::solve;

pub use ar::{burg, covariance, levinson, yule_walker};
pub use arma::{prediction_error, two_stage};
pub use compare::{METHODS, Method, Score, compare, information_order};

/// A model of a stretch.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// `[1, a_1, …, a_p]`.
    pub a: Vec<f64>,
    /// `[1, b_1, …, b_q]`.
    pub b: Vec<f64>,
    /// Variance of the excitation.
    pub variance: f64,
}

impl Model {
    /// What the model cannot predict of a signal, from the first sample that has a whole past.
    #[must_use]
    pub fn residual(&self, signal: &[f64]) -> Vec<f64> {
        let mut e: Vec<f64> = Vec::with_capacity(signal.len());
        for n in 0..signal.len() {
            let past = |x: &[f64], c: &[f64]| -> f64 {
                c.iter()
                    .enumerate()
                    .skip(1)
                    .take(n)
                    .map(|(k, c)| c * x[n - k])
                    .sum()
            };
            e.push(signal[n] + past(signal, &self.a) - past(&e, &self.b));
        }
        e.drain(..(self.a.len().max(self.b.len()) - 1).min(e.len()));
        e
    }
}

#[cfg(test)]
mod tests;
