//! The bytes of a texture, checked, and what they say.

use crate::error::Failure;
use asperity::{
    emit::textures::{TexturesError, TexturesProblem},
    views::{inspect::Document, plot},
};
use asperity_formats::{Asset, FormatError};
use std::{path::Path, sync::OnceLock};

/// The bytes of a texture, which parse, and what they say, read when first asked.
pub(crate) struct Contents {
    bytes: Vec<u8>,
    document: OnceLock<Box<Document>>,
}

impl Contents {
    /// Checks the bytes of `texture` in the file at `path`, or of the file itself.
    pub(crate) fn new(
        bytes: Vec<u8>,
        path: &Path,
        texture: Option<&str>,
    ) -> Result<Self, TexturesError> {
        match Asset::parse(&bytes) {
            Ok(_) => Ok(Self {
                bytes,
                document: OnceLock::new(),
            }),
            Err(error) => Err(TexturesError {
                path: path.to_owned(),
                texture: texture.map(str::to_owned),
                problem: TexturesProblem::Format(error),
            }),
        }
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The asset. The bytes were checked, so it parses.
    pub(crate) fn asset(&self) -> Result<Asset<'_>, Failure> {
        Asset::parse(&self.bytes).map_err(|error: FormatError| {
            Failure::new(error, "make the texture again from its source")
        })
    }

    /// Everything in the asset.
    pub(crate) fn document(&self) -> Result<&Document, Failure> {
        if let Some(document) = self.document.get() {
            return Ok(document);
        }
        let document = Box::new(Document::of(&self.asset()?));
        Ok(self.document.get_or_init(|| document))
    }

    /// The sheet that `asperity plot` draws, as PNG.
    pub(crate) fn sheet(&self) -> Result<Vec<u8>, Failure> {
        Ok(plot::of_asset(&self.asset()?)?)
    }
}
