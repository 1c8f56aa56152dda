//! Textures that are mixed: an asset, or one of a library as `FILE.aspl#NAME`.

use asperity::emit::textures::Textures;
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failures, one};
use std::path::{Path, PathBuf};

/// An input texture.
pub(super) struct Input {
    path: PathBuf,
    texture: Option<String>,
}

impl Input {
    /// Parses an argument. If a file of that whole name exists, a `#` in it is not a separator.
    pub(super) fn of(argument: &str) -> Self {
        let whole = || Self {
            path: argument.into(),
            texture: None,
        };
        match argument.rsplit_once('#') {
            Some((file, texture)) if !Path::new(argument).exists() => Self {
                path: file.into(),
                texture: Some(texture.to_owned()),
            },
            _ => whole(),
        }
    }

    /// Its file.
    pub(super) fn path(&self) -> PathBuf {
        self.path.clone()
    }

    /// Its bytes.
    pub(super) fn read(self) -> Result<Chosen, Failures> {
        let mut textures = Textures::open(&self.path).map_err(one)?;
        let bytes = textures.choose(self.texture.as_deref()).map_err(one)?;
        Ok(Chosen {
            input: self,
            textures,
            bytes,
        })
    }
}

/// An input texture and its bytes.
pub(super) struct Chosen {
    input: Input,
    textures: Textures,
    bytes: Vec<u8>,
}

impl Chosen {
    /// The asset.
    pub(super) fn asset(&self) -> Result<Asset<'_>, Failures> {
        let wanted = self.input.texture.as_deref();
        Asset::parse(&self.bytes).map_err(|e| one(self.textures.error(wanted, e.into())))
    }
}
