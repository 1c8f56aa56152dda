//! Reference for the compile error.

use super::Compared;
use crate::{
    emit::{lower::ErrorSummary, raise::raise, verify::VerifyError},
    passes::reduce::{Fidelity, Reference},
    pipeline::{Passed, PipelineError},
};
use asperity_formats::Asset;
use asperity_texture::{
    model::ModelGrid,
    signal::spectrum::{ArmaModel, log_spectral_distance_db},
};

/// Reference for the compile error of an asset at full fidelity. A reduced asset is measured against the rendering of
/// the whole grid, at the places of [`mixture::places`](asperity_texture::model::mixture::places), whatever its source.
#[derive(Debug, Clone)]
pub enum ErrorReference {
    /// The texture before its reduction.
    Texture,
    /// The models of the source, one for each vertex; none where it is silent.
    Models {
        /// In the order of the vertices.
        at_vertices: Vec<Option<ArmaModel>>,
        /// The largest distance that is accepted, dB.
        budget_db: f64,
    },
}

impl ErrorReference {
    /// Distances of an asset, dB: at every vertex that sounds where nothing was left out, else over
    /// the grid, and then they are also what the reduction cost.
    pub(crate) fn compared(
        &self,
        passed: &mut Passed,
        fidelity: Fidelity,
    ) -> Result<Compared, PipelineError> {
        let errors_db = self.distances(passed, fidelity)?;
        Ok(Compared {
            error: ErrorSummary::of(&errors_db),
            count: errors_db.len(),
        })
    }

    fn distances(
        &self,
        passed: &mut Passed,
        fidelity: Fidelity,
    ) -> Result<Vec<f64>, PipelineError> {
        let asset = Asset::parse(&passed.lowered.bytes).map_err(VerifyError::from)?;
        let stored = raise(&asset).grid;
        let whole = &passed.whole.grid;
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
        (passed.reduction.p95_db, passed.reduction.worst_db) = distances.summary();
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
