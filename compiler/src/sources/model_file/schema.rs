//! The format: what a file holds, key by key.
//!
//! These types are apart from those of the model so that the model can change while files of
//! this version stay readable. Units are in the keys: m, s, N, rad, Hz, m/s², and mm/s for the
//! speeds of the grid.

use asperity_texture::model::{FrictionAnchor, FrictionLaw, Gains, Numerator, VertexKind, Wall};
use serde::{Deserialize, Serialize};

/// Value of `format`.
pub const FORMAT: &str = "asperity-model";
/// The version that is written, and the only one that is read.
pub const VERSION: u64 = 1;

/// A whole file.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document {
    pub(super) format: String,
    pub(super) version: u64,
    pub(super) name: String,
    pub(super) grid: Grid,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) taps: Option<Taps>,
    pub(super) friction: Friction,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wall: Option<Wall>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) gains: Option<Gains>,
    #[serde(default)]
    pub(super) provenance: Provenance,
}

/// The models over the speed–force plane.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Grid {
    pub(super) sample_rate_hz: f64,
    pub(super) numerator: Numerator,
    pub(super) vertices: Vec<Vertex>,
    /// Triangulated by Delaunay if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) triangles: Option<Vec<[usize; 3]>>,
}

/// Vertex model: power spectrum (gain·σ)²·|B|²/|A|².
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Vertex {
    pub(super) speed_mm_s: f64,
    pub(super) force_n: f64,
    pub(super) kind: VertexKind,
    pub(super) sigma_m_s2: f64,
    /// For the numerator `lsf` only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) gain: Option<f64>,
    pub(super) lsf_rad: Vec<f64>,
    /// For the numerator `lsf` only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ma_lsf_rad: Option<Vec<f64>>,
}

/// The tap bank.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Taps {
    pub(super) sample_rate_hz: f64,
    pub(super) traces: Vec<Trace>,
}

/// The transient of one impact.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Trace {
    pub(super) speed_m_s: f64,
    pub(super) accel_m_s2: Vec<f64>,
}

/// Friction.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Friction {
    pub(super) mu: f64,
    #[serde(default)]
    pub(super) anchors: Vec<FrictionAnchor>,
    /// Friction that depends on speed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) law: Option<FrictionLaw>,
}

/// Where the texture comes from. Fidelity and quantisation error are not the model's: they
/// belong to the asset that is made of it.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Provenance {
    pub(super) generator: String,
    pub(super) source: String,
    pub(super) source_crc32: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) prompt: Option<String>,
    pub(super) seed: u64,
    pub(super) taps_synthetic: bool,
    pub(super) notes: String,
}
