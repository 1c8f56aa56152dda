//! From a latent to models and traces that are valid whatever the latent.

use super::{Mode, matrix};
use crate::{
    config::Network as Sizes,
    normaliser::{LSFS, MIN_GAP_RAD, Normaliser, TAP_VALUES},
    parameters::{Bound, Linear, Parameters, chain},
    rng::Stream,
};
use asperity::learned::description::LATENT;
use asperity_corpus::{BINS, ORDER};
use burn_tensor::{
    Tensor,
    activation::{relu, softmax},
};
use std::f32::consts::PI;

/// Gaps of a bin: below, between and above its LSFs.
pub(crate) const GAPS: usize = ORDER + 1;

/// Layers and residual blocks: `x ← ReLU(x + W₂·dropout(ReLU(W₁·x)))`.
#[derive(Debug, Clone)]
pub(crate) struct Trunk {
    /// Widening layers.
    pub(crate) layers: Vec<Linear>,
    /// The two layers of each block.
    pub(crate) blocks: Vec<(Linear, Linear)>,
}

impl Trunk {
    fn new(
        into: &mut Parameters,
        name: &str,
        widths: &[usize],
        blocks: usize,
        stream: &mut Stream,
    ) -> Self {
        let widths = [&[LATENT], widths].concat();
        let width = widths[widths.len() - 1];
        let layers = chain(into, name, &widths, stream);
        let mut half = |name: String| Linear::new(into, &name, width, width, stream);
        let block = |index| {
            (
                half(format!("{name}.block.{index}.first")),
                half(format!("{name}.block.{index}.second")),
            )
        };
        Self {
            layers,
            blocks: (0..blocks).map(block).collect(),
        }
    }

    fn forward(&self, bound: &Bound, mut x: Tensor<2>, mode: &mut Mode<'_>) -> Tensor<2> {
        for layer in &self.layers {
            x = relu(layer.forward(bound, x));
        }
        for (first, second) in &self.blocks {
            let inner = mode.drop_out(relu(first.forward(bound, x.clone())));
            x = relu(x + second.forward(bound, inner));
        }
        x
    }
}

/// LSFs and excitation.
#[derive(Debug, Clone)]
pub(crate) struct ArDecoder {
    /// Shared by the heads.
    pub(crate) trunk: Trunk,
    /// To 18 × 22 logits of gaps.
    pub(crate) lsf_head: Linear,
    /// To 18 excitations.
    pub(crate) excitation_head: Linear,
}

/// Traces.
#[derive(Debug, Clone)]
pub(crate) struct TapDecoder {
    /// Before the head.
    pub(crate) trunk: Trunk,
    /// To 13 × 100 samples.
    pub(crate) head: Linear,
}

/// Decoder output, a row per latent.
pub(crate) struct Decoded {
    /// [B, 18·21], rad.
    pub(crate) lsf_rad: Tensor<2>,
    /// [B, 18], coded.
    pub(crate) excitation: Tensor<2>,
    /// [B, 13·100], m/s².
    pub(crate) taps_m_s2: Tensor<2>,
}

/// [22, 21]: shares of what the smallest gaps leave of π, to LSFs above those gaps.
pub(crate) fn gap_matrix() -> Vec<f32> {
    let free = PI - GAPS as f32 * MIN_GAP_RAD;
    let entry = |index: usize| {
        if index / ORDER <= index % ORDER {
            free
        } else {
            0.0
        }
    };
    (0..GAPS * ORDER).map(entry).collect()
}

/// [21]: the LSFs of smallest gaps alone.
pub(crate) fn gap_offsets() -> Vec<f32> {
    (1..GAPS).map(|gaps| gaps as f32 * MIN_GAP_RAD).collect()
}

impl ArDecoder {
    pub(super) fn new(
        into: &mut Parameters,
        sizes: &Sizes,
        normaliser: &Normaliser,
        stream: &mut Stream,
    ) -> Self {
        let width = sizes.decoder[sizes.decoder.len() - 1];
        let blocks = sizes.ar_residual_blocks;
        let trunk = Trunk::new(into, "ar_decoder", &sizes.decoder, blocks, stream);
        let lsf_head = Linear::new(into, "lsf_head", width, BINS * GAPS, stream);
        // Starts at the mean LSFs of the corpus rather than at equal gaps.
        let least = MIN_GAP_RAD / PI;
        let free = 1.0 - GAPS as f32 * least;
        into.get_mut(lsf_head.bias).values = normaliser
            .gaps
            .iter()
            .map(|gap| libm::logf(((gap - least) / free).max(1e-4)))
            .collect();
        Self {
            trunk,
            lsf_head,
            excitation_head: Linear::new(into, "excitation_head", width, BINS, stream),
        }
    }

    /// LSFs [B, 18·21], rad, and coded excitations [B, 18].
    pub(crate) fn forward(
        &self,
        bound: &Bound,
        normaliser: &Normaliser,
        z: Tensor<2>,
        mode: &mut Mode<'_>,
    ) -> (Tensor<2>, Tensor<2>) {
        let device = z.device();
        let features = self.trunk.forward(bound, z, mode);
        let rows = features.dims()[0];
        let logits = self.lsf_head.forward(bound, features.clone());
        let shares = softmax(logits.reshape([rows * BINS, GAPS]), 1);
        let lsf_rad = shares.matmul(matrix(gap_matrix(), ORDER, &device))
            + matrix(gap_offsets(), ORDER, &device);
        let (low, high) = normaliser.excitation_bounds;
        let (centre, reach) = (0.5 * f64::from(low + high), 0.5 * f64::from(high - low));
        let mean = matrix(normaliser.ar_mean[LSFS..].to_vec(), BINS, &device);
        let deviation = matrix(normaliser.ar_deviation[LSFS..].to_vec(), BINS, &device);
        let free = self.excitation_head.forward(bound, features) * deviation + mean;
        let excitation = ((free - centre) / reach).tanh() * reach + centre;
        (lsf_rad.reshape([rows, LSFS]), excitation)
    }
}

impl TapDecoder {
    pub(super) fn new(into: &mut Parameters, sizes: &Sizes, stream: &mut Stream) -> Self {
        let width = sizes.decoder[sizes.decoder.len() - 1];
        let blocks = sizes.tap_residual_blocks;
        Self {
            trunk: Trunk::new(into, "tap_decoder", &sizes.decoder, blocks, stream),
            head: Linear::new(into, "tap_head", width, TAP_VALUES, stream),
        }
    }

    /// Samples [B, 13·100], m/s².
    pub(crate) fn forward(
        &self,
        bound: &Bound,
        normaliser: &Normaliser,
        z: Tensor<2>,
        mode: &mut Mode<'_>,
    ) -> Tensor<2> {
        let device = z.device();
        let row = |values: &[f32]| matrix(values.to_vec(), TAP_VALUES, &device);
        let features = self.trunk.forward(bound, z, mode);
        let free = self.head.forward(bound, features) * row(&normaliser.tap_deviation)
            + row(&normaliser.tap_mean);
        let limit = row(&normaliser.tap_bound);
        (free / limit.clone()).tanh() * limit
    }
}
