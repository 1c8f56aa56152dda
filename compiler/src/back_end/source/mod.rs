//! Opens what other commands wrote: an asset, or one texture of a library.

mod error;
#[cfg(test)]
mod tests;

pub use error::{SourceError, SourceProblem};

use crate::input::{self, Format, InputProblem, Kind, Opened};
use asperity_formats::{
    FormatError, SceneSurface,
    library::{self, LibraryIndex},
};
use std::{
    fmt,
    io::{self, Cursor, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

/// The path that means standard input.
const STANDARD_INPUT: &str = "-";

/// Bytes by which the format of another file is told.
const FORMAT_BYTES: u64 = 1 << 20;

/// An open asset or library.
#[derive(Debug)]
pub struct Source {
    path: PathBuf,
    bytes: Box<dyn Bytes>,
    len: u64,
    content: Content,
}

/// A file, or what a pipe gave.
trait Bytes: Read + Seek + Send + fmt::Debug {}

impl<T: Read + Seek + Send + fmt::Debug> Bytes for T {}

#[derive(Debug)]
enum Content {
    Asset,
    /// The bytes of the index, which parse.
    Library(Vec<u8>),
}

impl Source {
    /// Opens a file and tells by its first bytes what it is. Of a library, only the index
    /// is read. `-` is standard input; what comes from there or from a pipe is read to its end, and
    /// kept in memory.
    ///
    /// # Errors
    /// [`SourceError`] for a file that cannot be read or is of another kind, and for a
    /// damaged index.
    pub fn open(path: &Path) -> Result<Self, SourceError> {
        if path == Path::new(STANDARD_INPUT) {
            return Self::from_reader(path, io::stdin().lock());
        }
        let opened = input::open(path).map_err(|e| refused(path, e.into()))?;
        match opened {
            Opened::File(file) => Self::with(path, Box::new(file)),
            Opened::Pipe(pipe) => Self::from_reader(path, pipe),
        }
    }

    /// Reads an asset or a library to its end, such as from standard input, and keeps it in
    /// memory. `path` names it in errors.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub fn from_reader(path: &Path, reader: impl Read) -> Result<Self, SourceError> {
        let bytes = input::to_end(reader, Kind::Asset).map_err(|e| refused(path, e.into()))?;
        Self::with(path, Box::new(Cursor::new(bytes)))
    }

    fn with(path: &Path, bytes: Box<dyn Bytes>) -> Result<Self, SourceError> {
        Self::try_with(path, bytes).map_err(|problem| refused(path, problem))
    }

    fn try_with(path: &Path, mut bytes: Box<dyn Bytes>) -> Result<Self, SourceProblem> {
        let head = part(&mut *bytes, 0, library::HEADER_LEN as u64)?;
        let len = bytes
            .seek(SeekFrom::End(0))
            .map_err(InputProblem::Unreadable)?;
        let content = if head.starts_with(b"ASPL") {
            let index_len = library::index_len(&head)?;
            if index_len as u64 > len {
                return Err(FormatError::TooShort {
                    field: "library index",
                    needed: index_len as u64,
                    found: len,
                }
                .into());
            }
            let index = part(&mut *bytes, 0, index_len as u64)?;
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
            let head = part(&mut *bytes, 0, len.min(FORMAT_BYTES))?;
            return Err(match Format::of(&head) {
                Some(format) => SourceProblem::Input(InputProblem::OtherFormat {
                    format,
                    wanted: "an asset (.asp) or a library (.aspl)".into(),
                }),
                None => SourceProblem::WrongKind,
            });
        };
        Ok(Self {
            path: path.to_owned(),
            bytes,
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

    /// Bytes of the whole library; `None` for an asset. Every texture is checked.
    ///
    /// # Errors
    /// [`SourceError`] for a failed read, a library that is too large to be held in memory, and a
    /// damaged texture.
    pub fn library(&mut self) -> Result<Option<Vec<u8>>, SourceError> {
        let Some(names) = self.names() else {
            return Ok(None);
        };
        for (index, name) in names.iter().enumerate() {
            let bytes = self.texture(index)?;
            if let Err(error) = asperity_formats::Asset::parse(&bytes) {
                return Err(self.error(Some(name), error.into()));
            }
        }
        self.surfaces()?;
        self.read(0, self.len, None).map(Some)
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
        if len > Kind::Asset.max_bytes() {
            return Err(self.error(name, SourceProblem::TooLarge { bytes: len }));
        }
        part(&mut *self.bytes, offset, len).map_err(|problem| self.error(name, problem.into()))
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

fn refused(path: &Path, problem: SourceProblem) -> SourceError {
    SourceError {
        path: path.to_owned(),
        texture: None,
        problem,
    }
}

/// `len` bytes from `offset` on, or fewer where they end before.
fn part(bytes: &mut dyn Bytes, offset: u64, len: u64) -> Result<Vec<u8>, InputProblem> {
    let mut found = Vec::new();
    bytes
        .seek(SeekFrom::Start(offset))
        .and_then(|_| bytes.take(len).read_to_end(&mut found))
        .map_err(InputProblem::Unreadable)?;
    Ok(found)
}
