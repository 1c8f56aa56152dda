//! Lowers a [`TextureModel`] to the bytes of an asset, and measures what rounding costs.
//!
//! Every parameter is rounded to its code, equal models are stored once, and the sections are encoded. Lowering checks
//! shapes and ranges; how the bytes render is for [`verify`](crate::emit::verify) to say. [`raise`](crate::emit::raise) goes back.
//!
//! ```
//! use asperity::{sources::builtin, emit::{lower::lower, verify::SPECTRUM_BUDGET_DB}};
//! use asperity_formats::Asset;
//!
//! let texture = builtin::texture();
//! let lowered = lower(&texture, None)?;
//! assert!(lowered.lsf_error.max_db < SPECTRUM_BUDGET_DB);
//!
//! let asset = Asset::parse(&lowered.bytes).expect("bytes that the encoder has parsed");
//! assert_eq!(asset.grid().vertices().count(), texture.grid.vertices.len());
//! # Ok::<(), asperity::emit::lower::LowerError>(())
//! ```

mod error;
mod table;
#[cfg(test)]
mod tests;

pub use error::LowerError;

use super::contact::{self, LoweredLaw};
use asperity_formats::{
    self as formats, Anchor, AssetParts, Coupling, EncodeError, FormatError, FrictionParts,
    GridParts, ModelParts, TapParts, limits,
};
use asperity_texture::model::{Direction, Numerator, TapTrace, TextureModel, VertexKind, mesh};
use serde::Serialize;
use table::ModelTable;

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

impl Lowered {
    /// Another asset of the same texture: with sections that a runtime does not need.
    ///
    /// # Errors
    /// [`LowerError`] for bytes that are no asset.
    pub(crate) fn set_bytes(&mut self, bytes: Vec<u8>) -> Result<(), LowerError> {
        self.haptic_bytes = haptic_len(&bytes)?;
        self.bytes = bytes;
        Ok(())
    }
}

/// Bytes of an asset that a runtime needs. Each section has an entry in the table, so any section counts a little.
fn haptic_len(bytes: &[u8]) -> Result<usize, LowerError> {
    let asset = formats::Asset::parse(bytes).map_err(EncodeError::from)?;
    Ok(asset.haptic_len())
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
    let contact = texture.contact.as_ref().map(LoweredLaw::of).transpose()?;
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
            stiffness_n_m: contact::stiffness_n_m(&texture.wall, texture.contact.as_ref()) as f32,
            damping_n_s_m: texture.wall.damping_n_s_m as f32,
            vib_s2_m: texture.gains.vib_s2_m as f32,
            effective_mass_kg: texture.gains.effective_mass_kg as f32,
            f_max_n: texture.gains.f_max_n as f32,
        },
        contact: contact.as_ref().map(LoweredLaw::parts),
        direction: texture.direction.as_ref().map(direction),
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
    Ok(Lowered {
        haptic_bytes: haptic_len(&bytes)?,
        bytes,
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

// Largest, mean and RMS of a list of errors.

/// An error over the vertices, dB.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct ErrorSummary {
    /// Largest.
    pub max_db: f64,
    /// Mean.
    pub mean_db: f64,
    /// Root of the mean square.
    pub rms_db: f64,
}

impl ErrorSummary {
    /// The summary of a list of errors; zero for an empty list.
    #[must_use]
    pub fn of(errors_db: &[f64]) -> Self {
        let count = errors_db.len().max(1) as f64;
        Self {
            max_db: errors_db.iter().copied().fold(0.0, f64::max),
            mean_db: errors_db.iter().sum::<f64>() / count,
            rms_db: (errors_db.iter().map(|e| e * e).sum::<f64>() / count).sqrt(),
        }
    }
}

// Tap samples in the codes of the format.

/// Largest code of a tap sample.
const TAP_FULL_SCALE: f64 = 2047.0;

/// The trace rounded to its codes, with its impulse kept to half a step. Samples are rounded first;
/// then those that were nearest to being rounded the other way are, until the sum fits.
fn quantise_trace(trace: &TapTrace) -> Vec<f32> {
    let accel = &trace.accel_m_s2;
    let peak = accel.iter().fold(0.0_f64, |peak, a| peak.max(a.abs())) as f32;
    // The encoder decides on traces that are silent, NaN or infinite.
    if !(peak > 0.0 && peak.is_finite()) {
        return accel.iter().map(|&a| a as f32).collect();
    }
    let scale = TAP_FULL_SCALE / f64::from(peak);
    let scaled: Vec<f64> = accel.iter().map(|a| a * scale).collect();
    let mut codes: Vec<f64> = scaled
        .iter()
        .map(|s| s.round().clamp(-TAP_FULL_SCALE, TAP_FULL_SCALE))
        .collect();
    let missing = (scaled.iter().sum::<f64>() - codes.iter().sum::<f64>()).round();
    let direction = missing.signum();
    let mut order: Vec<usize> = (0..codes.len()).collect();
    order.sort_by(|&i, &j| {
        let residue = |k: usize| (scaled[k] - codes[k]) * direction;
        residue(j).total_cmp(&residue(i)).then(i.cmp(&j))
    });
    // The code of the peak sets the scale, so it stays.
    let movable = order
        .into_iter()
        .filter(|&k| codes[k].abs() < TAP_FULL_SCALE)
        .take(missing.abs() as usize)
        .collect::<Vec<_>>();
    for k in movable {
        codes[k] += direction;
    }
    codes
        .iter()
        .map(|code| (*code as f32) / (TAP_FULL_SCALE as f32) * peak)
        .collect()
}

/// The direction in binary32; its axis keeps length 1.
fn direction(direction: &Direction) -> formats::Direction {
    formats::Direction {
        axis: direction.axis.map(|part| part as f32),
        power_ratio: direction.power_ratio as f32,
        speed_ratio: direction.speed_ratio as f32,
        mu_forward: direction.mu_forward as f32,
        mu_backward: direction.mu_backward as f32,
    }
}

#[cfg(test)]
mod trace_tests {
    use super::*;

    #[test]
    fn a_quantised_trace_keeps_its_impulse_to_half_a_step() {
        for seed in 0..50 {
            let accel: Vec<f64> = (0..100)
                .map(|n| {
                    let t = f64::from(n) * 0.1;
                    (-t * 0.4).exp() * (t * (1.0 + f64::from(seed) * 0.07)).sin() * 21.3
                })
                .collect();
            let trace = TapTrace {
                speed_m_s: 0.1,
                accel_m_s2: accel.clone(),
            };
            let stored = quantise_trace(&trace);
            let peak = accel.iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
            let step = peak / TAP_FULL_SCALE;
            let difference =
                stored.iter().map(|&a| f64::from(a)).sum::<f64>() - accel.iter().sum::<f64>();
            assert!(difference.abs() <= 0.501 * step, "{difference} of {step}");
            for (found, expected) in stored.iter().zip(&accel) {
                assert!((f64::from(*found) - expected).abs() <= 1.001 * step);
            }
        }
    }
}
