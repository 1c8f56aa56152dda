//! The contract of `inspect --json`.

use super::scene::SurfaceDocument;
use crate::emit::raise::raise;
use asperity_formats::Asset;
use asperity_runtime::{Config, Renderer};
use asperity_texture::model::{
    ContactLaw, Direction, FrictionAnchor, FrictionLaw, Gains, Numerator, Provenance, VertexKind,
    Wall,
    attributes::{Attributes, Meter},
};
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// JSON of a texture. Field names and their meaning are a contract.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Document {
    /// Version of the format that the asset was written in.
    pub format_version: u16,
    /// Name of the texture.
    pub name: String,
    /// The prompt; null for a texture that has none.
    pub prompt: Option<String>,
    /// The grid of models.
    pub ar: Ar,
    /// The tap bank.
    pub taps: Taps,
    /// Friction.
    pub friction: Friction,
    /// The wall.
    pub wall: Wall,
    /// What takes the linear wall's place in a material that gives way. Absent if it does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contact: Option<Contact>,
    /// How strokes along ribs, a grain or a nap differ from those across. Absent if they do not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,
    /// From accelerations to forces.
    pub gains: Gains,
    /// Objective attributes.
    pub attributes: Attributes,
    /// Sizes.
    pub bytes: Bytes,
    /// Where the texture comes from.
    pub provenance: Provenance,
}

/// The grid of models.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ar {
    /// Order of A(z).
    pub order: usize,
    /// Sample rate of every model, Hz.
    pub sample_rate_hz: f64,
    /// Numerator over A(z).
    pub numerator: Numerator,
    /// Vertices.
    pub vertices: Vec<Vertex>,
    /// Vertex indices.
    pub triangles: Vec<[usize; 3]>,
    /// Right border, mm/s.
    pub max_speed_mm_s: f64,
    /// Upper border, N.
    pub max_force_n: f64,
}

/// Vertex model: power spectrum (gain·σ)²·|B|²/|A|².
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Vertex {
    /// Tangential speed, mm/s.
    pub speed_mm_s: f64,
    /// Normal force, N.
    pub force_n: f64,
    /// Interior or edge.
    pub kind: VertexKind,
    /// LSFs of A(z), rad.
    pub lsf_rad: Vec<f64>,
    /// LSFs of B(z), rad; left out unless the numerator is `lsf`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ma_lsf_rad: Option<Vec<f64>>,
    /// Gain; left out where it is 1.
    #[serde(skip_serializing_if = "is_one")]
    pub gain: f64,
    /// Standard deviation of ε before numerator and gain, m/s².
    pub sigma_m_s2: f64,
}

// serde hands the field over by reference.
#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_one(gain: &f64) -> bool {
    *gain == 1.0
}

/// The tap bank.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Taps {
    /// Sample rate of every trace, Hz.
    pub sample_rate_hz: f64,
    /// Impact speeds, m/s, ascending.
    pub speeds_m_s: Vec<f64>,
    /// Traces, m/s², one per impact speed.
    pub traces_m_s2: Vec<Vec<f64>>,
}

/// Friction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Friction {
    /// Coefficient of kinetic friction.
    pub mu: f64,
    /// Its nearest materials.
    pub anchors: Vec<FrictionAnchor>,
    /// Their weighted mean, from which words, edits or a recording moved `mu`; `None` without anchors.
    pub anchors_mu: Option<f64>,
    /// Speed dependence: factors of `mu`. Absent if there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<FrictionLaw>,
}

/// Formats a line: μ, the materials that have a share of it, and how far words or edits moved it from their mean.
impl Display for Friction {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "μ {:.3}", self.mu)?;
        let Some(mean) = self.anchors_mu else {
            return Ok(());
        };
        let moved = 100.0 * (self.mu / mean - 1.0);
        if moved.abs() >= 0.5 {
            write!(f, " ({moved:+.0} % from {mean:.3} by words or edits)")?;
        }
        // What rounds to nothing says nothing.
        let shown = self.anchors.iter().filter(|anchor| anchor.weight >= 0.005);
        for (n, anchor) in shown.enumerate() {
            let before = if n == 0 { ", mean of " } else { ", " };
            write!(
                f,
                "{before}{} (μ {:.3}, {:.0} %)",
                anchor.name,
                anchor.mu,
                100.0 * anchor.weight
            )?;
        }
        Ok(())
    }
}

/// A contact law.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Contact {
    /// The law of the asset.
    #[serde(flatten)]
    pub law: ContactLaw,
    /// Its parts on the 3D Systems Touch at 1 kHz.
    pub lowered: LoweredContact,
}

/// Parts of a contact law as the runtime renders them on a device: the same where it can bear them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LoweredContact {
    /// Steepest slope of the spring, N/m.
    pub stiffness_n_m: f64,
    /// Damping of the wall, N·s/m.
    pub damping_n_s_m: f64,
    /// Damping over the load, s/m.
    pub damping_s_m: f64,
    /// Stiffness of the relaxation, N/m.
    pub relaxation_n_m: f64,
    /// Stiffness of the adhesion, N/m.
    pub adhesion_n_m: f64,
}

impl LoweredContact {
    fn of(asset: &Asset<'_>) -> Option<Self> {
        let renderer = Renderer::new(&Config::default()).ok()?;
        let lowered = renderer.contact_law(asset.coupling(), asset.contact()?);
        Some(Self {
            stiffness_n_m: lowered.wall.stiffness.value().into(),
            damping_n_s_m: lowered.wall.damping.value().into(),
            damping_s_m: lowered.damping.value().into(),
            relaxation_n_m: lowered.relaxing.value().into(),
            adhesion_n_m: lowered.sticking.value().into(),
        })
    }
}

/// Formats the parts on one line, and on another those that the Touch bears.
impl Display for Contact {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let law = &self.law;
        let mut parts = Vec::new();
        if !law.spring.is_empty() {
            let points = law.spring.iter();
            let points = points.map(|p| format!("{:.2} N at {:.1} mm", p.force_n, p.depth_mm));
            parts.push(format!("spring {}", points.collect::<Vec<_>>().join(", ")));
        }
        if law.damping_s_m > 0.0 {
            parts.push(format!("damping {:.2} s/m", law.damping_s_m));
        }
        if let Some(part) = &law.relaxation {
            let (stiffness, time_s) = (part.stiffness_n_m, part.time_s);
            parts.push(format!("relaxation {stiffness:.0} N/m in {time_s:.2} s"));
        }
        if let Some(part) = &law.imprint {
            let (share, yield_mm) = (100.0 * part.share, part.yield_mm);
            parts.push(format!("imprint {share:.0} % beyond {yield_mm:.1} mm"));
        }
        if let Some(part) = &law.drag {
            let (viscous, plough) = (part.viscous_n_s_m2, part.plough_n_m);
            parts.push(format!("drag {viscous:.0} N·s/m² + {plough:.0} N/m"));
        }
        if let Some(part) = &law.adhesion {
            let (pull_n, stiffness) = (part.pull_n, part.stiffness_n_m);
            parts.push(format!("pull {pull_n:.2} N at {stiffness:.0} N/m"));
        }
        writeln!(f, "{}", parts.join("; "))?;
        let low = &self.lowered;
        write!(
            f,
            "               on the Touch: spring up to {:.0} N/m, damping {:.2} s/m, relaxation {:.0} N/m, pull {:.0} N/m",
            low.stiffness_n_m, low.damping_s_m, low.relaxation_n_m, low.adhesion_n_m
        )
    }
}

/// Sizes, bytes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bytes {
    /// Everything but preview, provenance, latent and history.
    pub haptic: usize,
    /// The preview image, 0 without one.
    pub preview: usize,
    /// The whole asset.
    pub total: usize,
}

impl Document {
    /// The document of an asset in a library, under the name that the library's index gives it.
    #[must_use]
    pub fn named(asset: &Asset<'_>, name: String) -> Self {
        Self::measured(asset, name, &mut Meter::default())
    }

    /// [`named`](Self::named), by a meter that measures other assets, too.
    #[must_use]
    pub fn measured(asset: &Asset<'_>, name: String, meter: &mut Meter) -> Self {
        Self {
            name,
            ..Self::with(asset, meter)
        }
    }

    /// The document of an asset.
    #[must_use]
    pub fn of(asset: &Asset<'_>) -> Self {
        Self::with(asset, &mut Meter::default())
    }

    fn with(asset: &Asset<'_>, meter: &mut Meter) -> Self {
        let texture = raise(asset);
        let attributes = meter.of(&texture);
        let (speeds_m_s, traces_m_s2) = texture
            .taps
            .traces
            .into_iter()
            .map(|trace| (trace.speed_m_s, trace.accel_m_s2))
            .unzip();
        Self {
            format_version: asset.version(),
            name: texture.name,
            prompt: texture.provenance.prompt.clone(),
            ar: Ar {
                order: texture.grid.order,
                sample_rate_hz: texture.grid.sample_rate_hz,
                numerator: texture.grid.numerator,
                vertices: texture
                    .grid
                    .vertices
                    .into_iter()
                    .map(|vertex| Vertex {
                        speed_mm_s: vertex.speed_mm_s,
                        force_n: vertex.force_n,
                        kind: vertex.kind,
                        lsf_rad: vertex.lsf_rad,
                        ma_lsf_rad: vertex.ma_lsf_rad,
                        gain: vertex.gain,
                        sigma_m_s2: vertex.sigma_m_s2,
                    })
                    .collect(),
                triangles: texture.grid.triangles,
                max_speed_mm_s: f64::from(asset.grid().max_speed_mm_s()),
                max_force_n: f64::from(asset.grid().max_force_n()),
            },
            taps: Taps {
                sample_rate_hz: texture.taps.sample_rate_hz,
                speeds_m_s,
                traces_m_s2,
            },
            friction: Friction {
                mu: texture.friction.mu,
                anchors_mu: texture.friction.anchors_mu(),
                anchors: texture.friction.anchors,
                law: texture.friction.law,
            },
            wall: texture.wall,
            contact: texture
                .contact
                .zip(LoweredContact::of(asset))
                .map(|(law, lowered)| Contact { law, lowered }),
            direction: texture.direction,
            gains: texture.gains,
            attributes,
            bytes: Bytes {
                haptic: asset.haptic_len(),
                preview: asset.preview_png().map_or(0, <[u8]>::len),
                total: asset.total_len(),
            },
            provenance: texture.provenance,
        }
    }
}

/// A library: its textures in order of name, each as [`Document`] has it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LibraryDocument {
    /// Version of the library format.
    pub format_version: u16,
    /// Every texture.
    pub textures: Vec<Document>,
    /// Surfaces of the scene, if there is one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<SurfaceDocument>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};

    #[test]
    fn the_contract_names_are_there_and_a_gain_of_one_is_not() {
        let bytes = lower(&builtin::texture(), None).unwrap().bytes;
        let asset = Asset::parse(&bytes).unwrap();
        let json = serde_json::to_value(Document::of(&asset)).unwrap();
        for path in [
            "/format_version",
            "/name",
            "/prompt",
            "/ar/order",
            "/ar/sample_rate_hz",
            "/ar/numerator",
            "/ar/vertices/0/speed_mm_s",
            "/ar/vertices/0/force_n",
            "/ar/vertices/0/kind",
            "/ar/vertices/0/lsf_rad/0",
            "/ar/vertices/0/sigma_m_s2",
            "/ar/triangles/0/2",
            "/ar/max_speed_mm_s",
            "/ar/max_force_n",
            "/taps/sample_rate_hz",
            "/taps/speeds_m_s/12",
            "/taps/traces_m_s2/12/99",
            "/friction/mu",
            "/friction/anchors_mu",
            "/friction/anchors/0/name",
            "/friction/anchors/0/mu",
            "/friction/anchors/0/weight",
            "/wall/stiffness_n_m",
            "/wall/damping_n_s_m",
            "/gains/vib_s2_m",
            "/gains/effective_mass_kg",
            "/gains/f_max_n",
            "/attributes/rough_db",
            "/attributes/sharp_hz",
            "/attributes/hard_hz",
            "/attributes/mu",
            "/bytes/haptic",
            "/bytes/preview",
            "/bytes/total",
            "/provenance/taps_synthetic",
        ] {
            assert!(json.pointer(path).is_some(), "{path}");
        }
        assert_eq!(json["ar"]["numerator"], "nyquist");
        assert!(json.pointer("/ar/vertices/0/gain").is_none());
        assert!(json.pointer("/ar/vertices/0/ma_lsf_rad").is_none());
    }
}
