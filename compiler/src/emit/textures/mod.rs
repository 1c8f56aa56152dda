//! Opens what other commands wrote: an asset, or one texture of a library.
//!
//! Of a library file, only the index and the chosen textures are read.
//!
//! ```
//! use asperity::{builtin, lower::lower, textures::Textures};
//! use std::path::Path;
//!
//! let bytes = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! let mut file = Textures::from_reader(Path::new("grit.asp"), &bytes[..])?;
//! assert!(!file.is_library());
//! assert_eq!(file.choose(None)?, bytes);
//! # Ok::<(), asperity::textures::TexturesError>(())
//! ```

mod error;
mod index;
#[cfg(test)]
pub(crate) mod tests;

pub use error::{TexturesError, TexturesProblem};
#[cfg(test)]
pub(crate) use index::ENTRIES_READ;

use asperity_formats::{Asset, FormatError, SceneSurface, library};
use asperity_io::input::{self, Format, InputProblem, Kind, Opened};
use asperity_io::shown::suggestion;
use index::{Index, Place};
use rayon::prelude::*;
use std::{
    fmt,
    io::{self, Cursor, Read, Seek, SeekFrom},
    ops::Range,
    path::{Path, PathBuf},
};

/// The path that means standard input.
const STANDARD_INPUT: &str = "-";

/// Textures that are in memory together where all are looked at, and their bytes.
const TOGETHER: usize = 4096;
const TOGETHER_BYTES: u64 = 16 << 20;
/// Leading bytes from which the format of another file is detected.
const FORMAT_BYTES: u64 = 1 << 20;

/// An open asset or library.
#[derive(Debug)]
pub struct Textures {
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
    Library(Index),
}

impl Textures {
    /// Opens a file and tells by its first bytes what it is. Of a library, only the index
    /// is read. `-` is standard input; what comes from there or from a pipe is read to its end, and
    /// kept in memory.
    ///
    /// # Errors
    /// [`TexturesError`] for a file that cannot be read or is of another kind, and for a
    /// damaged index.
    pub fn open(path: &Path) -> Result<Self, TexturesError> {
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
    /// As [`Textures::open`].
    pub fn from_reader(path: &Path, reader: impl Read) -> Result<Self, TexturesError> {
        let bytes = input::to_end(reader, Kind::Asset).map_err(|e| refused(path, e.into()))?;
        Self::with(path, Box::new(Cursor::new(bytes)))
    }

    /// The same of bytes that are in memory already, which are not copied.
    ///
    /// # Errors
    /// As [`Textures::open`].
    pub fn from_bytes(path: &Path, bytes: Vec<u8>) -> Result<Self, TexturesError> {
        input::admit(&bytes, Kind::Asset).map_err(|e| refused(path, e.into()))?;
        Self::with(path, Box::new(Cursor::new(bytes)))
    }

    fn with(path: &Path, bytes: Box<dyn Bytes>) -> Result<Self, TexturesError> {
        Self::try_with(path, bytes).map_err(|problem| refused(path, problem))
    }

    fn try_with(path: &Path, mut bytes: Box<dyn Bytes>) -> Result<Self, TexturesProblem> {
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
            let index = Index::parse(&index)?;
            let total = index.total_len;
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
                Some(format) => TexturesProblem::Input(InputProblem::OtherFormat {
                    format,
                    wanted: "an asset (.asp) or a library (.aspl)".into(),
                }),
                None => TexturesProblem::WrongKind,
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
        let index = self.index()?;
        Some(index.names().map(str::to_owned).collect())
    }

    fn index(&self) -> Option<&Index> {
        match &self.content {
            Content::Asset => None,
            Content::Library(index) => Some(index),
        }
    }

    /// Version of the format of a library; `None` for an asset.
    #[must_use]
    pub fn library_version(&self) -> Option<u16> {
        self.index().map(|index| index.version)
    }

    /// Whether it is a library rather than an asset.
    #[must_use]
    pub fn is_library(&self) -> bool {
        self.index().is_some()
    }

    /// Whether it is a library with a scene.
    #[must_use]
    pub fn has_scene(&self) -> bool {
        self.index().is_some_and(|index| index.scene.is_some())
    }

    /// Surfaces of a library's scene; none without a scene.
    ///
    /// # Errors
    /// [`TexturesError`] for a damaged scene.
    pub fn surfaces(&mut self) -> Result<Vec<SceneSurface>, TexturesError> {
        let Some((Some(range), textures)) = self.index().map(|i| (i.scene.clone(), i.len())) else {
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
    /// [`TexturesError`] for a failed read.
    pub fn scene_library(&mut self) -> Result<Option<Vec<u8>>, TexturesError> {
        let has_scene = self.has_scene();
        has_scene.then(|| self.read(0, self.len, None)).transpose()
    }

    /// Bytes of the one texture that `wanted` means, a name or an index of a library. An asset and a
    /// library of one texture need no `wanted`, but one that is given must fit.
    ///
    /// # Errors
    /// [`TexturesError`] for a texture that is not there, or none chosen of several.
    pub fn choose(&mut self, wanted: Option<&str>) -> Result<Vec<u8>, TexturesError> {
        let Some(index) = self.index() else {
            let bytes = self.read(0, self.len, None)?;
            let name = Asset::parse(&bytes)
                .map_err(|e| self.error(None, e.into()))?
                .name();
            return match wanted {
                Some(wanted) if wanted != name && wanted != "0" => {
                    Err(self.no_such_texture(wanted, 1))
                }
                _ => Ok(bytes),
            };
        };
        let chosen = self.position(index, wanted)?;
        self.texture(chosen)
    }

    /// The name in a library's index of the texture that `wanted` means, as
    /// [`choose`](Self::choose) takes it; `None` for an asset.
    ///
    /// # Errors
    /// As [`choose`](Self::choose).
    pub fn chosen_name(&self, wanted: Option<&str>) -> Result<Option<String>, TexturesError> {
        let Some(index) = self.index() else {
            return Ok(None);
        };
        let chosen = index.get(self.position(index, wanted)?);
        Ok(chosen.map(|place| place.name.clone()))
    }

    /// Bytes of the whole library; `None` for an asset. Every texture is checked.
    ///
    /// # Errors
    /// [`TexturesError`] for a failed read, a library that is too large to be held in memory, and a
    /// damaged texture.
    pub fn library(&mut self) -> Result<Option<Vec<u8>>, TexturesError> {
        let Some(names) = self.names() else {
            return Ok(None);
        };
        for (index, name) in names.iter().enumerate() {
            let bytes = self.texture(index)?;
            if let Err(error) = Asset::parse(&bytes) {
                return Err(self.error(Some(name), error.into()));
            }
        }
        self.surfaces()?;
        self.read(0, self.len, None).map(Some)
    }

    fn position(&self, index: &Index, wanted: Option<&str>) -> Result<usize, TexturesError> {
        let count = index.len();
        match wanted {
            None if count == 1 => Ok(0),
            None => Err(self.error(None, TexturesProblem::NoneChosen { count })),
            Some(wanted) => index
                .find(wanted)
                .or_else(|| wanted.parse().ok().filter(|&index: &usize| index < count))
                .ok_or_else(|| self.no_such_texture(wanted, count)),
        }
    }

    /// Bytes of a library's texture at `index`, unchecked. The others are not read.
    ///
    /// # Errors
    /// [`TexturesError`] for an index that is not there, or a failed read.
    pub fn texture(&mut self, index: usize) -> Result<Vec<u8>, TexturesError> {
        let place = match &self.content {
            Content::Asset => (index == 0).then_some((0, self.len, None)),
            Content::Library(library) => {
                let found = |place: &Place| (place.offset, place.len, Some(place.name.clone()));
                library.get(index).map(found)
            }
        };
        let Some((offset, len, name)) = place else {
            return Err(self.no_such_texture(&index.to_string(), index));
        };
        self.read(offset, len, name.as_deref())
    }

    /// What `each` finds in every texture, in order, under the name of a library's index or of the
    /// asset itself. Some at a time are in memory, and are looked at in parallel; `start` makes
    /// what one thread keeps between them. All of them are checked, and a scene, too.
    ///
    /// # Errors
    /// [`TexturesError`] for a failed read and for the first texture that is damaged.
    pub fn each<S: Send, R: Send>(
        &mut self,
        start: impl Fn() -> S + Sync,
        each: impl Fn(&mut S, &str, &Asset<'_>) -> R + Sync,
    ) -> Result<Vec<R>, TexturesError> {
        let Some(count) = self.index().map(Index::len) else {
            let bytes = self.read(0, self.len, None)?;
            let asset = Asset::parse(&bytes).map_err(|e| self.error(None, e.into()))?;
            return Ok(vec![each(&mut start(), asset.name(), &asset)]);
        };
        let mut all = Vec::with_capacity(count);
        while all.len() < count {
            let (some, bytes) = self.together(all.len())?;
            let places = self.index().map_or(&[][..], |index| index.places(some));
            let first = places.first().map_or(0, |place| place.offset);
            let found: Vec<Result<R, FormatError>> = places
                .par_iter()
                .with_min_len(16)
                .map_init(&start, |kept, place| {
                    let from = (place.offset - first) as usize;
                    let bytes = bytes.get(from..from + place.len as usize);
                    let asset = Asset::parse(bytes.unwrap_or_default())?;
                    Ok(each(kept, &place.name, &asset))
                })
                .collect();
            for (found, place) in found.into_iter().zip(places) {
                all.push(found.map_err(|e| self.error(Some(&place.name), e.into()))?);
            }
        }
        self.surfaces()?;
        Ok(all)
    }

    /// Neighbouring textures from one on, at least one, and their bytes: they follow each other.
    fn together(&mut self, from: usize) -> Result<(Range<usize>, Vec<u8>), TexturesError> {
        let (mut end, mut len, mut offset, mut name) = (from, 0, 0, None);
        while let Some(place) = self.index().and_then(|index| index.get(end)) {
            if end == from {
                (offset, name) = (place.offset, Some(place.name.clone()));
            } else if end - from == TOGETHER || len + place.len > TOGETHER_BYTES {
                break;
            }
            len += place.len;
            end += 1;
        }
        Ok((from..end, self.read(offset, len, name.as_deref())?))
    }

    fn read(
        &mut self,
        offset: u64,
        len: u64,
        name: Option<&str>,
    ) -> Result<Vec<u8>, TexturesError> {
        if len > Kind::Asset.max_bytes() {
            return Err(self.error(name, TexturesProblem::TooLarge { bytes: len }));
        }
        part(&mut *self.bytes, offset, len).map_err(|problem| self.error(name, problem.into()))
    }

    /// An error about this file, or one of its textures.
    #[must_use]
    pub fn error(&self, texture: Option<&str>, problem: TexturesProblem) -> TexturesError {
        TexturesError {
            path: self.path.clone(),
            texture: texture.map(str::to_owned),
            problem,
        }
    }

    fn no_such_texture(&self, wanted: &str, count: usize) -> TexturesError {
        let names = self.names().unwrap_or_default();
        let problem = TexturesProblem::NoSuchTexture {
            suggestion: suggestion(wanted, names.iter().map(String::as_str)),
            wanted: wanted.to_owned(),
            count,
        };
        self.error(None, problem)
    }
}

fn refused(path: &Path, problem: TexturesProblem) -> TexturesError {
    TexturesError {
        path: path.to_owned(),
        texture: None,
        problem,
    }
}

/// `len` bytes from `offset` on, or fewer where they end before.
fn part(bytes: &mut dyn Bytes, offset: u64, len: u64) -> Result<Vec<u8>, InputProblem> {
    // As much as there is to read: lengths were compared with that of the file.
    let mut found = Vec::with_capacity(usize::try_from(len).unwrap_or_default());
    bytes
        .seek(SeekFrom::Start(offset))
        .and_then(|_| bytes.take(len).read_to_end(&mut found))
        .map_err(InputProblem::Unreadable)?;
    Ok(found)
}
