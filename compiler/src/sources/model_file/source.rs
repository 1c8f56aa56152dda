//! A model file as a source.

use super::{read::read_with, scale};
use crate::{
    compiled::ErrorReference,
    pipeline::{Pass, Pipeline, Request},
    sources::{ManifestSource, Source, SourceOutput, Tools, key::Parts},
};
use asperity_io::diagnostic::Failure;
use asperity_io::input::InputKind;
use std::path::PathBuf;

/// A texture of one's own as JSON.
#[derive(Debug, Clone)]
pub struct ModelFile {
    /// The file.
    pub file: PathBuf,
}

impl Source for ModelFile {
    fn origin(&self) -> String {
        self.file.display().to_string()
    }

    fn inputs(&self) -> Vec<PathBuf> {
        vec![self.file.clone()]
    }

    fn model(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        let (mut texture, crc32) = pipeline.run(Pass::Read, || read_with(&self.file, tools))?;
        // Prompt, seed and notes are those of the file.
        let provenance = &mut texture.provenance;
        provenance.generator = format!("asperity {} import model", env!("CARGO_PKG_VERSION"));
        let name = self.file.file_name().unwrap_or_default();
        provenance.source = name.to_string_lossy().into_owned();
        provenance.source_crc32 = crc32;
        Ok(SourceOutput {
            warnings: scale::doubts(&texture),
            truth: Some(ErrorReference::Texture),
            ..SourceOutput::new(texture)
        })
    }
}

impl ManifestSource for ModelFile {
    fn key(&self, parts: Parts, _: &Tools<'_>) -> Result<Parts, Failure> {
        Ok(parts.file(&self.file, InputKind::Model)?)
    }
}
