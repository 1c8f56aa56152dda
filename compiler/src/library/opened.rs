//! The assets and libraries that a manifest takes textures of.

use super::error::{Cause, cause};
use crate::back_end::source::Source;
use asperity_formats::Asset;
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};

/// Libraries that stay open: each holds a file and its index.
const MOST_OPEN: usize = 16;

/// Reads textures of files. A library stays open, so that its index is read once and not for each
/// of its textures.
#[derive(Debug, Default)]
pub(super) struct OpenLibraries(Mutex<HashMap<PathBuf, Arc<Mutex<Source>>>>);

impl OpenLibraries {
    /// The bytes of an asset, or of one texture of a library, which parse.
    pub(super) fn asset(&self, file: &Path, texture: Option<&str>) -> Result<Vec<u8>, Cause> {
        let source = self.open(file)?;
        let mut source = source.lock().unwrap_or_else(PoisonError::into_inner);
        let bytes = source.choose(texture).map_err(cause)?;
        match Asset::parse(&bytes) {
            Ok(_) => Ok(bytes),
            Err(error) => Err(cause(source.error(texture, error.into()))),
        }
    }

    fn open(&self, file: &Path) -> Result<Arc<Mutex<Source>>, Cause> {
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(source) = open.get(file) {
            return Ok(Arc::clone(source));
        }
        let source = Source::open(file).map_err(cause)?;
        let is_library = source.is_library();
        let source = Arc::new(Mutex::new(source));
        if is_library {
            if open.len() == MOST_OPEN {
                open.clear();
            }
            open.insert(file.to_owned(), Arc::clone(&source));
        }
        Ok(source)
    }
}
