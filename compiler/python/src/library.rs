//! `asperity.Library` and `asperity.pack`.

use crate::{arguments::Choice, contents::Contents, error::Failure, records, texture::Texture};
use asperity::{
    inspect::SurfaceDocument,
    library::{self, NamedAsset},
    textures::{Textures, TexturesError, TexturesProblem},
};
use asperity_formats::{self as formats, FormatError};
use asperity_io::output;
use pyo3::{
    prelude::*,
    types::{PyIterator, PyList},
};
use std::{
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// Textures behind an index, in order of name.
///
/// Libraries come from `load` and `pack`. ``library[3]`` and ``library["polished marble"]`` read one texture;
/// of a file, the others are not read. Iteration gives every texture.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> library = asperity.pack([asperity.builtin(), asperity.compile("polished marble")])
/// >>> library.names
/// ['Built-in Grit', 'polished marble']
/// >>> library["polished marble"].name
/// 'polished marble'
#[pyclass(frozen, module = "asperity")]
pub(crate) struct Library {
    names: Vec<String>,
    place: Place,
}

/// Where the textures are.
enum Place {
    File(Mutex<Textures>),
    Memory(Vec<u8>),
}

impl Library {
    /// The library of a file, with its names.
    pub(crate) fn in_file(names: Vec<String>, textures: Textures) -> Self {
        Self {
            names,
            place: Place::File(Mutex::new(textures)),
        }
    }

    /// The library of these bytes.
    pub(crate) fn in_memory(bytes: Vec<u8>) -> Result<Self, TexturesError> {
        let names = match formats::Library::parse(&bytes) {
            Ok(library) => library
                .index()
                .entries()
                .map(|e| e.name.to_owned())
                .collect(),
            Err(error) => return Err(in_data(error)),
        };
        Ok(Self {
            names,
            place: Place::Memory(bytes),
        })
    }

    /// The texture that is meant.
    pub(crate) fn choose(&self, choice: &Choice) -> Result<Texture, Failure> {
        let index = self.index(choice)?;
        let name = self.names.get(index).map(String::as_str);
        let (bytes, path) = match &self.place {
            Place::File(textures) => {
                // A failed read leaves a file that can be read again.
                let mut textures = textures.lock().unwrap_or_else(PoisonError::into_inner);
                (textures.texture(index)?, textures.path().to_owned())
            }
            Place::Memory(bytes) => {
                let library = formats::Library::parse(bytes).map_err(in_data)?;
                let texture = library.bytes(index).map_err(in_data)?;
                (texture.to_vec(), Path::new("data").to_owned())
            }
        };
        Ok(Texture::new(Contents::new(bytes, &path, name)?, None))
    }

    fn index(&self, choice: &Choice) -> Result<usize, Failure> {
        let count = self.names.len();
        let (found, wanted) = match choice {
            Choice::Index(index) => {
                let from_end = index.checked_add_unsigned(count).unwrap_or(*index);
                let place = if *index < 0 { from_end } else { *index };
                let found = usize::try_from(place).ok().filter(|&place| place < count);
                (found, index.to_string())
            }
            Choice::Name(name) => {
                let found = self.names.iter().position(|other| other == name);
                (found, format!("{name:?}"))
            }
        };
        found.ok_or_else(|| {
            let message = format!("no texture {wanted} among {count}");
            Failure::no_such_texture(message, "take one of the library's names")
        })
    }
}

#[pymethods]
impl Library {
    /// Names of the textures, in order.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// Surfaces of the scene: dicts as ``asperity inspect --json`` prints them. Empty without
    /// a scene.
    #[getter]
    fn surfaces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let surfaces = match &self.place {
            Place::File(textures) => {
                let mut textures = textures.lock().unwrap_or_else(PoisonError::into_inner);
                textures.surfaces().map_err(Failure::from)?
            }
            Place::Memory(bytes) => {
                let library = formats::Library::parse(bytes)
                    .map_err(in_data)
                    .map_err(Failure::from)?;
                let scene = library.scene();
                scene.map_or_else(Vec::new, |scene| scene.surfaces().collect())
            }
        };
        let documents: Vec<SurfaceDocument> = surfaces
            .iter()
            .map(|surface| SurfaceDocument::of(surface, &self.names))
            .collect();
        records::value(py, &documents)
    }

    fn __len__(&self) -> usize {
        self.names.len()
    }

    fn __contains__(&self, name: &str) -> bool {
        self.names.iter().any(|other| other == name)
    }

    fn __getitem__(&self, py: Python<'_>, texture: Choice) -> Result<Texture, Failure> {
        py.detach(|| self.choose(&texture))
    }

    fn __iter__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyIterator>> {
        // `map(self.__getitem__, names)` reads a texture when its turn comes.
        let py = slf.py();
        let names = PyList::new(py, &slf.get().names)?;
        let get = slf.getattr("__getitem__")?;
        py.import("builtins")?
            .call_method1("map", (get, names))?
            .try_iter()
    }

    fn __repr__(&self) -> String {
        let first: Vec<&str> = self.names.iter().take(4).map(String::as_str).collect();
        let more = if self.names.len() > first.len() {
            ", …"
        } else {
            ""
        };
        format!(
            "<Library of {}: {}{more}>",
            self.names.len(),
            first.join(", ")
        )
    }
}

/// Packs textures into a library.
///
/// Parameters
/// ----------
/// textures : iterable of Texture
///     The textures, each with a name of its own.
/// path : str or os.PathLike, optional
///     The file (.aspl) to write, in full or not at all.
///
/// Returns
/// -------
/// Library
///
/// Raises
/// ------
/// AsperityError
///     For two textures of one name, or a file that cannot be written.
#[pyfunction]
#[pyo3(signature = (textures, path=None))]
pub(crate) fn pack(textures: &Bound<'_, PyAny>, path: Option<PathBuf>) -> PyResult<Library> {
    let mut held: Vec<Py<Texture>> = Vec::new();
    for texture in textures.try_iter()? {
        held.push(texture?.cast_into::<Texture>()?.unbind());
    }
    let packed = textures.py().detach(|| {
        let mut assets = Vec::with_capacity(held.len());
        for texture in &held {
            let contents = &texture.get().contents;
            let name = contents.asset()?.name();
            assets.push(NamedAsset {
                name,
                bytes: contents.bytes(),
            });
        }
        let bytes = library::encode(&assets)?;
        if let Some(path) = &path {
            output::write_atomic(path, &bytes)?;
        }
        Library::in_memory(bytes).map_err(Failure::from)
    })?;
    Ok(packed)
}

fn in_data(error: FormatError) -> TexturesError {
    TexturesError {
        path: Path::new("data").to_owned(),
        texture: None,
        problem: TexturesProblem::Format(error),
    }
}
