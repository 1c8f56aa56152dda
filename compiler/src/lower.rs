//! The back end: a [`TextureModel`] to the bytes of an asset, with the error of what
//! was rounded.

use crate::{
    diagnostic::Diagnostic,
    lsf,
    mesh::{self, MeshError},
    model::{GridVertex, ModelGrid, Numerator, TapTrace, TextureModel, VertexKind},
    spectrum::{ArmaModel, ERROR_POINTS, ErrorBand},
};
use asperity_formats as formats;
use asperity_formats::{
    Anchor, AssetParts, Coupling, EncodeError, FrictionParts, GridParts, LsfCode, ModelParts,
    TapParts, limits,
};
use thiserror::Error;

/// Room for every section but the preview at its largest.
const BUFFER_BYTES: usize = 128 * 1024;
/// Largest code of a tap sample.
const TAP_FULL_SCALE: f64 = 2047.0;

/// Why a texture cannot become an asset.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LowerError {
    /// The triangles do not tile the grid.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A line spectral frequency is no angle.
    #[error("vertex {vertex}: {field}[{index}] = {value} rad is not in (0, π)")]
    Frequency {
        /// Index of the vertex.
        vertex: usize,
        /// `lsf_rad` or `ma_lsf_rad`.
        field: &'static str,
        /// Index of the frequency.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// Neighbouring LSFs lie closer than an asset can hold.
    #[error("vertex {vertex}: neighbouring LSFs {gap_rad} rad apart, {least_rad} rad at least")]
    Gap {
        /// Index of the vertex.
        vertex: usize,
        /// Smallest gap found, rad.
        gap_rad: f64,
        /// Smallest gap allowed, rad.
        least_rad: f64,
    },
    /// More than the format counts.
    #[error("{what}: {found}, an asset holds {limit}")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there can be.
        limit: usize,
    },
    /// The format refused the parts.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

impl Diagnostic for LowerError {
    fn remedy(&self) -> String {
        match self {
            Self::Mesh(_) => {
                "triangulate the vertices so that they tile the rectangle from (0, 0)".into()
            }
            Self::Frequency { .. } => "give ascending frequencies inside (0, π)".into(),
            Self::Gap { .. } => "widen the resonance of this model, or lower its order".into(),
            Self::TooMany { .. } => "reduce the source, or split it".into(),
            Self::Encode(_) => "correct the value in the source".into(),
        }
    }
}

/// An asset and what its making lost.
#[derive(Debug, Clone, PartialEq)]
pub struct Lowered {
    /// The asset.
    pub bytes: Vec<u8>,
    /// Bytes of it that a runtime needs.
    pub haptic_bytes: usize,
    /// Distinct models.
    pub models: usize,
    /// RMS log-spectral error of LSF quantisation alone, dB.
    pub lsf_error: Error3,
}

/// An error over the vertices, dB.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Error3 {
    /// Largest.
    pub max_db: f64,
    /// Mean.
    pub mean_db: f64,
    /// Root of the mean square.
    pub rms_db: f64,
}

impl Error3 {
    /// Of a list of errors; zero for none.
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
    let lsf_error = Error3::of(&table.errors_db);
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

/// Counts that a byte of the format would silently wrap.
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

/// The distinct models of a grid, in order of first use.
struct ModelTable {
    entries: Vec<Entry>,
    /// Entry of every vertex.
    model_of: Vec<usize>,
    ma_order: usize,
    /// Log-spectral error of LSF quantisation at every vertex, dB.
    errors_db: Vec<f64>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Entry {
    lsf: Vec<LsfCode>,
    ma_lsf: Vec<LsfCode>,
    gain_bits: u32,
}

impl ModelTable {
    fn of(grid: &ModelGrid) -> Result<Self, LowerError> {
        let mut table = Self {
            entries: Vec::new(),
            model_of: Vec::new(),
            ma_order: 0,
            errors_db: Vec::new(),
        };
        let band = ErrorBand::new(grid.sample_rate_hz, ERROR_POINTS);
        for (index, vertex) in grid.vertices.iter().enumerate() {
            let has_numerator = grid.numerator == Numerator::Lsf;
            let ma_lsf = vertex.ma_lsf_rad.as_deref().filter(|_| has_numerator);
            let entry = Entry {
                lsf: codes(index, "lsf_rad", &vertex.lsf_rad)?,
                ma_lsf: codes(index, "ma_lsf_rad", ma_lsf.unwrap_or_default())?,
                gain_bits: if has_numerator {
                    vertex.gain as f32
                } else {
                    1.0
                }
                .to_bits(),
            };
            check_gap(index, &entry.lsf)?;
            table.ma_order = table.ma_order.max(entry.ma_lsf.len());
            // Edge models share the frequencies of the vertex they continue, hence its error.
            let twin = grid.vertices[..index].iter().position(|other| {
                other.lsf_rad == vertex.lsf_rad && other.ma_lsf_rad == vertex.ma_lsf_rad
            });
            table.errors_db.push(match twin {
                Some(twin) => table.errors_db[twin],
                None => quantisation_error_db(&band, grid, vertex, &entry),
            });
            let known = table.entries.iter().position(|other| *other == entry);
            table.model_of.push(known.unwrap_or(table.entries.len()));
            if known.is_none() {
                table.entries.push(entry);
            }
        }
        Ok(table)
    }
}

fn codes(vertex: usize, field: &'static str, lsf_rad: &[f64]) -> Result<Vec<LsfCode>, LowerError> {
    lsf_rad
        .iter()
        .enumerate()
        .map(|(index, &value)| {
            LsfCode::from_rad(value).ok_or(LowerError::Frequency {
                vertex,
                field,
                index,
                value,
            })
        })
        .collect()
}

fn check_gap(vertex: usize, lsf: &[LsfCode]) -> Result<(), LowerError> {
    let step = std::f64::consts::PI / 65536.0;
    let least = i32::from(limits::MIN_LSF_GAP_CODES);
    let bits = lsf.iter().map(|code| i32::from(code.to_bits()));
    let mut previous = 0;
    for code in bits.chain([65536]) {
        if code - previous < least {
            return Err(LowerError::Gap {
                vertex,
                gap_rad: f64::from(code - previous) * step,
                least_rad: f64::from(least) * step,
            });
        }
        previous = code;
    }
    Ok(())
}

/// Distance of a vertex's spectrum from that of its codes, at equal level.
fn quantisation_error_db(
    band: &ErrorBand,
    grid: &ModelGrid,
    vertex: &GridVertex,
    entry: &Entry,
) -> f64 {
    let angles = |codes: &[LsfCode]| codes.iter().map(|c| c.to_rad()).collect::<Vec<_>>();
    let mut exact = ArmaModel::at_vertex(grid, vertex);
    exact.level_m_s2 = 1.0;
    let mut rounded = exact.clone();
    rounded.a = lsf::to_polynomial(&angles(&entry.lsf));
    if grid.numerator == Numerator::Lsf {
        rounded.b = lsf::to_polynomial(&angles(&entry.ma_lsf));
    }
    band.distance_db(&exact, &rounded)
}

/// The trace on the grid of its codes, its impulse kept to half a step: samples are
/// rounded, then those nearest to the other neighbour are moved until the sum fits.
fn quantise_trace(trace: &TapTrace) -> Vec<f32> {
    let accel = &trace.accel_m_s2;
    let peak = accel.iter().fold(0.0_f64, |peak, a| peak.max(a.abs())) as f32;
    // Silent, NaN or infinite: the format decides.
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
    // The peak's own code sets the scale and stays.
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

#[cfg(test)]
mod tests;
