//! The network: two encoders, one Gaussian posterior, two decoders, two projections.
//!
//! ```text
//! AR 18×22 ─ encoder ─┐                    ┌─ AR decoder ─ LSFs, excitation
//!                     ├─ μ, log σ² ─ z ────┤
//! taps 13×100 ─ encoder ┘            │     └─ tap decoder ─ traces
//!                          projection, for the contrastive loss
//! caption vector ─ projection ─ ẑ
//! ```

mod decoder;
mod encoder;
mod projection;

pub(crate) use decoder::{ArDecoder, Decoded, GAPS, TapDecoder, Trunk, gap_matrix, gap_offsets};
pub(crate) use encoder::{Encoder, LOG_VARIANCE_BOUND};
pub(crate) use projection::{LatentProjection, TextProjection, unit_rows};

use crate::{
    config::Network as Sizes,
    normaliser::Normaliser,
    parameters::{Linear, Parameters, Slot},
    rng::Stream,
};
use asperity::learned::description::LATENT;
use burn_tensor::{Device, Tensor, TensorData};

/// Where the numbers of the network are.
#[derive(Debug, Clone)]
pub(crate) struct Network {
    /// Both encoders and the posterior.
    pub(crate) encoder: Encoder,
    /// LSFs and excitation.
    pub(crate) ar_decoder: ArDecoder,
    /// Traces.
    pub(crate) tap_decoder: TapDecoder,
    /// From a caption's vector to the latent.
    pub(crate) text: TextProjection,
    /// The latent's side of the contrastive loss.
    pub(crate) latent: LatentProjection,
    /// Where each material of the corpus gathers, [M, 64].
    pub(crate) centres: Slot,
    /// Standardised ln μ of friction from the latent.
    pub(crate) friction: Linear,
}

impl Network {
    /// A network drawn from `stream`, for text vectors of `width` and so many materials.
    pub(crate) fn new(
        sizes: &Sizes,
        width: usize,
        materials: usize,
        normaliser: &Normaliser,
        stream: &mut Stream,
    ) -> (Self, Parameters) {
        let mut parameters = Parameters::default();
        let into = &mut parameters;
        let network = Self {
            encoder: Encoder::new(into, sizes, stream),
            ar_decoder: ArDecoder::new(into, sizes, normaliser, stream),
            tap_decoder: TapDecoder::new(into, sizes, stream),
            text: TextProjection::new(into, width, &sizes.text_projection, stream),
            latent: LatentProjection::new(into, sizes.latent_projection, stream),
            centres: into.add("centres".into(), materials, vec![0.0; materials * LATENT]),
            friction: Linear::new(into, "friction", LATENT, 1, stream),
        };
        (network, parameters)
    }
}

/// Dropout, and its source of random numbers.
pub(crate) enum Mode<'a> {
    /// No dropout.
    Evaluate,
    /// Dropout of this rate.
    Train(&'a mut Stream, f64),
}

impl Mode<'_> {
    /// Inverted dropout.
    pub(crate) fn drop_out(&mut self, x: Tensor<2>) -> Tensor<2> {
        match self {
            Self::Train(stream, rate) if *rate > 0.0 => {
                let [rows, columns] = x.dims();
                let factors = stream.keep(rows * columns, *rate);
                let device = x.device();
                x * matrix(factors, columns, &device)
            }
            _ => x,
        }
    }
}

/// A matrix of this many columns, values row by row.
pub(crate) fn matrix(values: Vec<f32>, columns: usize, device: &Device) -> Tensor<2> {
    let rows = values.len() / columns;
    Tensor::from_data(TensorData::new(values, [rows, columns]), device)
}
