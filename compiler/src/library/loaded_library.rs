//! All textures of a library in memory.

use crate::{
    emit::{
        lower::LowerError,
        pack::{NamedAsset, encode},
        sections::renamed,
        textures::{Textures, TexturesError},
    },
    name::check_name,
};
use asperity_formats::Asset;
use asperity_io::diagnostic::{Failure, Failures, Fault, one};
use std::path::Path;

/// All textures of a library, or the one of an asset, in order of name. Each is checked.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedLibrary {
    /// The file as a report calls it.
    pub shown: String,
    /// Names with the bytes of their assets.
    pub textures: Vec<(String, Vec<u8>)>,
    /// True if the file is a library rather than an asset.
    pub is_library: bool,
    /// True if it has a scene.
    pub has_scene: bool,
}

impl LoadedLibrary {
    /// Reads a library or an asset; `-` is standard input.
    ///
    /// # Errors
    /// [`TexturesError`] for a file that cannot be used.
    pub fn open(file: &Path) -> Result<Self, TexturesError> {
        let mut file = Textures::open(file)?;
        let shown = file.shown();
        let Some(names) = file.names() else {
            let bytes = file.choose(None)?;
            let parsed = Asset::parse(&bytes).map(|asset| asset.name().to_owned());
            let name = parsed.map_err(|e| file.error(None, e.into()))?;
            return Ok(Self {
                shown,
                textures: vec![(name, bytes)],
                is_library: false,
                has_scene: false,
            });
        };
        let mut textures = Vec::with_capacity(names.len());
        for (index, name) in names.into_iter().enumerate() {
            let bytes = file.texture(index)?;
            if let Err(error) = Asset::parse(&bytes) {
                return Err(file.error(Some(&name), error.into()));
            }
            textures.push((name, bytes));
        }
        Ok(Self {
            shown,
            textures,
            is_library: true,
            has_scene: !file.surfaces()?.is_empty(),
        })
    }

    /// Reads a library without a scene, to write another one of its textures.
    ///
    /// # Errors
    /// As [`open`](Self::open), and [`Fault`] for an asset or a scene.
    pub fn library(file: &Path) -> Result<Self, Failures> {
        let shelf = Self::open(file).map_err(one)?;
        if !shelf.is_library {
            let fault = Fault::new("an asset, not a library", "give a library (.aspl)");
            return Err(one(fault.at(shelf.shown)));
        }
        shelf.refuse_scene().map_err(one)?;
        Ok(shelf)
    }

    /// Refuses a library with a scene.
    ///
    /// # Errors
    /// [`Fault`] with the file.
    pub fn refuse_scene(&self) -> Result<(), Fault> {
        if !self.has_scene {
            return Ok(());
        }
        let what = "a library with a scene cannot be changed";
        let remedy = "change its manifest, and build it again with `asperity build`";
        Err(Fault::new(what, remedy).at(&self.shown))
    }

    /// Gives a texture another name, in the index and in its asset, and returns the one that it had.
    ///
    /// # Errors
    /// [`Fault`] for a name that no texture can have or that another one has, and for a scene.
    pub fn rename(&mut self, index: usize, name: &str) -> Result<String, Failure> {
        check_name(name)?;
        self.refuse_scene()?;
        let mut others = self.textures.iter().enumerate();
        if others.any(|(other, (taken, _))| other != index && taken == name) {
            let what = format!("there is already a texture {name:?}");
            return Err(Fault::new(what, "choose another name")
                .at(&self.shown)
                .into());
        }
        let bytes = renamed(&self.textures[index].1, name).map_err(LowerError::from)?;
        let before = std::mem::replace(&mut self.textures[index], (name.to_owned(), bytes));
        Ok(before.0)
    }

    /// The bytes of a file with these textures: a library, or the one asset.
    ///
    /// # Errors
    /// [`Fault`] for an asset that does not parse.
    pub fn encode(&self) -> Result<Vec<u8>, Fault> {
        if let ([(_, bytes)], false) = (&self.textures[..], self.is_library) {
            return Ok(bytes.clone());
        }
        let named: Vec<NamedAsset<'_>> = self
            .textures
            .iter()
            .map(|(name, bytes)| NamedAsset { name, bytes })
            .collect();
        encode(&named)
    }

    /// The texture that `wanted` means: a name, or an index from 0.
    #[must_use]
    pub fn position(&self, wanted: &str) -> Option<usize> {
        let named = self.textures.iter().position(|(name, _)| name == wanted);
        named.or_else(|| {
            wanted
                .parse()
                .ok()
                .filter(|&n: &usize| n < self.textures.len())
        })
    }
}
