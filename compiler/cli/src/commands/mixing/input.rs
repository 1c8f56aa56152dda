//! Textures that are mixed: an asset, or one of a library as `FILE.aspl#NAME`.

use asperity::source::Source;
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failures, one};
use std::path::{Path, PathBuf};

/// One texture that a command reads.
pub(super) struct Input {
    path: PathBuf,
    texture: Option<String>,
}

impl Input {
    /// What an argument means. A file whose name holds a `#` is that file.
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

    /// Its bytes, which parse.
    pub(super) fn read(&self) -> Result<Vec<u8>, Failures> {
        let wanted = self.texture.as_deref();
        let mut source = Source::open(&self.path).map_err(one)?;
        let bytes = source.choose(wanted).map_err(one)?;
        match Asset::parse(&bytes) {
            Ok(_) => Ok(bytes),
            Err(error) => Err(one(source.error(wanted, error.into()))),
        }
    }
}

/// The asset of bytes that [`Input::read`] gave.
pub(in crate::commands) fn parsed(bytes: &[u8]) -> Result<Asset<'_>, Failures> {
    Asset::parse(bytes).map_err(|error| one(asperity::edit::EditError::from(error)))
}
