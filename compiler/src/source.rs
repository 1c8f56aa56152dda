//! Opening what other commands wrote: an asset, or one texture of a library.

use crate::diagnostic::Diagnostic;
use asperity_formats::{
    FormatError, SceneSurface,
    library::{self, LibraryIndex},
};
use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};
use thiserror::Error;

/// Largest single asset read, bytes: far above any texture with its preview.
const MAX_ASSET_BYTES: u64 = 256 * 1024 * 1024;

/// Why a file cannot be used as a texture.
#[derive(Debug, Error)]
#[error("{path}{texture}: {problem}", path = path.display(), texture = Named(texture.as_deref()))]
pub struct SourceError {
    /// The file.
    pub path: PathBuf,
    /// The texture of the library at fault, where it is one.
    pub texture: Option<String>,
    /// What is wrong.
    pub problem: SourceProblem,
}

struct Named<'a>(Option<&'a str>);

impl std::fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0
            .map_or(Ok(()), |name| write!(f, ": texture {name:?}"))
    }
}

/// What is wrong with the file.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SourceProblem {
    /// It cannot be read.
    #[error("cannot read it: {0}")]
    Unreadable(#[from] io::Error),
    /// Its bytes are not valid.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// It is neither an asset nor a library.
    #[error("neither an asset (.asp) nor a library (.aspl)")]
    WrongKind,
    /// It is larger than any asset.
    #[error("{bytes} bytes, an asset has {MAX_ASSET_BYTES} at most")]
    TooLarge {
        /// Its size.
        bytes: u64,
    },
    /// The library holds several textures and none was chosen.
    #[error("a library of {count} textures, and none was chosen")]
    NoneChosen {
        /// Textures it holds.
        count: usize,
    },
    /// The library has no such texture.
    #[error("no texture {wanted:?} among {count}")]
    NoSuchTexture {
        /// What was asked for.
        wanted: String,
        /// Textures it holds.
        count: usize,
    },
}

impl Diagnostic for SourceError {
    fn is_usage(&self) -> bool {
        matches!(self.problem, SourceProblem::NoneChosen { .. })
    }

    fn remedy(&self) -> String {
        match &self.problem {
            SourceProblem::Unreadable(_) => "check the path and its permissions".into(),
            SourceProblem::Format(FormatError::Version { .. }) => {
                "update asperity, or make the file again with this version".into()
            }
            SourceProblem::Format(_) => "make the file again from its source".into(),
            SourceProblem::WrongKind | SourceProblem::TooLarge { .. } => {
                "give a file that `asperity import` or `asperity builtin` wrote".into()
            }
            SourceProblem::NoneChosen { .. } => "choose one with --texture NAME or INDEX".into(),
            SourceProblem::NoSuchTexture { .. } => format!(
                "list the names with `asperity inspect {:?}`",
                self.path.display()
            ),
        }
    }
}

/// An open asset or library.
#[derive(Debug)]
pub struct Source {
    path: PathBuf,
    file: File,
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
    /// is read.
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
        let mut file = File::open(path)?;
        let mut head = Vec::new();
        (&mut file)
            .take(library::HEADER_LEN as u64)
            .read_to_end(&mut head)?;
        let len = file.metadata()?.len();
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

    /// Bytes of the one texture meant by `wanted`, a name or an index of a library. Not
    /// needed for an asset or a library of one; then given, it must still fit.
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
        let count = names.len();
        let index = match wanted {
            None if count == 1 => 0,
            None => return Err(self.error(None, SourceProblem::NoneChosen { count })),
            Some(wanted) => names
                .iter()
                .position(|name| name == wanted)
                .or_else(|| wanted.parse().ok().filter(|&index: &usize| index < count))
                .ok_or_else(|| self.no_such_texture(wanted, count))?,
        };
        self.texture(index)
    }

    /// Bytes of a library's texture at `index`, unchecked; the others are not read.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        builtin,
        library::{NamedAsset, encode},
        lower::lower,
    };
    use asperity_formats::Asset;
    use std::fs;

    fn problem(error: SourceError) -> SourceProblem {
        error.problem
    }

    #[test]
    fn a_texture_of_a_library_is_found_by_name_and_by_index() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.aspl");
        let bytes = ["b", "a"].map(|name| {
            let mut texture = builtin::texture();
            texture.name = name.into();
            lower(&texture, None).unwrap().bytes
        });
        let assets: Vec<NamedAsset<'_>> = ["b", "a"]
            .into_iter()
            .zip(&bytes)
            .map(|(name, bytes)| NamedAsset { name, bytes })
            .collect();
        fs::write(&path, encode(&assets).unwrap()).unwrap();
        let mut source = Source::open(&path).unwrap();
        assert_eq!(source.names().unwrap(), ["a", "b"]);
        for (wanted, name) in [("a", "a"), ("b", "b"), ("0", "a"), ("1", "b")] {
            let chosen = source.choose(Some(wanted)).unwrap();
            assert_eq!(Asset::parse(&chosen).unwrap().name(), name);
        }
        let missing = problem(source.choose(Some("2")).unwrap_err());
        assert!(matches!(
            missing,
            SourceProblem::NoSuchTexture { count: 2, .. }
        ));
        let none = source.choose(None).unwrap_err();
        assert!(none.is_usage());
    }

    #[test]
    fn other_and_damaged_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let asset = lower(&builtin::texture(), None).unwrap().bytes;
        let library = encode(&[NamedAsset {
            name: "a",
            bytes: &asset,
        }])
        .unwrap();
        let open = |bytes: &[u8]| {
            fs::write(&path, bytes).unwrap();
            let mut source = Source::open(&path).map_err(problem)?;
            source.choose(None).map_err(problem)
        };
        assert!(open(&asset).is_ok() && open(&library).is_ok());
        for bytes in [b"".as_slice(), b"ASP", b"<?xml version"] {
            assert!(matches!(open(bytes), Err(SourceProblem::WrongKind)));
        }
        for len in [4, 20, 27, 40, 100, library.len() - 1] {
            assert!(matches!(
                open(&library[..len]),
                Err(SourceProblem::Format(_))
            ));
        }
        for len in [4, 20, 100, asset.len() - 1] {
            assert!(matches!(open(&asset[..len]), Err(SourceProblem::Format(_))));
        }
        assert!(matches!(
            problem(Source::open(folder.path()).unwrap_err()),
            SourceProblem::Unreadable(_)
        ));
    }
}
