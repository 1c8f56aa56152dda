//! `asperity.Scene`.

use crate::{error::Failure, library::Library, records};
use asperity::views::inspect::SurfaceDocument;
use pyo3::{PyClassInitializer, prelude::*};

/// Several surfaces, each a solid that wears a texture of this library.
///
/// Scenes come from `load`, and from `build` of a manifest with surfaces. `Renderer` renders one
/// as a whole: of several surfaces, the nearest, or the one in which the stylus is deepest.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> isinstance(asperity.pack([asperity.builtin()]), asperity.Scene)
/// False
#[pyclass(frozen, extends = Library, module = "asperity")]
pub(crate) struct Scene;

impl Library {
    /// As Python has it: a scene where it has surfaces.
    pub(crate) fn into_python(self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        if self.has_scene()? {
            let scene = PyClassInitializer::from(self).add_subclass(Scene);
            Ok(Py::new(py, scene)?.into_any())
        } else {
            Ok(Py::new(py, self)?.into_any())
        }
    }
}

#[pymethods]
impl Scene {
    /// The surfaces in their order: dicts as ``asperity inspect --json`` prints them.
    #[getter]
    fn surfaces<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let library = slf.as_super().get();
        let surfaces = py.detach(|| library.surfaces())?;
        let documents: Vec<SurfaceDocument> = surfaces
            .iter()
            .map(|surface| SurfaceDocument::of(surface, library.listed()))
            .collect();
        records::value(py, &documents)
    }

    fn __repr__(slf: &Bound<'_, Self>) -> Result<String, Failure> {
        let library = slf.as_super().get();
        let surfaces = library.surfaces()?.len();
        Ok(format!(
            "<Scene of {surfaces} surfaces: {}>",
            library.listed().join(", ")
        ))
    }
}
