//! Libraries that textures are taken of.

use crate::emit::textures::{Textures, TexturesProblem};
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failure, Fault};
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
pub struct OpenLibraries(Mutex<HashMap<PathBuf, Arc<Mutex<Textures>>>>);

impl OpenLibraries {
    /// The bytes of an asset, or of one texture of a library, which parse.
    pub(super) fn asset(&self, file: &Path, texture: Option<&str>) -> Result<Vec<u8>, Failure> {
        let source = self.open(file)?;
        let mut source = source.lock().unwrap_or_else(PoisonError::into_inner);
        let bytes = source
            .choose(texture)
            .map_err(|error| match error.problem {
                TexturesProblem::NoneChosen { count } => {
                    let what = format!("the library has {count} textures, and none is named");
                    let name = file.file_name().unwrap_or_default().to_string_lossy();
                    let remedy = format!("name one of them: asset = \"{name}#NAME\"");
                    Failure::from(Fault::new(what, remedy).at(file))
                }
                _ => error.into(),
            })?;
        match Asset::parse(&bytes) {
            Ok(_) => Ok(bytes),
            Err(error) => Err(source.error(texture, error.into()).into()),
        }
    }

    fn open(&self, file: &Path) -> Result<Arc<Mutex<Textures>>, Failure> {
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(source) = open.get(file) {
            return Ok(Arc::clone(source));
        }
        let source = Textures::open(file)?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        emit::{
            lower::lower,
            textures::{ENTRIES_READ, tests::library_of},
        },
        sources::builtin,
    };
    use std::fs;

    /// A manifest may take every texture of a library, each by an entry of its own.
    #[test]
    fn the_index_of_a_library_is_read_once_for_all_of_its_textures() {
        let folder = tempfile::tempdir().unwrap();
        let (library, alone) = (folder.path().join("a.aspl"), folder.path().join("a.asp"));
        let asset = lower(&builtin::texture(), None).unwrap().bytes;
        let names: Vec<String> = (0..50).map(|n| format!("t{n:02}")).collect();
        fs::write(&library, library_of(&names, &asset)).unwrap();
        fs::write(&alone, &asset).unwrap();
        let libraries = OpenLibraries::default();
        let before = ENTRIES_READ.get();
        for name in &names {
            assert_eq!(libraries.asset(&library, Some(name)).unwrap(), asset);
            assert_eq!(libraries.asset(&alone, None).unwrap(), asset);
        }
        assert_eq!(ENTRIES_READ.get() - before, names.len());
        // Assets are not kept open, and neither are more libraries than a few.
        let copies = (0..2 * MOST_OPEN).map(|n| folder.path().join(format!("{n}.aspl")));
        for copy in copies {
            fs::copy(&library, &copy).unwrap();
            libraries.asset(&copy, Some("t07")).unwrap();
            assert!(libraries.0.lock().unwrap().len() <= MOST_OPEN);
        }
        assert!(libraries.asset(&library, Some("gone")).is_err());
    }
}
