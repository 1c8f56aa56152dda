//! From an instance, or one half of it, to a Gaussian over the latent.

use super::matrix;
use crate::{
    config::Network as Sizes,
    normaliser::{AR, TAP_VALUES},
    parameters::{Bound, Linear, Parameters, Slot, chain},
    rng::Stream,
};
use asperity::learned::description::LATENT;
use burn_tensor::{Tensor, activation::relu};

/// |log σ²| stays below this, softly: σ within e^±4.
pub(crate) const LOG_VARIANCE_BOUND: f32 = 8.0;

/// Both encoders and the posterior.
#[derive(Debug, Clone)]
pub(crate) struct Encoder {
    /// From [`AR`] values.
    pub(crate) ar: Vec<Linear>,
    /// From [`TAP_VALUES`] values.
    pub(crate) taps: Vec<Linear>,
    /// Stands in for AR features that are missing.
    pub(crate) absent_ar: Slot,
    /// Stands in for tap features that are missing.
    pub(crate) absent_taps: Slot,
    /// Joint features to μ.
    pub(crate) mean: Linear,
    /// Joint features to log σ².
    pub(crate) log_variance: Linear,
}

/// A Gaussian over the latent, a row an instance.
pub(crate) struct Posterior {
    /// μ.
    pub(crate) mean: Tensor<2>,
    /// log σ².
    pub(crate) log_variance: Tensor<2>,
}

impl Encoder {
    pub(super) fn new(into: &mut Parameters, sizes: &Sizes, stream: &mut Stream) -> Self {
        let widths = |inputs, hidden: &[usize]| [&[inputs], hidden].concat();
        let ar_widths = widths(AR, &sizes.ar_encoder);
        let tap_widths = widths(TAP_VALUES, &sizes.tap_encoder);
        let (ar_features, tap_features) = (
            ar_widths[ar_widths.len() - 1],
            tap_widths[tap_widths.len() - 1],
        );
        let joint = ar_features + tap_features;
        Self {
            ar: chain(into, "ar_encoder", &ar_widths, stream),
            taps: chain(into, "tap_encoder", &tap_widths, stream),
            absent_ar: into.add("absent_ar".into(), 1, vec![0.0; ar_features]),
            absent_taps: into.add("absent_taps".into(), 1, vec![0.0; tap_features]),
            mean: Linear::new(into, "posterior.mean", joint, LATENT, stream),
            log_variance: Linear::new(into, "posterior.log_variance", joint, LATENT, stream),
        }
    }

    /// The posterior of normalised `ar` [B, 396] and `taps` [B, 1300], where `present`
    /// [B, 2] says with ones which of them are there.
    pub(crate) fn forward(
        &self,
        bound: &Bound,
        ar: Tensor<2>,
        taps: Tensor<2>,
        present: Tensor<2>,
    ) -> Posterior {
        let either = |features: Tensor<2>, absent: Slot, column: usize| {
            let there = present.clone().narrow(1, column, 1);
            let absent = bound.get(absent);
            (features - absent.clone()) * there + absent
        };
        let ar = either(features(&self.ar, bound, ar), self.absent_ar, 0);
        let taps = either(features(&self.taps, bound, taps), self.absent_taps, 1);
        let joint = Tensor::cat(vec![ar, taps], 1);
        let log_variance = self.log_variance.forward(bound, joint.clone());
        let bound_by = f64::from(LOG_VARIANCE_BOUND);
        Posterior {
            mean: self.mean.forward(bound, joint),
            log_variance: (log_variance / bound_by).tanh() * bound_by,
        }
    }
}

fn features(layers: &[Linear], bound: &Bound, mut x: Tensor<2>) -> Tensor<2> {
    for (index, layer) in layers.iter().enumerate() {
        x = layer.forward(bound, if index == 0 { x } else { relu(x) });
    }
    x
}

impl Posterior {
    /// A sample `μ + σ·ε` for standard normal `epsilon`, [B, 64] row by row.
    pub(crate) fn sample(&self, epsilon: Vec<f32>) -> Tensor<2> {
        let epsilon = matrix(epsilon, LATENT, &self.mean.device());
        self.mean.clone() + (self.log_variance.clone() * 0.5).exp() * epsilon
    }

    /// Kullback–Leibler divergence from the standard normal, nats an instance.
    pub(crate) fn divergence(&self) -> Tensor<1> {
        let (mean, log_variance) = (self.mean.clone(), self.log_variance.clone());
        let each = log_variance.clone() + 1.0 - mean.square() - log_variance.exp();
        each.mean() * (-0.5 * LATENT as f64)
    }
}
