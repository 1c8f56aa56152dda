//! What an import gives: an asset, and how far it is from its source.

use crate::{
    back_end::{lower::ErrorSummary, raise::raise, verify::VerifyError},
    model::{ModelGrid, TextureModel},
    passes::reduce::{self, Fidelity, Reference},
    pipeline::{Compiled, PipelineError, Timings},
    signal::spectrum::{ArmaModel, log_spectral_distance_db},
};
use asperity_formats::Asset;
use serde_json::{Value, json};
use std::fmt;

/// An imported texture.
#[derive(Debug, Clone)]
pub struct Imported {
    /// The asset.
    pub bytes: Vec<u8>,
    /// Its figures.
    pub report: Report,
    /// The whole texture before reduction.
    pub whole: TextureModel,
    /// The time of every pass.
    pub timings: Timings,
}

/// Figures of an imported texture; prints as one line.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Name of the texture.
    pub name: String,
    /// Distance of the asset from its source. In full it is measured at every vertex that sounds,
    /// else on what the whole grid renders, at the places of [`mixture::places`].
    ///
    /// [`mixture::places`]: crate::model::mixture::places
    pub error: ErrorSummary,
    /// Vertices or places that were compared.
    pub compared: usize,
    /// All vertices.
    pub vertices: usize,
    /// All triangles.
    pub triangles: usize,
    /// Distinct models stored.
    pub models: usize,
    /// Polynomials whose printed LSFs described another filter.
    pub recomputed: usize,
    /// What was left out, unless nothing was to be.
    pub reduction: Option<reduce::Report>,
    /// Bytes that a runtime needs.
    pub haptic_bytes: usize,
    /// Bytes of the asset.
    pub total_bytes: usize,
}

impl Imported {
    /// The report for machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let report = &self.report;
        json!({
            "name": report.name,
            "error": report.error,
            "compared": report.compared,
            "vertices": report.vertices,
            "triangles": report.triangles,
            "models": report.models,
            "reduction": report.reduction,
            "bytes": { "haptic": report.haptic_bytes, "total": report.total_bytes },
            "stages_ms": self.timings.json(),
        })
    }
}

impl Report {
    /// The figures of a compiled texture. `errors_db` are its distances from the source, one a
    /// vertex or place that was compared.
    pub(crate) fn new(compiled: &Compiled, fidelity: Fidelity, errors_db: &[f64]) -> Self {
        let (texture, lowered) = (&compiled.texture, &compiled.lowered);
        Self {
            name: texture.name.clone(),
            error: ErrorSummary::of(errors_db),
            compared: errors_db.len(),
            vertices: texture.grid.vertices.len(),
            triangles: texture.grid.triangles.len(),
            models: lowered.models,
            recomputed: 0,
            reduction: (fidelity != Fidelity::Full).then_some(compiled.reduction),
            haptic_bytes: lowered.haptic_bytes,
            total_bytes: lowered.bytes.len(),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let compared = match &self.reduction {
            None => format!("{} of {} vertices", self.compared, self.vertices),
            Some(_) => format!("{} places", self.compared),
        };
        write!(
            f,
            "{}: max {:.4} dB, mean {:.4} dB over {compared}, {} triangles, {} models, \
             {} haptic bytes, {} in all",
            self.name,
            self.error.max_db,
            self.error.mean_db,
            self.triangles,
            self.models,
            self.haptic_bytes,
            self.total_bytes
        )?;
        if let Some(reduction) = &self.reduction {
            write!(f, ", {reduction}")?;
        }
        if self.recomputed > 0 {
            write!(f, ", {} LSF lists recomputed", self.recomputed)?;
        }
        Ok(())
    }
}

/// Distances of what the stored grid renders from what the whole one does, dB, at the places of
/// [`mixture::places`](crate::model::mixture::places), and their 95 % quantile and maximum.
pub(crate) fn errors_over_grid(whole: &ModelGrid, stored: &ModelGrid) -> (Vec<f64>, (f64, f64)) {
    let distances = Reference::new(whole).and_then(|whole| whole.distances(stored));
    let distances = distances.unwrap_or_default();
    let summary = distances.summary();
    (distances.into_inner(), summary)
}

/// Distances of the stored spectra from those of the whole grid, dB, at every vertex that sounds.
/// Nothing may have been left out.
pub(crate) fn errors_at_vertices(whole: &ModelGrid, stored: &ModelGrid) -> Vec<f64> {
    let vertices = whole.vertices.iter().zip(&stored.vertices);
    vertices
        .filter(|(vertex, _)| vertex.gain * vertex.sigma_m_s2 > 0.0)
        .map(|(vertex, kept)| {
            let exact = ArmaModel::at_vertex(whole, vertex);
            log_spectral_distance_db(&exact, &ArmaModel::at_vertex(stored, kept))
        })
        .collect()
}

/// Distances of an asset from the texture before its reduction, dB: at the vertices in full, else
/// over the grid, of which the report of the reduction then holds the figures.
pub(crate) fn compare(
    compiled: &mut Compiled,
    fidelity: Fidelity,
) -> Result<Vec<f64>, PipelineError> {
    let asset = Asset::parse(&compiled.lowered.bytes).map_err(VerifyError::from)?;
    let stored = raise(&asset).grid;
    if fidelity == Fidelity::Full {
        return Ok(errors_at_vertices(&compiled.whole.grid, &stored));
    }
    let (errors_db, (p95_db, worst_db)) = errors_over_grid(&compiled.whole.grid, &stored);
    compiled.reduction.p95_db = p95_db;
    compiled.reduction.worst_db = worst_db;
    Ok(errors_db)
}
