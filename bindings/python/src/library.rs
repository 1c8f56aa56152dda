//! `asperity.Library` and `asperity.pack`.

use crate::{
    arguments::{Choice, within},
    contents::{Contents, Texture},
    error::{Failure, stopped},
    records,
};
use asperity::{
    emit::{
        lower::LowerError,
        pack::{NamedAsset, encode},
        sections::renamed,
        textures::{Textures, TexturesError, TexturesProblem},
    },
    library::{self, LoadedLibrary},
};
use asperity_formats::{self as formats, FormatError, SceneSurface};
use asperity_io::output;
use pyo3::{
    prelude::*,
    types::{PyBytes, PyIterator, PyList},
};
use serde_json::Value;
use std::{
    borrow::Cow,
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
};

/// Textures behind an index, in order of name.
///
/// Libraries come from `build`, `load`, `pack` and `merge`. ``library[3]`` and ``library["polished marble"]`` read one texture;
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
#[pyclass(frozen, subclass, module = "asperity")]
pub(crate) struct Library {
    names: Vec<String>,
    storage: Storage,
    /// JSON: what its build reported.
    report: Option<String>,
}

/// Where the textures are.
enum Storage {
    File(Mutex<Textures>),
    Memory(Vec<u8>),
}

impl Library {
    /// The library of a file, with its names.
    pub(crate) fn in_file(names: Vec<String>, textures: Textures) -> Self {
        Self {
            names,
            storage: Storage::File(Mutex::new(textures)),
            report: None,
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
            storage: Storage::Memory(bytes),
            report: None,
        })
    }

    /// The texture that is meant.
    pub(crate) fn choose(&self, choice: &Choice) -> Result<Texture, Failure> {
        let index = self.index(choice)?;
        let name = self.names.get(index).map(String::as_str);
        let (bytes, path) = match &self.storage {
            Storage::File(textures) => {
                let mut textures = held(textures);
                (textures.texture(index)?, textures.path().to_owned())
            }
            Storage::Memory(bytes) => {
                let library = formats::Library::parse(bytes).map_err(in_data)?;
                let texture = library.bytes(index).map_err(in_data)?;
                (texture.to_vec(), Path::new("data").to_owned())
            }
        };
        Ok(Texture::new(Contents::new(bytes, &path, name)?, None))
    }

    /// The surfaces of its scene; none without a scene.
    pub(crate) fn surfaces(&self) -> Result<Vec<SceneSurface>, Failure> {
        Ok(match &self.storage {
            Storage::File(textures) => held(textures).surfaces()?,
            Storage::Memory(bytes) => {
                let library = formats::Library::parse(bytes).map_err(in_data)?;
                let scene = library.scene();
                scene.map_or_else(Vec::new, |scene| scene.surfaces().collect())
            }
        })
    }

    /// The bytes of the whole library.
    pub(crate) fn bytes(&self) -> Result<Cow<'_, [u8]>, Failure> {
        Ok(match &self.storage {
            Storage::File(textures) => Cow::Owned(held(textures).library()?.unwrap_or_default()),
            Storage::Memory(bytes) => Cow::Borrowed(bytes),
        })
    }

    /// The library with the report of its build.
    pub(crate) fn reporting(self, report: &Value) -> Self {
        Self {
            report: Some(report.to_string()),
            ..self
        }
    }

    /// The name of its file without the ending.
    pub(crate) fn name(&self) -> String {
        match &self.storage {
            Storage::File(textures) => {
                let textures = held(textures);
                let stem = textures.path().file_stem().unwrap_or_default();
                stem.to_string_lossy().into_owned()
            }
            Storage::Memory(_) => "library".to_owned(),
        }
    }

    /// All its textures, checked. `shown` names it in errors.
    pub(crate) fn loaded(&self, shown: String) -> Result<LoadedLibrary, Failure> {
        let textures = self.names.iter().enumerate().map(|(index, name)| {
            let texture = self.choose(&Choice::Index(index as isize))?;
            Ok((name.clone(), texture.contents.bytes().to_vec()))
        });
        Ok(LoadedLibrary {
            shown,
            textures: textures.collect::<Result<_, Failure>>()?,
            is_library: true,
            has_scene: self.has_scene()?,
        })
    }

    /// Names of the textures, in order.
    pub(crate) fn listed(&self) -> &[String] {
        &self.names
    }

    /// Returns true if it has surfaces.
    pub(crate) fn has_scene(&self) -> Result<bool, Failure> {
        Ok(match &self.storage {
            Storage::File(textures) => held(textures).has_scene(),
            Storage::Memory(_) => !self.surfaces()?.is_empty(),
        })
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

    /// Report of the build, or None for a library that was loaded or packed.
    ///
    /// It is what ``asperity build --json`` prints, without the path.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let report = self.report.as_deref();
        report.map(|json| records::parsed(py, json)).transpose()
    }

    /// A texture under the name that the library gives it, as ``asperity extract`` writes it.
    ///
    /// Parameters
    /// ----------
    /// texture : str or int
    ///     Its name or index.
    ///
    /// Returns
    /// -------
    /// Texture
    ///
    /// Raises
    /// ------
    /// NoSuchTextureError
    ///     Where there is none.
    fn extract(&self, py: Python<'_>, texture: Choice) -> Result<Texture, Failure> {
        py.detach(|| {
            let name = &self.names[self.index(&texture)?];
            let found = self.choose(&texture)?;
            if found.contents.asset()?.name() == name {
                return Ok(found);
            }
            let bytes = renamed(found.contents.bytes(), name).map_err(LowerError::from)?;
            Texture::made(bytes, None)
        })
    }

    /// The library with one texture under another name.
    ///
    /// Parameters
    /// ----------
    /// texture : str or int
    ///     The texture, by name or index.
    /// name : str
    ///     Its new name: 1 to 64 bytes, no control characters.
    ///
    /// Returns
    /// -------
    /// Library
    ///
    /// Raises
    /// ------
    /// NoSuchTextureError
    ///     Where there is no such texture.
    /// AsperityError
    ///     For a name that another texture has, or none can have, and for a scene.
    fn rename(&self, py: Python<'_>, texture: Choice, name: &str) -> Result<Self, Failure> {
        py.detach(|| {
            let index = self.index(&texture)?;
            let mut loaded = self.loaded("library".into())?;
            loaded.rename(index, name).map_err(stopped)?;
            Ok(Self::in_memory(loaded.encode()?)?)
        })
    }

    /// Smaller libraries of neighbouring textures, each as large as the others within one texture.
    ///
    /// Parameters
    /// ----------
    /// into : int
    ///     Their number, 1 to 9999.
    ///
    /// Returns
    /// -------
    /// list of Library
    ///
    /// Raises
    /// ------
    /// AsperityError
    ///     For a scene.
    fn split(&self, py: Python<'_>, into: usize) -> Result<Vec<Self>, Failure> {
        let into = within("into", into, &(1..=9999))?;
        py.detach(|| {
            let loaded = self.loaded("library".into())?;
            loaded.refuse_scene()?;
            let parts = library::split(&loaded, into)?.into_iter();
            parts.map(|bytes| Ok(Self::in_memory(bytes)?)).collect()
        })
    }

    /// The bytes of the library, as a file holds them.
    ///
    /// Returns
    /// -------
    /// bytes
    fn to_bytes<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyBytes>, Failure> {
        let bytes = py.detach(|| self.bytes())?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Writes the library, in full or not at all.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file (.aspl); one that is there is replaced.
    ///
    /// Raises
    /// ------
    /// AsperityError
    ///     Where a texture is damaged, or the file cannot be written.
    fn save(&self, py: Python<'_>, path: PathBuf) -> Result<(), Failure> {
        py.detach(|| Ok(output::write_atomic(&path, &self.bytes()?)?))
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
        let bytes = encode(&assets)?;
        if let Some(path) = &path {
            output::write_atomic(path, &bytes)?;
        }
        Library::in_memory(bytes).map_err(Failure::from)
    })?;
    Ok(packed)
}

/// The file, once no other thread reads it.
fn held(textures: &Mutex<Textures>) -> MutexGuard<'_, Textures> {
    // A failed read leaves a file that can be read again.
    textures.lock().unwrap_or_else(PoisonError::into_inner)
}

fn in_data(error: FormatError) -> TexturesError {
    TexturesError {
        path: Path::new("data").to_owned(),
        texture: None,
        problem: TexturesProblem::Format(error),
    }
}
