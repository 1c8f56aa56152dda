//! Where text and texture meet.

use super::Mode;
use crate::{
    parameters::{Bound, Linear, Parameters, Slot, chain, read},
    rng::Stream,
};
use asperity::learned::description::LATENT;
use burn_tensor::{Tensor, activation::relu};

const NORM_EPSILON: f64 = 1e-5;
/// Share of a batch in the running statistics.
const NORM_MOMENTUM: f32 = 0.1;

/// From a caption's vector to the latent.
#[derive(Debug, Clone)]
pub(crate) struct TextProjection {
    /// ReLU between them.
    pub(crate) layers: Vec<Linear>,
}

impl TextProjection {
    /// Hidden layers between vectors of `width` and the latent.
    pub(crate) fn new(
        into: &mut Parameters,
        width: usize,
        hidden: &[usize],
        stream: &mut Stream,
    ) -> Self {
        let widths = [&[width], hidden, &[LATENT]].concat();
        Self {
            layers: chain(into, "text", &widths, stream),
        }
    }

    /// ẑ [B, 64] of vectors [B, W].
    pub(crate) fn forward(
        &self,
        bound: &Bound,
        mut x: Tensor<2>,
        mode: &mut Mode<'_>,
    ) -> Tensor<2> {
        for (index, layer) in self.layers.iter().enumerate() {
            if index > 0 {
                x = mode.drop_out(relu(x));
            }
            x = layer.forward(bound, x);
        }
        x
    }
}

/// The latent's side of the contrastive loss: 64 → hidden → 64, batch-normalised.
#[derive(Debug, Clone)]
pub(crate) struct LatentProjection {
    first: Linear,
    scale: Slot,
    shift: Slot,
    running_mean: Slot,
    running_variance: Slot,
    second: Linear,
}

/// Mean and variance of a batch, a column each.
pub(crate) struct BatchStatistics {
    mean: Tensor<2>,
    variance: Tensor<2>,
}

impl LatentProjection {
    pub(super) fn new(into: &mut Parameters, hidden: usize, stream: &mut Stream) -> Self {
        let name = |what: &str| format!("latent_projection.norm.{what}");
        Self {
            first: Linear::new(into, "latent_projection.0", LATENT, hidden, stream),
            scale: into.add(name("weight"), 1, vec![1.0; hidden]),
            shift: into.add(name("bias"), 1, vec![0.0; hidden]),
            running_mean: into.add(name("running_mean"), 1, vec![0.0; hidden]),
            running_variance: into.add(name("running_var"), 1, vec![1.0; hidden]),
            second: Linear::new(into, "latent_projection.1", hidden, LATENT, stream),
        }
    }

    /// Projections [B, 64] of latents while training, normalised by their own batch.
    pub(crate) fn forward(
        &self,
        bound: &Bound,
        z: Tensor<2>,
        mode: &mut Mode<'_>,
    ) -> (Tensor<2>, BatchStatistics) {
        let x = self.first.forward(bound, z);
        let mean = x.clone().mean_dim(0);
        let centred = x - mean.clone();
        let variance = centred.clone().square().mean_dim(0);
        let normal = centred / (variance.clone() + NORM_EPSILON).sqrt();
        let x = relu(normal * bound.get(self.scale) + bound.get(self.shift));
        let x = self.second.forward(bound, mode.drop_out(x));
        (x, BatchStatistics { mean, variance })
    }

    /// Moves the running statistics towards those of a batch.
    pub(crate) fn observe(&self, parameters: &mut Parameters, batch: BatchStatistics) {
        let pairs = [
            (self.running_mean, batch.mean),
            (self.running_variance, batch.variance),
        ];
        for (slot, tensor) in pairs {
            let new = read(tensor.inner()).unwrap_or_default();
            for (running, new) in parameters.get_mut(slot).values.iter_mut().zip(new) {
                *running += NORM_MOMENTUM * (new - *running);
            }
        }
    }
}

/// Rows scaled to length one.
pub(crate) fn unit_rows(x: Tensor<2>) -> Tensor<2> {
    let norm = (x.clone().square().sum_dim(1) + 1e-12).sqrt();
    x / norm
}
