//! From a model file to a verified asset.

use super::{error::ModelFileError, read::read};
use crate::{
    front_ends::imported::{Imported, Truth},
    model::TextureModel,
    passes::reduce::Fidelity,
    pipeline::{Pass, Pipeline, PipelineError, Preview, Settings},
};
use std::path::Path;

/// What a user can ask of an import.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// How much of the model the asset keeps.
    pub fidelity: Fidelity,
    /// Rate of the AR models, Hz; that of the file if `None`.
    pub rate_hz: Option<f64>,
    /// Whether a preview is drawn.
    pub preview: bool,
    /// Width and height of the preview, pixels.
    pub preview_px: u32,
}

/// Imports a model: read, check, compile, compare with the source.
///
/// # Errors
/// [`ModelFileError`]; nothing is written either way.
pub fn import(file: &Path, options: &Options) -> Result<Imported, ModelFileError> {
    let mut pipeline = Pipeline::default();
    let whole = pipeline.run(Pass::Read, || read(file))?;
    let whole = with_source(whole, file);
    let settings = Settings {
        rate_hz: options.rate_hz,
        fidelity: options.fidelity,
        preview: options.preview.then_some(Preview {
            size_px: options.preview_px,
        }),
        stabilise: false,
    };
    let fail = |cause: PipelineError| ModelFileError {
        file: file.to_owned(),
        field: String::new(),
        problem: cause.into(),
    };
    pipeline
        .import(whole, &settings, &Truth::Texture)
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
