//! What an import gives: an asset, and how far it is from its source.

use crate::{
    back_end::{lower::ErrorSummary, raise::raise, verify::VerifyError},
    model::{ModelGrid, TextureModel},
    passes::reduce::{self, Fidelity, Reference},
    pipeline::{Compiled, Pass, Pipeline, PipelineError, Request, Ringing, Timings},
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
    fn new(compiled: &Compiled, fidelity: Fidelity, errors_db: &[f64]) -> Self {
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

/// What an asset that keeps all of a texture is measured against. One that leaves something out is
/// measured against what the whole grid renders, at the places of
/// [`mixture::places`](crate::model::mixture::places), whatever it came from.
pub(crate) enum Truth {
    /// The texture before its reduction.
    Texture,
    /// The models of the source, one for each vertex; none where it is silent.
    Models {
        at_vertices: Vec<Option<ArmaModel>>,
        /// The largest distance that is accepted, dB.
        budget_db: f64,
    },
}

impl Pipeline {
    /// Compiles a texture, and measures the asset against what it came from.
    ///
    /// # Errors
    /// [`PipelineError`] with the pass that failed, or for a distance beyond the budget.
    pub(crate) fn import(
        &mut self,
        whole: TextureModel,
        request: &Request,
        ringing: Ringing,
        truth: &Truth,
    ) -> Result<Imported, PipelineError> {
        let mut compiled = self.compile(whole, request, ringing)?;
        let fidelity = request.fidelity;
        let errors_db = self.run(Pass::Compare, || truth.distances(&mut compiled, fidelity))?;
        Ok(Imported {
            report: Report::new(&compiled, fidelity, &errors_db),
            bytes: compiled.lowered.bytes,
            whole: compiled.whole,
            timings: self.timings().clone(),
        })
    }
}

impl Truth {
    /// Distances of an asset, dB: at every vertex that sounds where nothing was left out, else over
    /// the grid, and then they are also what the reduction cost.
    fn distances(
        &self,
        compiled: &mut Compiled,
        fidelity: Fidelity,
    ) -> Result<Vec<f64>, PipelineError> {
        let asset = Asset::parse(&compiled.lowered.bytes).map_err(VerifyError::from)?;
        let stored = raise(&asset).grid;
        let whole = &compiled.whole.grid;
        if fidelity == Fidelity::Full {
            return match self {
                Self::Texture => Ok(at_vertices(whole, &stored)),
                Self::Models {
                    at_vertices,
                    budget_db,
                } => from_models(at_vertices, &stored, *budget_db),
            };
        }
        let distances = Reference::new(whole).and_then(|whole| whole.distances(&stored));
        let distances = distances.unwrap_or_default();
        (compiled.reduction.p95_db, compiled.reduction.worst_db) = distances.summary();
        Ok(distances.into_inner())
    }
}

/// Distances of the stored spectra from those of the whole grid, dB, at every vertex that sounds.
fn at_vertices(whole: &ModelGrid, stored: &ModelGrid) -> Vec<f64> {
    let vertices = whole.vertices.iter().zip(&stored.vertices);
    vertices
        .filter(|(vertex, _)| vertex.gain * vertex.sigma_m_s2 > 0.0)
        .map(|(vertex, kept)| {
            let exact = ArmaModel::at_vertex(whole, vertex);
            log_spectral_distance_db(&exact, &ArmaModel::at_vertex(stored, kept))
        })
        .collect()
}

/// Distances of the stored spectra from the models of the source, dB, at every one that sounds.
fn from_models(
    models: &[Option<ArmaModel>],
    stored: &ModelGrid,
    budget_db: f64,
) -> Result<Vec<f64>, PipelineError> {
    let mut errors_db = Vec::new();
    for (index, (truth, vertex)) in models.iter().zip(&stored.vertices).enumerate() {
        let Some(truth) = truth else { continue };
        let distance_db = log_spectral_distance_db(truth, &ArmaModel::at_vertex(stored, vertex));
        // A NaN fails too.
        if distance_db.is_nan() || distance_db > budget_db {
            return Err(PipelineError::Budget {
                model: index + 1,
                distance_db,
                budget_db,
            });
        }
        errors_db.push(distance_db);
    }
    Ok(errors_db)
}
