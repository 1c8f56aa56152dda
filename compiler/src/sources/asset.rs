//! An asset, or a texture of a library, taken as it is.

use super::{
    ManifestSource, Operand, Source, SourceKind, SourceOutput, Tools,
    key::{Key, Parts},
    libraries::OpenLibraries,
};
use crate::{
    edit_memory::remembered,
    emit::raise::raise,
    passes::reduce::Fidelity,
    pipeline::{Pass, Pipeline, Request},
};
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failure, Fault};
use std::{path::PathBuf, sync::Arc};

/// `asset` of a manifest.
pub const KIND: SourceKind = SourceKind {
    key: "asset",
    operand: Operand::File,
    open: |stated| {
        Ok(Arc::new(AssetFile {
            file: stated.path.to_owned(),
            texture: stated.texture.map(str::to_owned),
        }))
    },
    options: &[],
    refuses: &["seed", "fidelity", "rate", "preview", "loudness", "edit"],
    fidelity: Fidelity::Full,
    preview: false,
};

/// An asset, or one texture of a library.
#[derive(Debug, Clone)]
pub struct AssetFile {
    /// The file.
    pub file: PathBuf,
    /// The texture of a library, by name or index.
    pub texture: Option<String>,
}

impl AssetFile {
    fn bytes(&self, tools: &Tools<'_>) -> Result<Vec<u8>, Failure> {
        let texture = self.texture.as_deref();
        match tools.libraries {
            Some(libraries) => libraries.asset(&self.file, texture),
            None => OpenLibraries::default().asset(&self.file, texture),
        }
    }
}

impl Source for AssetFile {
    fn inputs(&self) -> Vec<PathBuf> {
        vec![self.file.clone()]
    }

    fn model(
        &self,
        _: &Request,
        tools: &Tools<'_>,
        pipeline: &mut Pipeline,
    ) -> Result<SourceOutput, Failure> {
        let bytes = pipeline.run(Pass::Read, || self.bytes(tools))?;
        let asset = parsed(&bytes)?;
        let texture = raise(&asset);
        // Bytes that are taken as they are may have a history that this version does not read.
        let memory = remembered(&asset).ok().flatten();
        Ok(SourceOutput {
            certainty: memory.and_then(|memory| memory.history.certainty),
            asset: Some(bytes),
            ..SourceOutput::new(texture)
        })
    }
}

impl ManifestSource for AssetFile {
    fn key(&self, parts: Parts, tools: &Tools<'_>) -> Result<Parts, Failure> {
        let name = self.file.file_name().unwrap_or_default();
        let content = Key::of(&self.bytes(tools)?);
        Ok(parts.text(&name.to_string_lossy()).part(content.bytes()))
    }
}

/// Parses an asset, of which it does not matter where it was.
pub(crate) fn parsed(bytes: &[u8]) -> Result<Asset<'_>, Fault> {
    Asset::parse(bytes).map_err(|error| Fault::new(error, "build the file again from its source"))
}
