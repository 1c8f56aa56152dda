//! The bytes of a texture, checked, and what they say.

use crate::error::Failure;
use asperity::{
    emit::{
        raise::raise,
        textures::{TexturesError, TexturesProblem},
    },
    views::{
        inspect::Document,
        plot::{self, AssetBytes},
        preview,
    },
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
        let asset = self.asset()?;
        let sizes = AssetBytes {
            haptic: asset.haptic_len(),
            total: asset.total_len(),
        };
        let picture = asset
            .preview_png()
            .and_then(|png| preview::stored(png).ok());
        plot::sheet_with_picture(&raise(&asset), Some(sizes), picture.as_ref()).map_err(|error| {
            let message = format!("the sheet cannot be drawn: {error}");
            Failure::new(message, "free memory and try again")
        })
    }
}
