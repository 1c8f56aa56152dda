//! From files to verified assets, with one line of error statistics a material.

use super::{HattError, Material, Problem, material, to_model, xml};
use crate::{
    diagnostic::Diagnostic,
    learned::{LearnedModel, ModelError, complete},
    lower::{self, Error3, LowerError},
    model::{ModelGrid, TextureModel},
    raise::raise,
    reduce::{self, Fidelity, Reduction, Reference},
    spectrum::{ArmaModel, log_spectral_distance_db},
    verify::{self, VerifyError},
};
use asperity_formats::Asset;
use rayon::prelude::*;
use std::{
    collections::HashMap,
    fmt,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// Largest RMS log-spectral error of a vertex against its source, dB.
pub const BUDGET_DB: f64 = 0.5;

/// Why a file did not become an asset.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file was refused.
    #[error(transparent)]
    Hatt(#[from] HattError),
    /// The texture does not fit an asset.
    #[error("{file}: {cause}", file = file.display())]
    Lower {
        /// The file.
        file: PathBuf,
        /// What does not fit.
        cause: LowerError,
    },
    /// The learned model could not decode the taps.
    #[error("{file}: taps: {cause}", file = file.display())]
    Complete {
        /// The file.
        file: PathBuf,
        /// What went wrong.
        cause: ModelError,
    },
    /// The runtime would not render it faithfully.
    #[error("{file}: verification failed: {cause}", file = file.display())]
    Verify {
        /// The file.
        file: PathBuf,
        /// What went wrong.
        cause: VerifyError,
    },
    /// A vertex of the asset is too far from its source.
    #[error(
        "{file}: model {model} is {distance_db:.3} dB from its source, {BUDGET_DB} at most",
        file = file.display()
    )]
    Budget {
        /// The file.
        file: PathBuf,
        /// Number of the model, 1-based as in the file.
        model: usize,
        /// RMS log-spectral distance, dB.
        distance_db: f64,
    },
}

impl Diagnostic for ImportError {
    fn remedy(&self) -> String {
        match self {
            Self::Hatt(error) => error.remedy(),
            Self::Lower { cause, .. } => cause.remedy(),
            Self::Complete { cause, .. } => cause.remedy(),
            Self::Verify { cause, .. } => cause.remedy(),
            Self::Budget { .. } => {
                "compare coefficients, variance and gain of this model with the original file"
                    .into()
            }
        }
    }
}

/// An imported material.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The asset.
    pub bytes: Vec<u8>,
    /// Its figures.
    pub report: Report,
}

/// Figures of an imported material; prints as one line.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Name of the material.
    pub name: String,
    /// Distance of the asset from its source: in full, from the coefficients of every vertex
    /// that sounds; else, from what the whole grid renders, at the places of
    /// [`interpolate::places`](crate::interpolate::places).
    pub error: Error3,
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

/// The HaTT files of a path: itself, or every `.xml` file of a folder in order of name.
///
/// # Errors
/// [`HattError`] for a path that cannot be read or a folder without such files.
pub fn files(path: &Path) -> Result<Vec<PathBuf>, HattError> {
    let fail = |problem| HattError {
        file: path.to_owned(),
        line: None,
        problem,
    };
    let metadata = std::fs::metadata(path).map_err(|e| fail(Problem::Unreadable(e)))?;
    if !metadata.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let mut found = Vec::new();
    for entry in std::fs::read_dir(path).map_err(|e| fail(Problem::Unreadable(e)))? {
        let file = entry.map_err(|e| fail(Problem::Unreadable(e)))?.path();
        let is_xml = file
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("xml"));
        if is_xml && file.is_file() {
            found.push(file);
        }
    }
    if found.is_empty() {
        return Err(fail(Problem::EmptyFolder));
    }
    found.sort();
    Ok(found)
}

/// Imports files in parallel at a fidelity; results in the order of the files, whatever the
/// thread count. `done` is called once a file, from any thread.
///
/// `completer` decodes the taps that HaTT lacks from the AR grid; without one they are
/// synthesised.
pub fn import_all(
    files: &[PathBuf],
    completer: Option<&LearnedModel>,
    fidelity: Fidelity,
    done: impl Fn() + Sync,
) -> Vec<Result<Imported, ImportError>> {
    let mut results: Vec<_> = files
        .par_iter()
        .map(|file| {
            let result = import_at(file, completer, fidelity);
            done();
            result
        })
        .collect();
    let mut first_with: HashMap<String, &Path> = HashMap::new();
    for (file, result) in files.iter().zip(&mut results) {
        let Ok(imported) = result else { continue };
        let name = &imported.report.name;
        if let Some(other) = first_with.get(name) {
            *result = Err(ImportError::Hatt(HattError {
                file: file.clone(),
                line: None,
                problem: Problem::SameMaterial {
                    name: name.clone(),
                    other: other.display().to_string(),
                },
            }));
        } else {
            first_with.insert(name.clone(), file);
        }
    }
    results
}

/// Imports one file in full: parse, complete, lower, compare with the source, verify.
///
/// # Errors
/// [`ImportError`]; nothing is written either way.
pub fn import(file: &Path, completer: Option<&LearnedModel>) -> Result<Imported, ImportError> {
    import_at(file, completer, Fidelity::Full)
}

/// [`import`] at a fidelity.
///
/// # Errors
/// [`ImportError`]; nothing is written either way.
pub fn import_at(
    file: &Path,
    completer: Option<&LearnedModel>,
    fidelity: Fidelity,
) -> Result<Imported, ImportError> {
    let source = xml::read(file)?;
    let material = material::parse(file, &source)?;
    let source_crc32 = crc32fast::hash(&source);
    let source_name = file.file_name().unwrap_or_default().to_string_lossy();
    let mut full = to_model(&material, &source_name, source_crc32);
    if let Some(model) = completer {
        complete(&mut full, model).map_err(|cause| ImportError::Complete {
            file: file.to_owned(),
            cause,
        })?;
    }
    full.provenance.fidelity = fidelity.to_string();
    let Reduction {
        texture,
        report: mut reduction,
    } = reduce::reduce(&full, fidelity);
    let lowered = lower::lower(&texture, None).map_err(|cause| ImportError::Lower {
        file: file.to_owned(),
        cause,
    })?;
    let fail = |cause| ImportError::Verify {
        file: file.to_owned(),
        cause,
    };
    let asset = Asset::parse(&lowered.bytes).map_err(|e| fail(e.into()))?;
    let stored = raise(&asset).grid;
    let errors_db = if fidelity == Fidelity::Full {
        errors_at_vertices(file, &material, &stored)?
    } else {
        let distances = Reference::new(&full.grid).and_then(|whole| whole.distances(&stored));
        let distances = distances.unwrap_or_default();
        (reduction.p95_db, reduction.worst_db) = distances.summary();
        distances.into_inner()
    };
    verify::verify(&texture, &lowered.bytes).map_err(fail)?;
    let report = Report {
        name: texture.name,
        error: Error3::of(&errors_db),
        compared: errors_db.len(),
        vertices: texture.grid.vertices.len(),
        triangles: texture.grid.triangles.len(),
        models: lowered.models,
        recomputed: material
            .models
            .iter()
            .map(|m| usize::from(m.ar.recomputed) + usize::from(m.ma.recomputed))
            .sum(),
        reduction: (fidelity != Fidelity::Full).then_some(reduction),
        haptic_bytes: lowered.haptic_bytes,
        total_bytes: lowered.bytes.len(),
    };
    Ok(Imported {
        bytes: lowered.bytes,
        report,
    })
}

/// Taps from the AR grid, by the learned model.
fn complete(texture: &mut TextureModel, model: &LearnedModel) -> Result<(), ModelError> {
    texture.taps = complete::taps_of_grid(model, &texture.grid, &texture.gains)?;
    texture.provenance.notes = format!(
        "Taps decoded from the AR grid by the learned model {} (trained on synthetic taps). {}",
        model.description().name,
        texture.provenance.notes
    );
    Ok(())
}

/// Distance of every sounding vertex from the coefficients of its source, dB.
fn errors_at_vertices(
    file: &Path,
    material: &Material,
    stored: &ModelGrid,
) -> Result<Vec<f64>, ImportError> {
    let mut errors_db = Vec::new();
    for (index, (model, vertex)) in material.models.iter().zip(&stored.vertices).enumerate() {
        if model.variance == 0.0 {
            continue;
        }
        let truth = ArmaModel {
            sample_rate_hz: material.sample_rate_hz,
            a: model.ar.monic.clone(),
            b: model.ma.monic.clone(),
            level_m_s2: model.gain * model.variance.sqrt(),
        };
        let distance_db = log_spectral_distance_db(&truth, &ArmaModel::at_vertex(stored, vertex));
        // A NaN fails too.
        if distance_db.is_nan() || distance_db > BUDGET_DB {
            return Err(ImportError::Budget {
                file: file.to_owned(),
                model: index + 1,
                distance_db,
            });
        }
        errors_db.push(distance_db);
    }
    Ok(errors_db)
}
