//! The description of a learned model: everything in its folder that is not a network.

use serde::{Deserialize, Serialize};

/// Version of the model folder that this crate reads.
pub const FORMAT: u32 = 2;
/// Width of the latent.
pub const LATENT: usize = 64;

/// `model.json` of a model folder: written by `asperity-train fit`, read by the compiler.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelDescription {
    /// [`FORMAT`].
    pub format: u32,
    /// Name of the model, e.g. `reference`.
    pub name: String,
    /// Training corpus.
    pub corpus: CorpusDescription,
    /// The text encoder its projection expects.
    pub text_encoder: TextEncoderDescription,
    /// Seed of the training run.
    pub seed: u64,
    /// The speed–force grid of the AR decoder.
    pub grid: GridDescription,
    /// The tap bank of the tap decoder.
    pub taps: TapDescription,
    /// Parameters for interpolating μ from the anchors.
    pub friction: FrictionDescription,
    /// The training materials: friction anchors and landmarks of the latent.
    pub anchors: Vec<Anchor>,
    /// Directions of the latent along which an objective attribute grows.
    pub axes: Vec<AttributeAxis>,
    /// Standard deviation of instances about the mean of their material, [`LATENT`] numbers. A seed
    /// moves a latent as far as this.
    pub spread: Vec<f32>,
    /// The certainty of a prompt as a function of its familiarity.
    pub certainty: CertaintyCurve,
    /// Familiarity below which a prompt is far from everything the model knows.
    pub unfamiliar: f64,
    /// CRC-32 of earlier models with the same latent and the same decoders, whose textures can be
    /// edited with this one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub same_latent: Vec<u32>,
}

/// Training corpus of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CorpusDescription {
    /// Name of the corpus.
    pub name: String,
    /// Licence of its data.
    pub licence: String,
    /// CRC-32 of its files.
    pub crc32: u32,
    /// True if the taps were synthesised rather than recorded.
    pub taps_synthetic: bool,
}

/// Which text encoder a projection was trained with.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextEncoderDescription {
    /// `minilm` or `clip`.
    pub name: String,
    /// Width of its vectors.
    pub width: usize,
}

/// The speed–force grid: bins in the order of the decoder's output.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridDescription {
    /// AR order.
    pub order: usize,
    /// Rate of the models, Hz.
    pub sample_rate_hz: f64,
    /// Tangential speed of every bin, mm/s.
    pub speeds_mm_s: Vec<f64>,
    /// Normal force of every bin, N.
    pub forces_n: Vec<f64>,
    /// Right border, mm/s.
    pub max_speed_mm_s: f64,
    /// Upper border, N.
    pub max_force_n: f64,
}

/// The tap bank.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TapDescription {
    /// Rate of the traces, Hz.
    pub sample_rate_hz: f64,
    /// Impact speeds, m/s, ascending.
    pub speeds_m_s: Vec<f64>,
    /// Samples of a trace.
    pub samples: usize,
}

/// The paper's softmax over the nearest anchors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrictionDescription {
    /// Number of nearest anchors used.
    pub top_k: usize,
    /// Temperature of the softmax over cosines.
    pub temperature: f64,
}

/// A training material in the latent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Anchor {
    /// Name of the material.
    pub name: String,
    /// Its family.
    pub family: String,
    /// Coefficient of kinetic friction.
    pub mu: f64,
    /// Stiffness of its wall, N/m.
    pub stiffness_n_m: f64,
    /// Posterior mean over its instances, [`LATENT`] numbers.
    pub z: Vec<f32>,
}

/// `attribute ≈ offset + direction · z`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttributeAxis {
    /// `rough_db`, `sharp_hz`, `hard_hz` or `mu`.
    pub attribute: String,
    /// Value at z = 0.
    pub offset: f64,
    /// Gradient, [`LATENT`] numbers.
    pub direction: Vec<f32>,
    /// Part of the variance over the training materials that the line explains, 0..=1.
    pub r_squared: f64,
}

/// Piecewise linear: certainty against the familiarity of a prompt, a soft maximum of its cosines
/// with the examples of the text projection. Certainty is the share of phrases left out of training,
/// as familiar as the prompt, of which all three ratings came out within 15 of 100 points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CertaintyCurve {
    /// Familiarities, ascending.
    pub similarity: Vec<f64>,
    /// Certainty at each, 0..=1, never falling.
    pub certainty: Vec<f64>,
}
