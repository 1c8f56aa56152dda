//! From a model file to a verified asset.

use super::{error::ModelFileError, read::read};
use crate::{
    front_ends::imported::{Imported, Truth},
    model::TextureModel,
    pipeline::{Pass, Pipeline, PipelineError, Request, Ringing},
};
use std::path::Path;

/// Imports a model: read, check, compile, compare with the source.
///
/// # Errors
/// [`ModelFileError`]; nothing is written either way.
pub fn import(file: &Path, request: &Request) -> Result<Imported, ModelFileError> {
    let mut pipeline = Pipeline::default();
    let whole = pipeline.run(Pass::Read, || read(file))?;
    let whole = with_source(whole, file);
    let fail = |cause: PipelineError| ModelFileError {
        file: file.to_owned(),
        field: String::new(),
        problem: cause.into(),
    };
    pipeline
        .import(whole, request, Ringing::Refused, &Truth::Texture)
        .map_err(fail)
}

/// The asset says which file it was made of; prompt, seed and notes are those of the file.
fn with_source((mut texture, crc32): (TextureModel, u32), file: &Path) -> TextureModel {
    let provenance = &mut texture.provenance;
    provenance.generator = format!("asperity {} import model", env!("CARGO_PKG_VERSION"));
    provenance.source = file
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    provenance.source_crc32 = crc32;
    texture
}
