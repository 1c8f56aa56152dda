//! The contents of a corpus.

use crate::{BINS, ORDER, TAP_SAMPLES, TAPS, UnifiedGrid};
use serde::{Deserialize, Serialize};

/// A whole corpus.
#[derive(Debug, Clone)]
pub struct Corpus {
    /// `reference` or `hatt`.
    pub name: String,
    /// Licence of the data, as the model card prints it.
    pub licence: String,
    /// CRC-32 over all files it was read from.
    pub crc32: u32,
    /// The grid all instances share.
    pub grid: UnifiedGrid,
    /// Impact speeds of the traces, m/s, ascending.
    pub tap_speeds_m_s: [f64; TAPS],
    /// True if the taps were synthesised rather than recorded.
    pub taps_synthetic: bool,
    /// The materials, in a fixed order.
    pub materials: Vec<Material>,
}

/// A material.
#[derive(Debug, Clone)]
pub struct Material {
    /// Name, unique in the corpus.
    pub name: String,
    /// Family it belongs to.
    pub family: String,
    /// Further words that name it.
    pub synonyms: Vec<String>,
    /// Captions to train on.
    pub training: Vec<Caption>,
    /// Captions that are never trained on. They name neither the material nor a synonym.
    pub held_out: Vec<String>,
    /// Its rated attributes; `None` where nobody rated it.
    pub rating: Option<Rating>,
    /// Coefficient of kinetic friction.
    pub mu: f64,
    /// Stiffness of the virtual wall, N/m.
    pub stiffness_n_m: f64,
    /// The material itself, not augmented.
    pub prototype: Instance,
    /// Augmented instances.
    pub instances: Vec<Instance>,
}

/// A caption and its focus.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Caption {
    /// Its focus.
    pub focus: Focus,
    /// The caption.
    pub text: String,
}

/// Subject of a caption.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Focus {
    /// Appearance.
    Look,
    /// Feel.
    Touch,
    /// Substance.
    Material,
    /// Its use, and where it is found.
    Use,
}

/// Perceived attributes, 0–100.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rating {
    /// Roughness.
    pub rough: f64,
    /// Slipperiness.
    pub slippery: f64,
    /// Hardness.
    pub hard: f64,
}

/// An augmented sample of a material, the encoders' input.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Line spectral frequencies of each bin, rad at 1 kHz, ascending; the numerator is 1 + z⁻¹.
    pub lsf_rad: [[f32; ORDER]; BINS],
    /// RMS of the vibration in each bin over all frequencies, dB re 1 m/s².
    pub level_db: [f32; BINS],
    /// Traces by impact speed, m/s² at 10 kHz.
    pub taps_m_s2: [[f32; TAP_SAMPLES]; TAPS],
}
