//! Lowers a [`TextureModel`] to the bytes of an asset, and measures what rounding costs.

mod error;
mod summary;
mod table;
#[cfg(test)]
mod tests;
mod trace;

pub use error::LowerError;
pub use summary::ErrorSummary;

use crate::model::{Numerator, TextureModel, VertexKind, mesh};
use asperity_formats as formats;
use asperity_formats::{
    Anchor, AssetParts, Coupling, EncodeError, FormatError, FrictionParts, GridParts, ModelParts,
    TapParts, limits,
};
use table::ModelTable;
use trace::quantise_trace;

/// Room for every section but the preview at its largest.
const BUFFER_BYTES: usize = 128 * 1024;

/// An asset, and what rounding cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Lowered {
    /// The asset.
    pub bytes: Vec<u8>,
    /// Bytes of it that a runtime needs.
    pub haptic_bytes: usize,
    /// Distinct models.
    pub models: usize,
    /// RMS log-spectral error of LSF quantisation alone, dB.
    pub lsf_error: ErrorSummary,
}

/// Lowers a texture to an asset; `preview_png` goes last.
///
/// Distinct models are stored once. The same texture gives the same bytes.
///
/// # Errors
/// [`LowerError`] for a grid that is not tiled, frequencies that are not stable, or
/// anything outside the limits of the format.
pub fn lower(texture: &TextureModel, preview_png: Option<&[u8]>) -> Result<Lowered, LowerError> {
    check_counts(texture)?;
    mesh::check(&texture.grid)?;
    let table = ModelTable::of(&texture.grid)?;
    let models: Vec<ModelParts<'_>> = table
        .entries
        .iter()
        .map(|entry| ModelParts {
            lsf: &entry.lsf,
            ma_lsf: &entry.ma_lsf,
            gain: f32::from_bits(entry.gain_bits),
        })
        .collect();
    let vertices: Vec<formats::Vertex> = texture
        .grid
        .vertices
        .iter()
        .zip(&table.model_of)
        .map(|(vertex, &model)| formats::Vertex {
            speed_mm_s: vertex.speed_mm_s as f32,
            force_n: vertex.force_n as f32,
            sigma_m_s2: vertex.sigma_m_s2 as f32,
            model: model as u8,
            kind: match vertex.kind {
                VertexKind::Interior => formats::VertexKind::Interior,
                VertexKind::Edge => formats::VertexKind::Edge,
            },
        })
        .collect();
    let triangles: Vec<[u8; 3]> = texture
        .grid
        .triangles
        .iter()
        .map(|triangle| triangle.map(|v| v as u8))
        .collect();
    let traces: Vec<(f32, Vec<f32>)> = texture
        .taps
        .traces
        .iter()
        .map(|trace| (trace.speed_m_s as f32, quantise_trace(trace)))
        .collect();
    let traces: Vec<(f32, &[f32])> = traces.iter().map(|(v, a)| (*v, a.as_slice())).collect();
    let anchors: Vec<Anchor<'_>> = texture
        .friction
        .anchors
        .iter()
        .map(|anchor| Anchor {
            name: &anchor.name,
            mu: anchor.mu as f32,
            weight: anchor.weight as f32,
        })
        .collect();
    let law = law(texture)?;
    let lsf_error = ErrorSummary::of(&table.errors_db);
    let provenance = &texture.provenance;
    let parts = AssetParts {
        name: &texture.name,
        grid: GridParts {
            sample_rate_hz: texture.grid.sample_rate_hz as f32,
            ar_order: texture.grid.order,
            ma_order: table.ma_order,
            numerator: match texture.grid.numerator {
                Numerator::None => formats::Numerator::None,
                Numerator::Nyquist => formats::Numerator::Nyquist,
                Numerator::Lsf => formats::Numerator::Lsf,
            },
            models: &models,
            vertices: &vertices,
            triangles: &triangles,
        },
        taps: TapParts {
            sample_rate_hz: texture.taps.sample_rate_hz as f32,
            traces: &traces,
        },
        friction: FrictionParts {
            mu: texture.friction.mu as f32,
            anchors: &anchors,
            law: &law,
        },
        coupling: Coupling {
            stiffness_n_m: texture.wall.stiffness_n_m as f32,
            damping_n_s_m: texture.wall.damping_n_s_m as f32,
            vib_s2_m: texture.gains.vib_s2_m as f32,
            effective_mass_kg: texture.gains.effective_mass_kg as f32,
            f_max_n: texture.gains.f_max_n as f32,
        },
        provenance: Some(formats::Provenance {
            generator: &provenance.generator,
            source: &provenance.source,
            source_crc32: provenance.source_crc32,
            prompt: provenance.prompt.as_deref(),
            seed: provenance.seed,
            fidelity: &provenance.fidelity,
            taps_synthetic: provenance.taps_synthetic,
            lsf_error_db: lsf_error.rms_db as f32,
            notes: &provenance.notes,
        }),
        preview_png,
    };
    let mut bytes = vec![0; BUFFER_BYTES + preview_png.map_or(0, <[u8]>::len)];
    let len = formats::encode(&parts, &mut bytes)?;
    bytes.truncate(len);
    let haptic_bytes = formats::Asset::parse(&bytes)
        .map_err(EncodeError::from)?
        .haptic_len();
    Ok(Lowered {
        bytes,
        haptic_bytes,
        models: table.entries.len(),
        lsf_error,
    })
}

/// The points of the law of friction, in codes.
fn law(texture: &TextureModel) -> Result<Vec<formats::LawPoint>, EncodeError> {
    let points = texture.friction.law.iter().flat_map(|law| &law.points);
    points
        .enumerate()
        .map(|(index, point)| {
            let code = formats::LawPoint::nearest(point.speed_mm_s, point.factor);
            code.ok_or_else(|| {
                let faster = formats::LawPoint::nearest(point.speed_mm_s, 1.0).is_none();
                let (field, value, rule) = if faster {
                    (
                        "friction.law.speed_mm_s",
                        point.speed_mm_s,
                        "0 to 4095.9 mm/s",
                    )
                } else {
                    ("friction.law.factor", point.factor, "0 to 7.9999")
                };
                EncodeError::Rejected(FormatError::Invalid {
                    field,
                    index: index as u32,
                    value,
                    rule,
                })
            })
        })
        .collect()
}

/// Checks the counts that a byte of the format would silently wrap.
fn check_counts(texture: &TextureModel) -> Result<(), LowerError> {
    let samples = texture
        .taps
        .traces
        .first()
        .map_or(0, |t| t.accel_m_s2.len());
    for (what, found, limit) in [
        (
            "grid vertices",
            texture.grid.vertices.len(),
            limits::MAX_VERTICES,
        ),
        (
            "grid triangles",
            texture.grid.triangles.len(),
            limits::MAX_TRIANGLES,
        ),
        ("AR order", texture.grid.order, limits::MAX_ORDER),
        ("tap traces", texture.taps.traces.len(), limits::MAX_TAPS),
        ("samples of a tap trace", samples, limits::MAX_TAP_SAMPLES),
        (
            "points of the law of friction",
            texture.friction.law.as_ref().map_or(0, |l| l.points.len()),
            limits::MAX_LAW_POINTS,
        ),
        (
            "friction anchors",
            texture.friction.anchors.len(),
            limits::MAX_ANCHORS,
        ),
    ] {
        if found > limit {
            return Err(LowerError::TooMany { what, found, limit });
        }
    }
    Ok(())
}
