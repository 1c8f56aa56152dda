//! HaTT files as sources.

use super::{
    material::{self, Material, SourceModel},
    texture::to_model,
};
use crate::{
    compiled::{Compiled, ErrorReference},
    learned::{LearnedModel, complete},
    pipeline::{Pass, Pipeline, Request},
    sources::{Findings, ManifestSource, Source, SourceOutput, Tools, key::Parts},
};
use asperity_io::{
    diagnostic::{Failure, Fault},
    input::{self, InputKind, InputProblem},
};
use asperity_texture::{model::TextureModel, signal::spectrum::ArmaModel};
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    sync::Arc,
};

/// Largest RMS log-spectral error of a vertex against its source, dB.
pub const BUDGET_DB: f64 = 0.5;

/// The HaTT files of a path: itself, or every `.xml` file of a folder in order of name.
///
/// # Errors
/// [`Fault`] for a path that cannot be read or a folder without such files.
pub fn files(path: &Path) -> Result<Vec<PathBuf>, Fault> {
    let unreadable = |error| Fault::from(InputProblem::Unreadable(error)).at(path);
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
        let remedy = "give the folder that holds the `Models_<name>.xml` files";
        return Err(Fault::new("has no .xml file", remedy).at(path));
    }
    found.sort();
    Ok(found)
}

/// Refuses a material that has the name of one before it: a library holds one of each name.
pub fn refuse_namesakes(materials: &[Hatt], results: &mut [Result<Compiled, Failure>]) {
    let mut first_with: HashMap<String, &Path> = HashMap::new();
    for (Hatt { file, .. }, result) in materials.iter().zip(results) {
        let Ok(compiled) = result else { continue };
        let name = &compiled.texture.name;
        if let Some(other) = first_with.get(name) {
            let what = format!("material {name:?} is also in {}", other.display());
            let remedy = "rename one <material>, or import the two files to different outputs";
            *result = Err(Fault::new(what, remedy).at(file).into());
        } else {
            first_with.insert(name.clone(), file);
        }
    }
}

/// A material of the Penn Haptic Texture Toolkit.
#[derive(Debug, Clone)]
pub struct Hatt {
    /// Its file.
    pub file: PathBuf,
    /// True if the learned model decodes the taps, which HaTT lacks, from the AR grid; otherwise they are synthesised.
    pub complete_taps: bool,
}

impl Hatt {
    /// The material of a file, with synthesised taps.
    pub fn new(file: impl Into<PathBuf>) -> Self {
        Self {
            file: file.into(),
            complete_taps: false,
        }
    }
}

impl Source for Hatt {
    fn origin(&self) -> String {
        self.file.display().to_string()
    }

    fn inputs(&self) -> Vec<PathBuf> {
        vec![self.file.clone()]
    }

    fn needs_model(&self) -> bool {
        self.complete_taps
    }

    fn model(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        let (material, mut texture) = pipeline.run(Pass::Read, || read(&self.file, tools))?;
        if self.complete_taps {
            let model = tools.model()?;
            pipeline
                .run(Pass::Complete, || complete(&mut texture, model))
                .map_err(|cause| Fault::of(&cause).at(&self.file).field("taps"))?;
        }
        let recomputed =
            |m: &SourceModel| usize::from(m.ar.recomputed) + usize::from(m.ma.recomputed);
        let recomputed = Recomputed(material.models.iter().map(recomputed).sum());
        Ok(SourceOutput {
            truth: Some(truth(&material)),
            findings: Some(Arc::new(recomputed)),
            ..SourceOutput::new(texture)
        })
    }
}

impl ManifestSource for Hatt {
    fn key(&self, parts: Parts, _: &Tools<'_>) -> Result<Parts, Failure> {
        let parts = parts.part(&[self.complete_taps.into()]);
        Ok(parts.file(&self.file, InputKind::Hatt)?)
    }
}

/// Number of polynomials whose printed LSFs described another filter.
#[derive(Debug)]
pub struct Recomputed(pub usize);

impl Findings for Recomputed {
    fn text(&self, compiled: &Compiled) -> String {
        match self.0 {
            0 => compiled.line(),
            lists => format!("{}, {lists} LSF lists recomputed", compiled.line()),
        }
    }
}

/// The bytes of a file, at most as many as a material may have.
///
/// # Errors
/// [`Fault`] for a file that cannot be read or is too large.
pub fn bytes(file: &Path) -> Result<Vec<u8>, Fault> {
    input::read(file, InputKind::Hatt).map_err(|problem| Fault::from(problem).at(file))
}

fn read(file: &Path, tools: &Tools<'_>) -> Result<(Material, TextureModel), Fault> {
    let source = tools
        .file(file, InputKind::Hatt)
        .map_err(|problem| Fault::from(problem).at(file))?;
    let material = material::parse(file, &source)?;
    let source_name = file.file_name().unwrap_or_default().to_string_lossy();
    let whole = to_model(&material, &source_name, crc32fast::hash(&source));
    Ok((material, whole))
}

/// Taps from the AR grid, by the learned model.
fn complete(texture: &mut TextureModel, model: &LearnedModel) -> Result<(), Fault> {
    texture.taps = complete::taps_of_grid(model, &texture.grid, &texture.gains)?;
    texture.provenance.notes = format!(
        "Taps decoded from the AR grid by the learned model {} (trained on synthetic taps). {}",
        model.description().name,
        texture.provenance.notes
    );
    Ok(())
}

/// The coefficients of the material.
fn truth(material: &Material) -> ErrorReference {
    let model = |model: &SourceModel| {
        (model.variance != 0.0).then(|| ArmaModel {
            sample_rate_hz: material.sample_rate_hz,
            a: model.ar.monic.clone(),
            b: model.ma.monic.clone(),
            level_m_s2: model.gain * model.variance.sqrt(),
        })
    };
    ErrorReference::Models {
        at_vertices: material.models.iter().map(model).collect(),
        budget_db: BUDGET_DB,
    }
}
