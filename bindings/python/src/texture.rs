//! `asperity.Texture`.

use crate::{
    arguments::Preview,
    arrays,
    author::PromptCompiler,
    contents::{Contents, Texture},
    error::Failure,
    mix::{self, Mixing},
    records::{of_fields, parsed, record, value},
};
use asperity::{
    emit::{lower::LowerError, sections::renamed},
    library::check_name,
    sources::latents::Edit,
};
use asperity_io::output;
use pyo3::{
    IntoPyObjectExt as _,
    prelude::*,
    types::{PyBytes, PyList},
};
use std::{
    hash::{DefaultHasher, Hash as _, Hasher as _},
    path::{Path, PathBuf},
};

#[pymethods]
impl Texture {
    #[new]
    fn of_bytes(data: Vec<u8>) -> Result<Self, Failure> {
        Ok(Self::new(
            Contents::new(data, Path::new("data"), None)?,
            None,
        ))
    }

    /// Name of the texture.
    #[getter]
    fn name(&self) -> Result<&str, Failure> {
        Ok(&self.document()?.name)
    }

    /// The prompt that it was made of, or None.
    #[getter]
    fn prompt(&self) -> Result<Option<&str>, Failure> {
        Ok(self.document()?.prompt.as_deref())
    }

    /// Version of the format that the asset is written in.
    #[getter]
    fn format_version(&self) -> Result<u16, Failure> {
        Ok(self.document()?.format_version)
    }

    /// The models over speed and force, as NumPy arrays.
    #[getter]
    fn grid<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let grid = self
            .grid
            .get_or_try_init(py, || arrays::grid(py, self.document()?).map(Bound::unbind))?;
        Ok(grid.bind(py).clone())
    }

    /// The tapping transients, as NumPy arrays.
    #[getter]
    fn taps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let taps = self
            .taps
            .get_or_try_init(py, || arrays::taps(py, self.document()?).map(Bound::unbind))?;
        Ok(taps.bind(py).clone())
    }

    /// Friction.
    #[getter]
    fn friction<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let friction = &self.document()?.friction;
        let anchors = PyList::empty(py);
        for anchor in &friction.anchors {
            anchors.append(record(py, "FrictionAnchor", anchor)?)?;
        }
        let law = match &friction.law {
            Some(law) => {
                let points = PyList::empty(py);
                for point in &law.points {
                    points.append(record(py, "LawPoint", point)?)?;
                }
                points.into_any()
            }
            None => py.None().into_bound(py),
        };
        let mu = friction.mu.into_bound_py_any(py)?;
        of_fields(
            py,
            "Friction",
            [("mu", mu), ("anchors", anchors.into_any()), ("law", law)],
        )
    }

    /// The virtual wall.
    #[getter]
    fn wall<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        record(py, "Wall", &self.document()?.wall)
    }

    /// Gains from accelerations to forces.
    #[getter]
    fn gains<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        record(py, "Gains", &self.document()?.gains)
    }

    /// Roughness, sharpness, hardness and slipperiness, computed from the asset.
    #[getter]
    fn attributes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        record(py, "Attributes", &self.document()?.attributes)
    }

    /// Sizes of the asset.
    #[getter]
    fn sizes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        record(py, "Sizes", &self.document()?.bytes)
    }

    /// Where it comes from.
    #[getter]
    fn provenance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        record(py, "Provenance", &self.document()?.provenance)
    }

    /// Report of the compiler or the importer, or None for a texture that was loaded.
    ///
    /// For a prompt, it is what ``asperity compile --json`` prints: nearest materials, certainty,
    /// what was left out, the duration of each pass.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.report
            .as_deref()
            .map(|json| parsed(py, json))
            .transpose()
    }

    /// Bytes of the preview, a PNG, or None.
    #[getter]
    fn preview_png<'py>(&self, py: Python<'py>) -> Result<Option<Bound<'py, PyBytes>>, Failure> {
        let asset = self.contents.asset()?;
        Ok(asset.preview_png().map(|png| PyBytes::new(py, png)))
    }

    /// Everything in the asset, as ``asperity inspect --json`` prints it.
    ///
    /// Returns
    /// -------
    /// dict
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        value(py, self.document()?)
    }

    /// The bytes of the asset, as a file holds them.
    ///
    /// Returns
    /// -------
    /// bytes
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, self.contents.bytes())
    }

    /// Writes the asset, in full or not at all.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike
    ///     The file (.asp); one that is there is replaced.
    ///
    /// Raises
    /// ------
    /// AsperityError
    ///     Where the file cannot be written. What was there is then unchanged.
    fn save(&self, py: Python<'_>, path: PathBuf) -> Result<(), Failure> {
        py.detach(|| Ok(output::write_atomic(&path, self.contents.bytes())?))
    }

    /// Edits the texture: along sliders, or in words. Other threads run meanwhile.
    ///
    /// The sliders run from 0 to 100 between the materials of the model. Each number moves its
    /// attribute by as many steps, down if negative, and holds the others still. The asset remembers
    /// every edit. The result equals that of ``asperity edit``.
    ///
    /// Parameters
    /// ----------
    /// rougher, sharper, harder, slipperier : float, default 0
    ///     Steps of the vibration's level, its centroid, the taps' centroid and less friction, -100
    ///     to 100.
    /// prompt : str, optional
    ///     The change in words, such as ``"less gritty, more like leather"``, without sliders.
    /// name : str, optional
    ///     Name of the result; that of this texture by default.
    /// preview : bool or int, default True
    ///     Whether a preview is drawn where this texture has one, or its size in pixels.
    /// author : Author, optional
    ///     Whose model the texture was compiled with; the embedded one by default.
    ///
    /// Returns
    /// -------
    /// Texture
    ///     With the steps that each attribute moved as ``report["moved"]``.
    ///
    /// Warns
    /// -----
    /// AsperityWarning
    ///     Where an attribute ends more than 3 steps from where it was asked to.
    ///
    /// Raises
    /// ------
    /// UsageError
    ///     For an edit that asks for nothing, or for words that are not understood.
    /// AsperityError
    ///     For a texture without a latent, or with one of another model.
    #[pyo3(
        signature = (
            *, rougher=0.0, sharper=0.0, harder=0.0, slipperier=0.0, prompt=None, name=None,
            preview=Preview::Usual, author=None
        ),
        text_signature = "($self, *, rougher=0.0, sharper=0.0, harder=0.0, slipperier=0.0, \
                          prompt=None, name=None, preview=True, author=None)"
    )]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    fn edit(
        &self,
        py: Python<'_>,
        rougher: f64,
        sharper: f64,
        harder: f64,
        slipperier: f64,
        prompt: Option<String>,
        name: Option<String>,
        preview: Preview,
        author: Option<&Bound<'_, PromptCompiler>>,
    ) -> PyResult<Self> {
        let sliders = mix::sliders([
            ("rougher", rougher),
            ("sharper", sharper),
            ("harder", harder),
            ("slipperier", slipperier),
        ])?;
        let edit = match prompt {
            Some(_) if !sliders.are_still() => {
                let message = "prompt: it cannot be given with sliders";
                return Err(Failure::usage(message, "edit twice, or leave one of them out").into());
            }
            Some(words) => Edit::Words(words),
            None => Edit::Steps(sliders),
        };
        let mixing = Mixing {
            name,
            preview,
            author,
        };
        mixing.changed(py, self, Some(&edit))
    }

    /// Takes the last edit back. Other threads run meanwhile.
    ///
    /// Parameters
    /// ----------
    /// name, preview, author
    ///     As of `edit`.
    ///
    /// Returns
    /// -------
    /// Texture
    ///
    /// Raises
    /// ------
    /// AsperityError
    ///     For a texture that was not edited.
    #[pyo3(
        signature = (*, name=None, preview=Preview::Usual, author=None),
        text_signature = "($self, *, name=None, preview=True, author=None)"
    )]
    fn undo(
        &self,
        py: Python<'_>,
        name: Option<String>,
        preview: Preview,
        author: Option<&Bound<'_, PromptCompiler>>,
    ) -> PyResult<Self> {
        let mixing = Mixing {
            name,
            preview,
            author,
        };
        mixing.changed(py, self, None)
    }

    /// The texture under another name; all else keeps its bytes.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     The name: 1 to 64 bytes, no control characters.
    ///
    /// Returns
    /// -------
    /// Texture
    ///
    /// Raises
    /// ------
    /// UsageError
    ///     For a name that no texture can have.
    fn rename(&self, name: &str) -> Result<Self, Failure> {
        check_name(name)?;
        let bytes = renamed(self.contents.bytes(), name).map_err(LowerError::from)?;
        Self::made(bytes, None)
    }

    /// Draws the texture on one sheet: poles, spectra, taps, grid, friction.
    ///
    /// Parameters
    /// ----------
    /// path : str or os.PathLike, optional
    ///     The PNG to write.
    ///
    /// Returns
    /// -------
    /// bytes or None
    ///     The PNG, unless it was written to a file.
    ///
    /// Raises
    /// ------
    /// AsperityError
    ///     Where the file cannot be written.
    #[pyo3(signature = (path=None))]
    fn plot<'py>(
        &self,
        py: Python<'py>,
        path: Option<PathBuf>,
    ) -> Result<Option<Bound<'py, PyBytes>>, Failure> {
        let png = py.detach(|| self.contents.sheet())?;
        match path {
            None => Ok(Some(PyBytes::new(py, &png))),
            Some(path) => {
                py.detach(|| output::write_atomic(&path, &png))?;
                Ok(None)
            }
        }
    }

    /// The sheet that `plot` draws: notebooks show it.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> Result<Bound<'py, PyBytes>, Failure> {
        let png = py.detach(|| self.contents.sheet())?;
        Ok(PyBytes::new(py, &png))
    }

    fn __repr__(&self) -> Result<String, Failure> {
        let d = self.document()?;
        let number = |value: Option<f64>, unit: &str| {
            value.map_or("none".to_owned(), |value| format!("{value:.1} {unit}"))
        };
        Ok(format!(
            "<Texture {:?}: order {}, {} vertices, {} Hz, {} taps; rough {}, sharp {}, hard {}, \
             mu {:.3}; {} haptic bytes>",
            d.name,
            d.ar.order,
            d.ar.vertices.len(),
            d.ar.sample_rate_hz,
            d.taps.speeds_m_s.len(),
            number(d.attributes.rough_db, "dB"),
            number(d.attributes.sharp_hz, "Hz"),
            number(d.attributes.hard_hz, "Hz"),
            d.attributes.mu,
            d.bytes.haptic,
        ))
    }

    fn __bytes__<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        self.to_bytes(py)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.contents.bytes().hash(&mut hasher);
        hasher.finish()
    }

    /// For pickles and copies, which leave the report out.
    fn __getnewargs__<'py>(&self, py: Python<'py>) -> (Bound<'py, PyBytes>,) {
        (self.to_bytes(py),)
    }
}

/// Draws a texture on one sheet: poles, spectra, taps, grid, friction.
///
/// Parameters
/// ----------
/// texture : Texture
///     The texture.
/// path : str or os.PathLike, optional
///     The PNG to write.
///
/// Returns
/// -------
/// bytes or None
///     The PNG, unless it was written to a file.
///
/// Raises
/// ------
/// AsperityError
///     Where the file cannot be written.
#[pyfunction]
#[pyo3(signature = (texture, path=None))]
pub(crate) fn plot<'py>(
    py: Python<'py>,
    texture: &Texture,
    path: Option<PathBuf>,
) -> Result<Option<Bound<'py, PyBytes>>, Failure> {
    texture.plot(py, path)
}
