//! The textures that the studio was started with: a library, or a folder of assets.

use asperity::textures::Textures;
use asperity_io::{
    diagnostic::{Diagnostic, Failures, one},
    system,
};
use std::{
    io,
    path::{Path, PathBuf},
};
use thiserror::Error;

/// A library or a folder whose textures were all checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Collection {
    name: String,
    textures: usize,
    folder: Option<PathBuf>,
}

/// A path that is neither a library nor a folder of assets.
#[derive(Debug, Error)]
pub enum CollectionError {
    /// One asset.
    #[error("{path}: one asset, not a library", path = .0.display())]
    Asset(PathBuf),
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
            Self::Asset(_) => "give its folder, or start without it and open it on the page".into(),
            Self::Empty(_) => "give a folder of assets, or a library (.aspl)".into(),
            Self::Unreadable { source, .. } => system::remedy(source)
                .unwrap_or("give a folder that you may read")
                .into(),
        }
    }
}

impl Collection {
    /// Opens a library (.aspl), or a folder with assets (.asp), and checks every texture: checksums, structure,
    /// meaning.
    ///
    /// # Errors
    /// For a path that is neither, and for every texture of a folder, or the first of a library, that is damaged.
    pub fn open(path: &Path) -> Result<Self, Failures> {
        if path.is_dir() {
            return Self::folder_of(path);
        }
        let mut textures = Textures::open(path).map_err(one)?;
        if !textures.is_library() {
            return Err(one(CollectionError::Asset(path.to_owned())));
        }
        let checked = textures.each(|| (), |(), _, _| ()).map_err(one)?;
        Ok(Self {
            name: name(path),
            textures: checked.len(),
            folder: None,
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
        let check = |file: &PathBuf| Textures::open(file)?.choose(None).map(drop);
        let damaged: Failures = files
            .iter()
            .filter_map(|file| check(file).err())
            .map(|error| Box::new(error) as Box<dyn Diagnostic>)
            .collect();
        if !damaged.is_empty() {
            return Err(damaged);
        }
        Ok(Self {
            name: name(path),
            textures: files.len(),
            folder: Some(path.to_owned()),
        })
    }

    /// Its name: that of the file or the folder.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How many textures it has.
    #[must_use]
    pub fn textures(&self) -> usize {
        self.textures
    }

    /// The folder, if it is one.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }
}

/// The last part of a path, or all of it where that has no name, as `..`.
fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}
