//! The format: what a file holds, key by key.
//!
//! Vertices, taps, friction, wall, contact law, direction and gains are those of the model. Units are in the keys: m, s, N, rad, Hz, m/s², and
//! mm/s for the speeds of the grid.

use asperity_texture::model::{
    ContactLaw, Direction, Friction, Gains, GridVertex, Numerator, TapBank, Wall,
};
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
    pub(super) taps: Option<TapBank>,
    pub(super) friction: Friction,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) wall: Option<Wall>,
    /// A spring takes the place of the wall's stiffness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) contact: Option<ContactLaw>,
    /// Ribs, a grain or a nap.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) direction: Option<Direction>,
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
    pub(super) vertices: Vec<GridVertex>,
    /// Triangulated by Delaunay if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) triangles: Option<Vec<[usize; 3]>>,
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
