//! From files to verified assets, with the distance of each from its source.

use super::{
    error::{HattError, Problem},
    import_error::{BUDGET_DB, ImportError},
    material::{self, Material, SourceModel},
    texture::to_model,
};
use crate::{
    front_ends::{
        imported::{Imported, Truth},
        learned::{LearnedModel, ModelError, complete},
    },
    model::TextureModel,
    passes::reduce::Fidelity,
    pipeline::{Pass, Pipeline, Request, Ringing},
    signal::spectrum::ArmaModel,
};
use asperity_io::input::{self, InputProblem, Kind};
use rayon::prelude::*;
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

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
    let unreadable = |e| fail(Problem::Input(InputProblem::Unreadable(e)));
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if !metadata.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let mut found = Vec::new();
    for entry in std::fs::read_dir(path).map_err(unreadable)? {
        let file = entry.map_err(unreadable)?.path();
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
    let mut pipeline = Pipeline::default();
    let (material, mut whole) = pipeline.run(Pass::Read, || read(file))?;
    if let Some(model) = completer {
        pipeline
            .run(Pass::Complete, || complete(&mut whole, model))
            .map_err(|cause| ImportError::Complete {
                file: file.to_owned(),
                cause,
            })?;
    }
    let request = Request {
        fidelity,
        ..Request::default()
    };
    let mut imported = pipeline
        .import(whole, &request, Ringing::Refused, &truth(&material))
        .map_err(|cause| ImportError::Pipeline {
            file: file.to_owned(),
            cause,
        })?;
    let recomputed = |m: &SourceModel| usize::from(m.ar.recomputed) + usize::from(m.ma.recomputed);
    imported.report.recomputed = material.models.iter().map(recomputed).sum();
    Ok(imported)
}

/// The bytes of a file, at most as many as a material may have.
///
/// # Errors
/// [`HattError`] for a file that cannot be read or is too large.
pub fn bytes(file: &Path) -> Result<Vec<u8>, HattError> {
    input::read(file, Kind::Hatt).map_err(|problem| HattError {
        file: file.to_owned(),
        line: None,
        problem: problem.into(),
    })
}

fn read(file: &Path) -> Result<(Material, TextureModel), HattError> {
    let source = bytes(file)?;
    let material = material::parse(file, &source)?;
    let source_name = file.file_name().unwrap_or_default().to_string_lossy();
    let whole = to_model(&material, &source_name, crc32fast::hash(&source));
    Ok((material, whole))
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

/// The coefficients of the material.
fn truth(material: &Material) -> Truth {
    let model = |model: &SourceModel| {
        (model.variance != 0.0).then(|| ArmaModel {
            sample_rate_hz: material.sample_rate_hz,
            a: model.ar.monic.clone(),
            b: model.ma.monic.clone(),
            level_m_s2: model.gain * model.variance.sqrt(),
        })
    };
    Truth::Models {
        at_vertices: material.models.iter().map(model).collect(),
        budget_db: BUDGET_DB,
    }
}
