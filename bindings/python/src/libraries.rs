//! `asperity.merge` and `diff`, and what they read.

use crate::{contents::Texture, error::Failure, library::Library, records};
use asperity::library::{self, LoadedLibrary};
use asperity_io::output;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A library or a texture, which counts as a library of one.
#[derive(FromPyObject)]
pub(crate) enum Part<'py> {
    Library(Bound<'py, Library>),
    Texture(Bound<'py, Texture>),
}

impl Part<'_> {
    /// All its textures, checked. `shown` names it in errors.
    fn loaded(&self, py: Python<'_>, shown: String) -> Result<LoadedLibrary, Failure> {
        match self {
            Self::Library(library) => {
                let library = library.get();
                py.detach(|| library.loaded(shown))
            }
            Self::Texture(texture) => {
                let contents = &texture.get().contents;
                Ok(LoadedLibrary {
                    shown,
                    textures: vec![(
                        contents.asset()?.name().to_owned(),
                        contents.bytes().to_vec(),
                    )],
                    is_library: false,
                    has_scene: false,
                })
            }
        }
    }
}

/// Merges libraries, such as the shards of a manifest, into the bytes that one build gives.
///
/// Parameters
/// ----------
/// libraries : iterable of Library or Texture
///     A texture may be in several of them if it is identical in all.
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
///     For every name that means different textures, for a scene, and for a file that cannot be
///     written.
#[pyfunction]
#[pyo3(signature = (libraries, path=None))]
pub(crate) fn merge(libraries: &Bound<'_, PyAny>, path: Option<PathBuf>) -> PyResult<Library> {
    let py = libraries.py();
    let mut parts = Vec::new();
    for (index, part) in libraries.try_iter()?.enumerate() {
        let part: Part<'_> = part?.extract()?;
        let part = part.loaded(py, format!("libraries[{index}]"))?;
        part.refuse_scene().map_err(Failure::from)?;
        parts.push(part);
    }
    let merged = py.detach(|| {
        let bytes = library::merge(&parts).map_err(Failure::all)?;
        if let Some(path) = &path {
            output::write_atomic(path, &bytes)?;
        }
        Library::in_memory(bytes).map_err(Failure::from)
    })?;
    Ok(merged)
}

/// Compares two libraries, or two textures whatever their names.
///
/// Parameters
/// ----------
/// old, new : Library or Texture
///     The two versions.
///
/// Returns
/// -------
/// dict
///     As ``asperity diff --json`` prints it: names ``"added"`` and ``"removed"``, what
///     ``"changed"``, and the number of textures that are the ``"same"``.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> grit = asperity.builtin()
/// >>> asperity.diff(grit, grit)["same"]
/// 1
#[pyfunction]
pub(crate) fn diff<'py>(
    py: Python<'py>,
    old: Part<'_>,
    new: Part<'_>,
) -> PyResult<Bound<'py, PyAny>> {
    let (old, new) = (old.loaded(py, "old".into())?, new.loaded(py, "new".into())?);
    let difference = py.detach(|| library::diff(&old, &new));
    records::value(py, &difference.map_err(Failure::from)?)
}
