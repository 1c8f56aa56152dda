//! Opens what other commands wrote: an asset, or one texture of a library.

mod bytes;
mod error;
#[cfg(test)]
mod tests;

pub use error::{SourceError, SourceProblem};

use asperity_formats::{
    FormatError, SceneSurface,
    library::{self, LibraryIndex},
};
use bytes::{Bytes, STANDARD_INPUT};
use error::MAX_ASSET_BYTES;
use std::{
    io::{Read as _, Seek as _, SeekFrom},
    path::{Path, PathBuf},
};

/// An open asset or library.
#[derive(Debug)]
pub struct Source {
    path: PathBuf,
    file: Bytes,
    len: u64,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Asset,
    /// The bytes of the index, which parse.
    Library(Vec<u8>),
}

impl Source {
    /// Opens a file and tells by its first bytes what it is. Of a library, only the index
    /// is read. `-` is standard input; what comes from there or from a pipe is read at once.
    ///
    /// # Errors
    /// [`SourceError`] for a file that cannot be read or is of another kind, and for a
    /// damaged index.
    pub fn open(path: &Path) -> Result<Self, SourceError> {
        Self::try_open(path).map_err(|problem| SourceError {
            path: path.to_owned(),
            texture: None,
            problem,
        })
    }

    fn try_open(path: &Path) -> Result<Self, SourceProblem> {
        let mut file = Bytes::open(path)?;
        let mut head = Vec::new();
        (&mut file)
            .take(library::HEADER_LEN as u64)
            .read_to_end(&mut head)?;
        let len = file.len()?;
        let content = if head.starts_with(b"ASPL") {
            let index_len = library::index_len(&head)?;
            let mut index = vec![0; index_len];
            file.seek(SeekFrom::Start(0))?;
            if index_len as u64 > len {
                return Err(FormatError::TooShort {
                    field: "library index",
                    needed: index_len as u64,
                    found: len,
                }
                .into());
            }
            file.read_exact(&mut index)?;
            let total = LibraryIndex::parse(&index)?.total_len();
            if len < total {
                return Err(FormatError::TooShort {
                    field: "library",
                    needed: total,
                    found: len,
                }
                .into());
            }
            if len > total {
                return Err(FormatError::TooLong {
                    field: "library",
                    stated: total,
                    found: len,
                }
                .into());
            }
            Content::Library(index)
        } else if head.starts_with(b"ASPT") {
            Content::Asset
        } else {
            return Err(SourceProblem::WrongKind);
        };
        Ok(Self {
            path: path.to_owned(),
            file,
            len,
            content,
        })
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file as a report calls it.
    #[must_use]
    pub fn shown(&self) -> String {
        if self.path == Path::new(STANDARD_INPUT) {
            "standard input".into()
        } else {
            self.path.display().to_string()
        }
    }

    /// Names of a library's textures in order; `None` for an asset.
    #[must_use]
    pub fn names(&self) -> Option<Vec<String>> {
        match &self.content {
            Content::Asset => None,
            // Parsed when it was opened.
            Content::Library(index) => Some(LibraryIndex::parse(index).map_or_else(
                |_| Vec::new(),
                |index| index.entries().map(|e| e.name.to_owned()).collect(),
            )),
        }
    }

    /// Version of the format of a library; `None` for an asset.
    #[must_use]
    pub fn library_version(&self) -> Option<u16> {
        match &self.content {
            Content::Asset => None,
            Content::Library(index) => LibraryIndex::parse(index).ok().map(|i| i.version()),
        }
    }

    /// Surfaces of a library's scene; none without a scene.
    ///
    /// # Errors
    /// [`SourceError`] for a damaged scene.
    pub fn surfaces(&mut self) -> Result<Vec<SceneSurface>, SourceError> {
        let Content::Library(index) = &self.content else {
            return Ok(Vec::new());
        };
        // Parsed when it was opened.
        let Ok(index) = LibraryIndex::parse(index) else {
            return Ok(Vec::new());
        };
        let (range, textures) = (index.scene_range(), index.len());
        let Some(range) = range else {
            return Ok(Vec::new());
        };
        let bytes = self.read(range.start, range.end - range.start, None)?;
        let scene = asperity_formats::Scene::parse(&bytes, textures)
            .map_err(|e| self.error(None, e.into()))?;
        Ok(scene.surfaces().collect())
    }

    /// Bytes of the whole library if it has a scene.
    ///
    /// # Errors
    /// [`SourceError`] for a failed read.
    pub fn scene_library(&mut self) -> Result<Option<Vec<u8>>, SourceError> {
        let has_scene = match &self.content {
            Content::Asset => false,
            Content::Library(index) => {
                LibraryIndex::parse(index).is_ok_and(|index| index.scene_range().is_some())
            }
        };
        has_scene.then(|| self.read(0, self.len, None)).transpose()
    }

    /// Bytes of the one texture that `wanted` means, a name or an index of a library. An asset and a
    /// library of one texture need no `wanted`, but one that is given must fit.
    ///
    /// # Errors
    /// [`SourceError`] for a texture that is not there, or none chosen of several.
    pub fn choose(&mut self, wanted: Option<&str>) -> Result<Vec<u8>, SourceError> {
        let Some(names) = self.names() else {
            let bytes = self.read(0, self.len, None)?;
            let name = asperity_formats::Asset::parse(&bytes)
                .map_err(|e| self.error(None, e.into()))?
                .name();
            return match wanted {
                Some(wanted) if wanted != name && wanted != "0" => {
                    Err(self.no_such_texture(wanted, 1))
                }
                _ => Ok(bytes),
            };
        };
        self.texture(self.index(&names, wanted)?)
    }

    /// The name in a library's index of the texture that `wanted` means, as
    /// [`choose`](Self::choose) takes it; `None` for an asset.
    ///
    /// # Errors
    /// As [`choose`](Self::choose).
    pub fn chosen_name(&self, wanted: Option<&str>) -> Result<Option<String>, SourceError> {
        let Some(names) = self.names() else {
            return Ok(None);
        };
        let index = self.index(&names, wanted)?;
        Ok(names.into_iter().nth(index))
    }

    fn index(&self, names: &[String], wanted: Option<&str>) -> Result<usize, SourceError> {
        let count = names.len();
        match wanted {
            None if count == 1 => Ok(0),
            None => Err(self.error(None, SourceProblem::NoneChosen { count })),
            Some(wanted) => names
                .iter()
                .position(|name| name == wanted)
                .or_else(|| wanted.parse().ok().filter(|&index: &usize| index < count))
                .ok_or_else(|| self.no_such_texture(wanted, count)),
        }
    }

    /// Bytes of a library's texture at `index`, unchecked. The others are not read.
    ///
    /// # Errors
    /// [`SourceError`] for an index that is not there, or a failed read.
    pub fn texture(&mut self, index: usize) -> Result<Vec<u8>, SourceError> {
        let place = match &self.content {
            Content::Asset => (index == 0).then_some((0, self.len, None)),
            Content::Library(bytes) => LibraryIndex::parse(bytes)
                .ok()
                .and_then(|parsed| parsed.get(index))
                .map(|e| (e.offset, u64::from(e.len), Some(e.name.to_owned()))),
        };
        let Some((offset, len, name)) = place else {
            return Err(self.no_such_texture(&index.to_string(), index));
        };
        self.read(offset, len, name.as_deref())
    }

    fn read(&mut self, offset: u64, len: u64, name: Option<&str>) -> Result<Vec<u8>, SourceError> {
        if len > MAX_ASSET_BYTES {
            return Err(self.error(name, SourceProblem::TooLarge { bytes: len }));
        }
        let mut bytes = Vec::new();
        let read = self
            .file
            .seek(SeekFrom::Start(offset))
            .and_then(|_| (&mut self.file).take(len).read_to_end(&mut bytes));
        match read {
            Ok(_) => Ok(bytes),
            Err(e) => Err(self.error(name, e.into())),
        }
    }

    /// An error about this file, or one of its textures.
    #[must_use]
    pub fn error(&self, texture: Option<&str>, problem: SourceProblem) -> SourceError {
        SourceError {
            path: self.path.clone(),
            texture: texture.map(str::to_owned),
            problem,
        }
    }

    fn no_such_texture(&self, wanted: &str, count: usize) -> SourceError {
        let wanted = wanted.to_owned();
        self.error(None, SourceProblem::NoSuchTexture { wanted, count })
    }
}
