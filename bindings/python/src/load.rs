//! `asperity.load`.

use crate::{
    arguments::{Choice, Origin},
    contents::{Contents, Texture},
    error::Failure,
    library::Library,
};
use asperity::emit::textures::{Textures, TexturesError, TexturesProblem};
use pyo3::{IntoPyObjectExt as _, prelude::*};
use std::path::Path;

enum Loaded {
    Texture(Texture),
    Library(Library),
}

/// Loads an asset or a library.
///
/// Every checksum of a texture is verified when it is read. Of a library in a file, the index is
/// read, and a texture when it is asked for.
///
/// Parameters
/// ----------
/// origin : str, os.PathLike or bytes
///     The file (.asp, .aspl), or its bytes.
/// texture : str or int, optional
///     One texture of a library, by name or index.
///
/// Returns
/// -------
/// Texture, Library or Scene
///     A texture of an asset, or where one of a library was named; a scene where the library has one.
///
/// Raises
/// ------
/// AsperityError
///     With the file, the field that is wrong and what to do about it.
/// NoSuchTextureError
///     Where the library has no such texture.
#[pyfunction]
#[pyo3(signature = (origin, texture=None))]
pub(crate) fn load(py: Python<'_>, origin: Origin, texture: Option<Choice>) -> PyResult<Py<PyAny>> {
    let loaded = py.detach(|| {
        let loaded = match origin {
            Origin::Bytes(bytes) => of_bytes(bytes.to_vec()),
            Origin::Path(path) => of_file(&path),
        }?;
        match (loaded, texture) {
            (Loaded::Library(library), Some(choice)) => {
                library.choose(&choice).map(Loaded::Texture)
            }
            (Loaded::Texture(found), Some(choice)) => {
                let name = found.contents.asset()?.name().to_owned();
                let means = match &choice {
                    Choice::Index(index) => *index == 0 || *index == -1,
                    Choice::Name(wanted) => *wanted == name,
                };
                if means {
                    Ok(Loaded::Texture(found))
                } else {
                    let message = format!("an asset with the texture {name:?} alone");
                    let remedy = "leave the texture out, or load a library";
                    Err(Failure::no_such_texture(message, remedy))
                }
            }
            (loaded, None) => Ok(loaded),
        }
    })?;
    match loaded {
        Loaded::Texture(texture) => texture.into_py_any(py),
        Loaded::Library(library) => library.into_python(py),
    }
}

fn of_file(path: &Path) -> Result<Loaded, Failure> {
    let mut textures = Textures::open(path)?;
    match textures.names() {
        Some(names) => Ok(Loaded::Library(Library::in_file(names, textures))),
        None => {
            let contents = Contents::new(textures.choose(None)?, path, None)?;
            Ok(Loaded::Texture(Texture::new(contents, None)))
        }
    }
}

fn of_bytes(bytes: Vec<u8>) -> Result<Loaded, Failure> {
    let path = Path::new("data");
    if bytes.starts_with(b"ASPL") {
        Ok(Loaded::Library(Library::in_memory(bytes)?))
    } else if bytes.starts_with(b"ASPT") {
        let contents = Contents::new(bytes, path, None)?;
        Ok(Loaded::Texture(Texture::new(contents, None)))
    } else {
        Err(TexturesError {
            path: path.to_owned(),
            texture: None,
            problem: TexturesProblem::WrongKind,
        }
        .into())
    }
}
