//! Textures that belong together: a library, or a folder of assets. Of one on a disk, textures are read when they are
//! asked for.

use crate::{
    error::{ApiError, refused},
    http::Status,
    recipe::{Opened, Operation},
    row::{TextureSummary, columns},
    texture::{Making, Texture, damaged},
    thumbnails::Thumbnails,
};
use asperity::{
    emit::{
        lower::LowerError,
        sections::renamed,
        textures::{Textures, TexturesError},
    },
    model::attributes::Meter,
};
use asperity_formats::Asset;
use asperity_io::{
    diagnostic::{Diagnostic, Failures, one},
    shown::counted,
    system,
};
use rayon::prelude::*;
use std::{
    io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, OnceLock, PoisonError},
};
use thiserror::Error;

/// A library or a folder whose textures were all checked.
#[derive(Debug)]
pub struct Collection {
    name: String,
    /// Identifier that distinguishes it from others of its name.
    id: String,
    storage: Storage,
    /// Where it lies is of no interest to those who see it.
    elsewhere: bool,
    /// The list that it was compiled from here.
    listed: Option<Opened>,
    rows: Vec<TextureSummary>,
    columns: OnceLock<Arc<[u8]>>,
    thumbnails: Thumbnails,
}

/// Where the textures are.
#[derive(Debug)]
enum Storage {
    Library(Mutex<Textures>),
    Folder { path: PathBuf, files: Vec<PathBuf> },
}

/// A folder that has no textures.
#[derive(Debug, Error)]
pub enum CollectionError {
    /// A folder without assets.
    #[error("{path}: no asset (.asp) in this folder", path = .0.display())]
    Empty(PathBuf),
    /// A folder that cannot be listed.
    #[error("{path}: cannot list the folder", path = path.display())]
    Unreadable {
        /// The folder.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
}

impl Diagnostic for CollectionError {
    fn remedy(&self) -> String {
        match self {
            Self::Empty(_) => "give a folder of assets, or a library (.aspl)".into(),
            Self::Unreadable { source, .. } => system::remedy(source)
                .unwrap_or("give a folder that you may read")
                .into(),
        }
    }
}

impl Collection {
    /// Opens a library (.aspl), an asset (.asp), or a folder with assets, and checks every texture: checksums, structure,
    /// meaning. What the page shows of all of them is found in the same pass.
    ///
    /// # Errors
    /// For a path that is none of these, and for every texture of a folder, or the first of a library, that is damaged.
    pub fn open(path: &Path) -> Result<Self, Failures> {
        if path.is_dir() {
            return Self::folder_of(path);
        }
        let textures = Textures::open(path).map_err(one)?;
        if !textures.is_library() {
            let folder = path.parent().unwrap_or(path).to_owned();
            return Self::of_files(path, folder, vec![path.to_owned()]);
        }
        Self::library(textures, String::new()).map_err(one)
    }

    /// A library that is in memory; the path of its textures is the name of its file. `id` tells it from others of that
    /// name.
    ///
    /// # Errors
    /// For the first texture that is damaged.
    pub(crate) fn dropped(textures: Textures, id: String) -> Result<Self, ApiError> {
        Self::library(textures, id).map_err(|e| refused(&e))
    }

    /// A library that was compiled from a list.
    ///
    /// # Errors
    /// As [`dropped`](Self::dropped).
    pub(crate) fn built(textures: Textures, listed: Opened) -> Result<Self, ApiError> {
        let built = Self::dropped(textures, listed.id.clone())?;
        Ok(Self {
            listed: Some(listed),
            ..built
        })
    }

    fn library(mut textures: Textures, id: String) -> Result<Self, TexturesError> {
        let rows = textures.each(Meter::default, TextureSummary::of)?;
        Ok(Self {
            name: name(textures.path()),
            id,
            storage: Storage::Library(Mutex::new(textures)),
            elsewhere: false,
            listed: None,
            rows,
            columns: OnceLock::new(),
            thumbnails: Thumbnails::default(),
        })
    }

    fn folder_of(path: &Path) -> Result<Self, Failures> {
        let unreadable = |source| {
            one(CollectionError::Unreadable {
                path: path.to_owned(),
                source,
            })
        };
        let entries = path.read_dir().map_err(unreadable)?;
        let mut files = Vec::new();
        for entry in entries {
            let file = entry.map_err(unreadable)?.path();
            if file.extension().is_some_and(|ending| ending == "asp") {
                files.push(file);
            }
        }
        files.sort();
        if files.is_empty() {
            return Err(one(CollectionError::Empty(path.to_owned())));
        }
        Self::of_files(path, path.to_owned(), files)
    }

    /// Assets of a folder; the path names all of them.
    fn of_files(named: &Path, path: PathBuf, files: Vec<PathBuf>) -> Result<Self, Failures> {
        let row = |meter: &mut Meter, file: &PathBuf| {
            let bytes = asset_of(file)?;
            let parsed = Asset::parse(&bytes);
            let asset = parsed.map_err(|e| TexturesError {
                path: file.clone(),
                texture: None,
                problem: e.into(),
            })?;
            Ok(TextureSummary::of(meter, asset.name(), &asset))
        };
        let checked: Vec<Result<TextureSummary, TexturesError>> =
            files.par_iter().map_init(Meter::default, row).collect();
        let mut damaged = Failures::new();
        let mut rows = Vec::with_capacity(files.len());
        for row in checked {
            match row {
                Ok(row) => rows.push(row),
                Err(error) => damaged.push(Box::new(error)),
            }
        }
        if !damaged.is_empty() {
            return Err(damaged);
        }
        Ok(Self {
            name: name(named),
            id: String::new(),
            storage: Storage::Folder { path, files },
            elsewhere: false,
            listed: None,
            rows,
            columns: OnceLock::new(),
            thumbnails: Thumbnails::default(),
        })
    }

    /// Its name: that of the file or the folder.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the number of textures.
    #[must_use]
    pub fn textures(&self) -> usize {
        self.rows.len()
    }

    /// The same for people on other machines, to whom commands name files without their folders.
    pub(crate) fn elsewhere(self) -> Self {
        Self {
            elsewhere: true,
            ..self
        }
    }

    /// The folder, if it is one that people can reach.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        match &self.storage {
            Storage::Folder { path, .. } if !self.elsewhere => Some(path),
            _ => None,
        }
    }

    /// Returns the gallery's columns of all its textures, JSON.
    pub(crate) fn columns(&self, id: &str) -> Arc<[u8]> {
        let written = self
            .columns
            .get_or_init(|| columns(id, &self.name, &self.rows, None).into());
        Arc::clone(written)
    }

    /// The same with what names each texture, `ids`.
    pub(crate) fn columns_with(&self, id: &str, ids: &[String]) -> Vec<u8> {
        columns(id, &self.name, &self.rows, Some(ids))
    }

    /// The names of its textures, in their order.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().map(|row| row.name.as_str())
    }

    /// The bytes of the texture at a place.
    ///
    /// # Errors
    /// Where there is none, and as a command that opens it.
    pub(crate) fn asset(&self, at: usize) -> Result<Vec<u8>, ApiError> {
        if at >= self.rows.len() {
            let count = counted(self.rows.len(), "texture", "textures");
            let error = format!("{}: no texture {at}; it has {count}", self.name);
            let help = "ask for one from 0 on";
            return Err(ApiError::new(Status::NotFound, error, help));
        }
        let read = match &self.storage {
            Storage::Library(textures) => {
                let mut textures = textures.lock().unwrap_or_else(PoisonError::into_inner);
                textures.texture(at)
            }
            Storage::Folder { files, .. } => asset_of(&files[at]),
        };
        read.map_err(|e| refused(&e))
    }

    /// The texture at a place, as `asperity extract` writes it.
    ///
    /// # Errors
    /// As [`asset`](Self::asset).
    pub(crate) fn texture(&self, at: usize) -> Result<Texture, ApiError> {
        let mut bytes = self.asset(at)?;
        let TextureSummary { name, .. } = &self.rows[at];
        if Asset::parse(&bytes).map_err(damaged)?.name() != name {
            // The name in the index counts.
            bytes = renamed(&bytes, name).map_err(|e| refused(&LowerError::from(e)))?;
        }
        let shown = |path: &Path| {
            if self.elsewhere {
                self::name(path)
            } else {
                path.to_string_lossy().into_owned()
            }
        };
        let operation = |id: &str| match (&self.listed, &self.storage) {
            (Some(list), _) => Operation::Build {
                list: list.clone(),
                texture: name.clone(),
            },
            (None, Storage::Library(textures)) => {
                let textures = textures.lock().unwrap_or_else(PoisonError::into_inner);
                let library = Opened {
                    path: shown(textures.path()),
                    id: self.id.clone(),
                };
                let texture = name.clone();
                Operation::Extract { library, texture }
            }
            (None, Storage::Folder { files, .. }) => Operation::File(Opened {
                path: shown(&files[at]),
                id: id.to_owned(),
            }),
        };
        Texture::new(bytes, Making::default(), operation).map_err(damaged)
    }

    /// The picture of the texture at a place, PNG.
    ///
    /// # Errors
    /// As [`asset`](Self::asset), and where it cannot be drawn.
    pub(crate) fn thumbnail(&self, at: usize) -> Result<Arc<[u8]>, ApiError> {
        self.thumbnails.get(at, || self.asset(at))
    }
}

/// The bytes of the one texture of a file.
fn asset_of(file: &Path) -> Result<Vec<u8>, TexturesError> {
    Textures::open(file)?.choose(None)
}

/// The last part of a path, or all of it where that has no name, as `..`.
fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}
