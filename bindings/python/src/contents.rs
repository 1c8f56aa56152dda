//! A texture: its bytes, checked, and what they say.

use crate::error::Failure;
use asperity::{
    emit::textures::{TexturesError, TexturesProblem},
    views::{inspect::Document, plot},
};
use asperity_formats::{Asset, FormatError};
use pyo3::{prelude::*, sync::PyOnceLock};
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

/// A haptic texture: a compiled, verified asset.
///
/// Textures come from `compile`, `load`, `blend`, the imports and `builtin`. A texture does not
/// change; what it holds is read when it is first asked for.
///
/// Parameters
/// ----------
/// data : bytes
///     The bytes of an asset (.asp).
///
/// Raises
/// ------
/// AsperityError
///     Where the bytes are no valid asset.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> texture = asperity.builtin()
/// >>> texture.grid.lsf_rad.shape == (len(texture.grid.force_n), texture.grid.order)
/// True
#[pyclass(frozen, eq, module = "asperity")]
pub(crate) struct Texture {
    pub(crate) contents: Contents,
    /// JSON: what the source had to say.
    pub(crate) report: Option<String>,
    pub(crate) grid: PyOnceLock<Py<PyAny>>,
    pub(crate) taps: PyOnceLock<Py<PyAny>>,
}

impl PartialEq for Texture {
    fn eq(&self, other: &Self) -> bool {
        self.contents.bytes() == other.contents.bytes()
    }
}

impl Texture {
    /// A texture of checked bytes, with the report of what made it.
    pub(crate) fn new(contents: Contents, report: Option<String>) -> Self {
        Self {
            contents,
            report,
            grid: PyOnceLock::new(),
            taps: PyOnceLock::new(),
        }
    }

    /// A texture that the compiler has just made.
    pub(crate) fn made(bytes: Vec<u8>, report: Option<String>) -> Result<Self, Failure> {
        let contents = Contents::new(bytes, Path::new("texture"), None)?;
        Ok(Self::new(contents, report))
    }

    pub(crate) fn document(&self) -> Result<&Document, Failure> {
        self.contents.document()
    }
}
