//! Opens what other commands wrote: an asset, or one texture of a library.
//!
//! Of a library file, only the index and the chosen textures are read.
//!
//! ```
//! use asperity::{sources::builtin, emit::{lower::lower, textures::Textures}};
//! use std::path::Path;
//!
//! let bytes = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! let mut file = Textures::from_reader(Path::new("grit.asp"), &bytes[..])?;
//! assert!(!file.is_library());
//! assert_eq!(file.choose(None)?, bytes);
//! # Ok::<(), asperity::emit::textures::TexturesError>(())
//! ```

mod conversion;
mod error;
mod index;
#[cfg(test)]
pub(crate) mod tests;

pub use conversion::Conversion;
pub use error::{TexturesError, TexturesProblem};
#[cfg(test)]
pub(crate) use index::ENTRIES_READ;

use asperity_formats::{Asset, FormatError, SceneSurface, library};
use asperity_io::input::{self, Format, InputKind, InputProblem, Opened};
use asperity_io::shown::suggestion;
use index::Index;
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
const TOGETHER: usize = 512;
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
        let bytes = input::to_end(reader, InputKind::Asset).map_err(|e| refused(path, e.into()))?;
        Self::with(path, Box::new(Cursor::new(bytes)))
    }

    /// The same of bytes that are in memory already, which are not copied.
    ///
    /// # Errors
    /// As [`Textures::open`].
    pub fn from_bytes(path: &Path, bytes: Vec<u8>) -> Result<Self, TexturesError> {
        input::admit(&bytes, InputKind::Asset).map_err(|e| refused(path, e.into()))?;
        Self::with(path, Box::new(Cursor::new(bytes)))
    }

    fn with(path: &Path, bytes: Box<dyn Bytes>) -> Result<Self, TexturesError> {
        let mut bytes = bytes;
        match Self::content(&mut *bytes) {
            Ok((content, len)) => Ok(Self {
                path: path.to_owned(),
                bytes,
                len,
                content,
            }),
            Err(problem) => Err(refused(path, explained(problem, &mut *bytes))),
        }
    }

    /// Reads the type and the length of a file.
    fn content(bytes: &mut dyn Bytes) -> Result<(Content, u64), TexturesProblem> {
        let head = part(bytes, 0, library::HEADER_LEN as u64)?;
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
            let index = part(bytes, 0, index_len as u64)?;
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
            let head = part(bytes, 0, len.min(FORMAT_BYTES))?;
            if head.is_empty() {
                return Err(InputProblem::Empty.into());
            }
            return Err(match Format::of(&head) {
                Some(format) => TexturesProblem::Input(InputProblem::OtherFormat {
                    format,
                    wanted: "an asset (.asp) or a library (.aspl)".into(),
                }),
                None => TexturesProblem::WrongKind,
            });
        };
        Ok((content, len))
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

    /// Returns true if it is a library rather than an asset.
    #[must_use]
    pub fn is_library(&self) -> bool {
        self.index().is_some()
    }

    /// Returns true if it is a library with a scene.
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
            let parsed = Asset::parse(&bytes);
            let name = parsed.map_err(|e| self.unparsed(e))?.name();
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

    /// Bytes of a library's texture at `index`; only their haptic length is compared with the index. The others are not
    /// read.
    ///
    /// # Errors
    /// [`TexturesError`] for an index that is not there, a failed read, or another haptic length.
    pub fn texture(&mut self, index: usize) -> Result<Vec<u8>, TexturesError> {
        let place = match &self.content {
            Content::Asset if index == 0 => return self.read(0, self.len, None),
            Content::Asset => None,
            Content::Library(library) => library.get(index).cloned(),
        };
        let Some(place) = place else {
            return Err(self.no_such_texture(&index.to_string(), index));
        };
        let bytes = self.read(place.offset, place.len, Some(&place.name))?;
        let checked = place.check(index, &bytes);
        checked.map_err(|e| self.error(Some(&place.name), e.into()))?;
        Ok(bytes)
    }

    /// Returns the results of `each` for every texture, in order, under the name of a library's index or of the asset
    /// itself. All of them are checked, and a scene, too.
    ///
    /// # Errors
    /// [`TexturesError`] for a failed read and for the first texture that is damaged.
    pub fn each<S: Send, R: Send>(
        &mut self,
        start: impl Fn() -> S + Sync,
        each: impl Fn(&mut S, &str, &Asset<'_>) -> R + Sync,
    ) -> Result<Vec<R>, TexturesError> {
        let count = self.index().map_or(1, Index::len);
        let mut all = Vec::with_capacity(count);
        while all.len() < count {
            all.extend(self.each_from(all.len(), &start, &each)?);
        }
        self.surfaces()?;
        Ok(all)
    }

    /// Returns the results of `each` for the textures from `from` on: at least one, and as many as are in memory
    /// together. They are processed in parallel; `start` creates the state that a thread keeps between them.
    ///
    /// # Errors
    /// As [`each`](Self::each).
    pub fn each_from<S: Send, R: Send>(
        &mut self,
        from: usize,
        start: impl Fn() -> S + Sync,
        each: impl Fn(&mut S, &str, &Asset<'_>) -> R + Sync,
    ) -> Result<Vec<R>, TexturesError> {
        if !self.is_library() {
            let bytes = self.read(0, self.len, None)?;
            let asset = Asset::parse(&bytes).map_err(|e| self.unparsed(e))?;
            return Ok(vec![each(&mut start(), asset.name(), &asset)]);
        }
        let (some, bytes) = self.together(from)?;
        let locations = self.index().map_or(&[][..], |index| index.locations(some));
        let first = locations.first().map_or(0, |location| location.offset);
        let found: Vec<Result<R, FormatError>> = locations
            .par_iter()
            .enumerate()
            .with_min_len(16)
            .map_init(&start, |kept, (n, place)| {
                let at = (place.offset - first) as usize;
                let bytes = bytes.get(at..at + place.len as usize).unwrap_or_default();
                place.check(from + n, bytes)?;
                Ok(each(kept, &place.name, &Asset::parse(bytes)?))
            })
            .collect();
        let named = found.into_iter().zip(locations);
        named
            .map(|(found, place)| found.map_err(|e| self.error(Some(&place.name), e.into())))
            .collect()
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
        if len > InputKind::Asset.max_bytes() {
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

    /// An error about an asset that does not parse.
    fn unparsed(&mut self, error: FormatError) -> TexturesError {
        let problem = explained(error.into(), &mut *self.bytes);
        self.error(None, problem)
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

/// The problem of a file, or what was done to its bytes where that is the cause.
fn explained(problem: TexturesProblem, bytes: &mut dyn Bytes) -> TexturesProblem {
    let is_damage = match &problem {
        TexturesProblem::Format(error) => !matches!(error, FormatError::Version { .. }),
        problem => matches!(problem, TexturesProblem::WrongKind),
    };
    let head = if is_damage {
        part(bytes, 0, FORMAT_BYTES).unwrap_or_default()
    } else {
        Vec::new()
    };
    Conversion::of(&head).map_or(problem, TexturesProblem::Converted)
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
