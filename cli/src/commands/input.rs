//! Textures that commands read: an asset, or one of a library.

use asperity::emit::textures::Textures;
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failures, one};
use std::path::{Path, PathBuf};

/// A texture that an argument names as `FILE` or `FILE.aspl#NAME`.
pub(super) struct Input {
    pub(super) file: PathBuf,
    texture: Option<String>,
}

impl Input {
    /// Parses an argument. If a file of that whole name exists, a `#` in it is not a separator.
    pub(super) fn of(argument: &str) -> Self {
        let (file, texture) = match argument.rsplit_once('#') {
            Some((file, texture)) if !Path::new(argument).exists() => (file, Some(texture.into())),
            _ => (argument, None),
        };
        Self {
            file: file.into(),
            texture,
        }
    }

    /// Its bytes.
    pub(super) fn read(self) -> Result<Chosen, Failures> {
        Chosen::open(&self.file, self.texture)
    }
}

/// A texture and its bytes.
pub(super) struct Chosen {
    pub(super) textures: Textures,
    texture: Option<String>,
    pub(super) bytes: Vec<u8>,
}

impl Chosen {
    /// Reads an asset, or the texture of a library that `texture` means, by name or index.
    pub(super) fn open(file: &Path, texture: Option<String>) -> Result<Self, Failures> {
        Self::of(Textures::open(file).map_err(one)?, texture)
    }

    /// The same of a file that is open.
    pub(super) fn of(mut textures: Textures, texture: Option<String>) -> Result<Self, Failures> {
        Ok(Self {
            bytes: textures.choose(texture.as_deref()).map_err(one)?,
            textures,
            texture,
        })
    }

    /// The asset.
    pub(super) fn asset(&self) -> Result<Asset<'_>, Failures> {
        let texture = self.texture.as_deref();
        Asset::parse(&self.bytes).map_err(|e| one(self.textures.error(texture, e.into())))
    }
}
