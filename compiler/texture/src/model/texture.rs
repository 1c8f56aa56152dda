//! The types of a texture model, in f64 and SI units.

use super::{ContactLaw, Direction, FrictionLaw};
use crate::signal::{lsf, spectrum::ArmaModel};
use serde::{Deserialize, Deserializer, Serialize};

/// A texture before quantisation, as every source makes it.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureModel {
    /// Name, unique within a library; 1..=64 bytes of UTF-8.
    pub name: String,
    /// The force–speed conditioned AR or ARMA models.
    pub grid: ModelGrid,
    /// Recorded or synthesised tapping transients; may be empty.
    pub taps: TapBank,
    /// Friction and the anchors it was interpolated from.
    pub friction: Friction,
    /// The virtual wall.
    pub wall: Wall,
    /// What takes the linear wall's place in a material that gives way.
    pub contact: Option<ContactLaw>,
    /// How strokes along its ribs, grain or nap differ from those across.
    pub direction: Option<Direction>,
    /// From accelerations to forces on the device.
    pub gains: Gains,
    /// Where the texture comes from.
    pub provenance: Provenance,
}

impl TextureModel {
    /// The texture without vibration and taps: what is left is the contact.
    #[must_use]
    pub fn silent(mut self) -> Self {
        self.taps.traces.clear();
        for vertex in &mut self.grid.vertices {
            vertex.sigma_m_s2 = 0.0;
        }
        self
    }
}

/// AR or ARMA models over the speed–force plane, joined by triangles.
///
/// The triangles tile the rectangle `[0, max_speed_mm_s] × [0, max_force_n]`.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelGrid {
    /// Sample rate of every model, Hz.
    pub sample_rate_hz: f64,
    /// AR order `p`, the same at every vertex.
    pub order: usize,
    /// The numerator of every model.
    pub numerator: Numerator,
    /// The vertices, each with a model of its own.
    pub vertices: Vec<GridVertex>,
    /// Vertex indices, any orientation.
    pub triangles: Vec<[usize; 3]>,
}

/// The numerator B(z) of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Numerator {
    /// B = 1.
    None,
    /// B = 1 + z⁻¹, not normalised.
    Nyquist,
    /// B monic, of the order given by `ma_lsf_rad`, with a gain.
    Lsf,
}

/// Kind of a vertex: measured, or closing the grid at its border.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum VertexKind {
    /// A measured or generated operating point.
    Interior,
    /// An edge model: on the border of the rectangle.
    Edge,
}

/// A vertex: power spectrum `(gain·σ)²·|B|²/|A|²`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridVertex {
    /// Tangential speed, mm/s, ≥ 0.
    pub speed_mm_s: f64,
    /// Normal force, N, ≥ 0.
    pub force_n: f64,
    /// Interior or edge.
    pub kind: VertexKind,
    /// Standard deviation of the excitation before numerator and gain, m/s².
    pub sigma_m_s2: f64,
    /// Gain of the numerator; 1 unless [`Numerator::Lsf`].
    #[serde(
        default = "one",
        deserialize_with = "or_one",
        skip_serializing_if = "is_one"
    )]
    pub gain: f64,
    /// Line spectral frequencies of A(z), rad, strictly ascending in (0, π); the
    /// first belongs to the sum polynomial.
    pub lsf_rad: Vec<f64>,
    /// Line spectral frequencies of B(z), only with [`Numerator::Lsf`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ma_lsf_rad: Option<Vec<f64>>,
}

fn one() -> f64 {
    1.0
}

fn or_one<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Option::deserialize(deserializer).map(|gain| gain.unwrap_or(1.0))
}

// serde hands the field over by reference.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_one(gain: &f64) -> bool {
    *gain == 1.0
}

/// Tapping transients, with one trace for every impact speed.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TapBank {
    /// Sample rate of every trace, Hz.
    pub sample_rate_hz: f64,
    /// Traces in ascending order of impact speed, all of one length.
    pub traces: Vec<TapTrace>,
}

/// The acceleration transient of one impact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TapTrace {
    /// Impact speed, m/s, > 0.
    pub speed_m_s: f64,
    /// Acceleration along the surface normal, m/s².
    pub accel_m_s2: Vec<f64>,
}

/// Coulomb friction, or friction that depends on speed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// Coefficient of kinetic friction, ≥ 0; with a law, the base that its factors multiply.
    pub mu: f64,
    /// Anchors from which μ was interpolated.
    #[serde(default)]
    pub anchors: Vec<FrictionAnchor>,
    /// Law of μ against speed, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<FrictionLaw>,
}

impl Friction {
    /// The weighted mean of the anchors, from which words, edits or a recording moved μ; `None` without any.
    #[must_use]
    pub fn anchors_mu(&self) -> Option<f64> {
        let sum = |of: fn(&FrictionAnchor) -> f64| self.anchors.iter().map(of).sum::<f64>();
        let weights = sum(|anchor| anchor.weight);
        (weights > 0.0).then(|| sum(|anchor| anchor.weight * anchor.mu) / weights)
    }

    /// μ at a speed, mm/s.
    #[must_use]
    pub fn mu_at(&self, speed_mm_s: f64) -> f64 {
        self.mu * FrictionLaw::factor_of(self.law.as_ref(), speed_mm_s)
    }

    /// The largest μ at any speed.
    #[must_use]
    pub fn highest_mu(&self) -> f64 {
        let highest = |law: &FrictionLaw| law.points.iter().map(|p| p.factor).fold(0.0, f64::max);
        self.mu * self.law.as_ref().map_or(1.0, highest)
    }
}

/// A named reference material with a known μ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FrictionAnchor {
    /// Material name.
    pub name: String,
    /// Its coefficient of kinetic friction.
    pub mu: f64,
    /// Its weight in the texture's μ, 0..=1.
    pub weight: f64,
}

/// The virtual wall `F = k·δ − b·ḋ`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wall {
    /// Stiffness, N/m.
    pub stiffness_n_m: f64,
    /// Rendered damping, N·s/m.
    pub damping_n_s_m: f64,
}

/// Gains from accelerations to device forces.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gains {
    /// `g_vib` in F_vib = g_vib · y · F_max, s²/m.
    pub vib_s2_m: f64,
    /// `m_eff` in F_tap = m_eff · a_tap, kg.
    pub effective_mass_kg: f64,
    /// Force that `vib_s2_m` is relative to, N.
    pub f_max_n: f64,
}

/// Where a texture comes from; written into the asset, never read by the runtime.
#[derive(Debug, Clone, PartialEq, Serialize, Default)]
pub struct Provenance {
    /// Generator of the texture, e.g. `asperity 0.1.0 import hatt`.
    pub generator: String,
    /// File or corpus entry it was made from; no folder.
    pub source: String,
    /// CRC-32 of the source's bytes, 0 when there is no file.
    pub source_crc32: u32,
    /// The prompt, for a texture that has one.
    pub prompt: Option<String>,
    /// Seed of everything random in its making.
    pub seed: u64,
    /// Requested fidelity: `full`, `auto` or an order.
    pub fidelity: String,
    /// True if the taps were synthesised rather than recorded.
    pub taps_synthetic: bool,
    /// RMS spectral error of LSF quantisation, dB, as the encoder measured it.
    pub lsf_error_db: f32,
    /// Notes for a reader: synthetic parts, unconfirmed defaults.
    pub notes: String,
}

impl ArmaModel {
    /// The model at a vertex of a grid.
    #[must_use]
    pub fn at_vertex(grid: &ModelGrid, vertex: &GridVertex) -> Self {
        Self {
            sample_rate_hz: grid.sample_rate_hz,
            a: lsf::to_polynomial(&vertex.lsf_rad),
            b: match grid.numerator {
                Numerator::None => vec![1.0],
                Numerator::Nyquist => vec![1.0, 1.0],
                Numerator::Lsf => {
                    lsf::to_polynomial(vertex.ma_lsf_rad.as_deref().unwrap_or_default())
                }
            },
            level_m_s2: vertex.gain * vertex.sigma_m_s2,
        }
    }
}
