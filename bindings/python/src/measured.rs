//! Imports of what was measured: recordings, and maps of a surface.

use crate::{
    arguments::{Fidelity, Preview},
    author::{self, PromptCompiler},
    contents::Texture,
    error::{self, Failure},
    import::request,
};
use asperity::{
    driver::{self, Compiled},
    learned::inference::Backend,
    library::Setup,
    pipeline::{Clock, Request},
    sources::{
        Source, Tools,
        recording::RecordingFolder,
        surface::{Options, Size, Surface},
    },
};
use asperity_io::{clock::now, output};
use pyo3::prelude::*;
use std::{
    path::{Path, PathBuf},
    str::FromStr,
};

/// Compiles a source, and draws its sheet.
fn measured(
    source: &dyn Source,
    request: &Request,
    tools: Tools<'_>,
    plot: Option<&Path>,
) -> Result<Compiled, Failure> {
    let tools = Tools {
        clock: Clock(now),
        ..tools
    };
    let compiled = driver::compile(source, request, &tools).map_err(error::stopped)?;
    if let Some(path) = plot {
        let sheet = compiled.sheet().map_err(|error| {
            let message = format!("the sheet cannot be drawn: {error}");
            Failure::new(message, "leave plot out")
        })?;
        output::write_atomic(path, &sheet.unwrap_or_default())?;
    }
    Ok(compiled)
}

/// Imports a recording: the acceleration, force and motion of a tool on a surface.
///
/// The files are checked, aligned and fitted; what was not recorded is completed by the learned
/// model, as the report states. The asset equals that of ``asperity import recording``. Other
/// threads run meanwhile.
///
/// Parameters
/// ----------
/// folder : str or os.PathLike
///     A folder with ``recording.toml`` and CSV, WAV or NumPy files: ``docs/recording.md``.
/// fidelity : {"full", "auto"} or int, default "auto"
///     How much is kept.
/// rate : float, optional
///     Rate of the models, Hz: that of the servo loop; 1000 by default.
/// force : bool, default False
///     Whether faults that the check found are let pass.
/// model : str or os.PathLike, optional
///     A model folder; the embedded model by default.
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
/// plot : str or os.PathLike, optional
///     A PNG to draw every step of the import on.
///
/// Returns
/// -------
/// Texture
///     With the report of every step as `Texture.report`.
///
/// Warns
/// -----
/// AsperityWarning
///     For everything that the check warns of.
///
/// Raises
/// ------
/// AsperityError
///     With the file, the channel and the remedy of what is wrong.
#[pyfunction]
#[pyo3(
    signature = (
        folder, *, fidelity=Fidelity::AUTO, rate=None, force=false, model=None,
        preview=Preview::Usual, plot=None
    ),
    text_signature = "(folder, *, fidelity='auto', rate=None, force=False, model=None, \
                      preview=True, plot=None)"
)]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn import_recording(
    py: Python<'_>,
    folder: PathBuf,
    fidelity: Fidelity,
    rate: Option<f64>,
    force: bool,
    model: Option<PathBuf>,
    preview: Preview,
    plot: Option<PathBuf>,
) -> PyResult<Texture> {
    let source = RecordingFolder { folder, force };
    let request = request(None, fidelity, rate, preview);
    let compiled = py.detach(|| {
        let setup = Setup {
            model,
            ..Setup::default()
        };
        let model = setup.model(&Backend::Portable).map_err(Failure::all)?;
        let tools = Tools {
            model: Some(&model),
            ..Tools::default()
        };
        measured(&source, &request, tools, plot.as_deref())
    })?;
    let report = compiled.json();
    author::texture(py, compiled, &report)
}

/// Imports a map of a surface: heights, normals, the pictures of a material, or a profile.
///
/// What a stylus meets on it at many speeds and forces becomes the texture, with the direction of
/// its ribs or grain. The asset equals that of ``asperity import surface``. Other threads run
/// meanwhile.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     A height map or a normal map (PNG, TIFF, JPEG), a folder with the pictures of a material,
///     or a profile (CSV): ``docs/surfaces.md``.
/// width_mm : float, optional
///     Width of the surface that the map shows; only a profile with positions says it.
/// depth_mm : float, optional
///     Height of white above black, negative where white is low; by default, as strong as `like`.
/// normal : {"gl", "dx"}, optional
///     Where green points to in normals: up, or down. By default, what fits a surface.
/// like : str, optional
///     Words for the material: its hardness, taps and friction.
/// tip : {"stylus", "fingertip", "needle"}, default "stylus"
///     What strokes it.
/// name : str, optional
///     Name of the texture; that of the file by default.
/// fidelity : {"full", "auto"} or int, default "auto"
///     How much is kept.
/// rate : float, optional
///     Rate of the models, Hz: that of the servo loop; 1000 by default.
/// author : Author, optional
///     The model for the words and for what is missing; the embedded one by default.
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
/// plot : str or os.PathLike, optional
///     A PNG to draw the map and its spectra on.
///
/// Returns
/// -------
/// Texture
///
/// Warns
/// -----
/// AsperityWarning
///     For everything that had to be guessed, and for what the map does not hold.
///
/// Raises
/// ------
/// UsageError
///     For an argument that is missing or contradicts the map.
/// AsperityError
///     With the picture that is wrong.
#[pyfunction]
#[pyo3(
    signature = (
        path, *, width_mm=None, depth_mm=None, normal=None, like=None, tip="stylus", name=None,
        fidelity=Fidelity::AUTO, rate=None, author=None, preview=Preview::Usual, plot=None
    ),
    text_signature = "(path, *, width_mm=None, depth_mm=None, normal=None, like=None, \
                      tip='stylus', name=None, fidelity='auto', rate=None, author=None, \
                      preview=True, plot=None)"
)]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn import_surface(
    py: Python<'_>,
    path: PathBuf,
    width_mm: Option<f64>,
    depth_mm: Option<f64>,
    normal: Option<&str>,
    like: Option<String>,
    tip: &str,
    name: Option<String>,
    fidelity: Fidelity,
    rate: Option<f64>,
    author: Option<&PromptCompiler>,
    preview: Preview,
    plot: Option<PathBuf>,
) -> PyResult<Texture> {
    let options = Options {
        size: Size { width_mm, depth_mm },
        like,
        tip: named("tip", tip)?,
        convention: normal.map(|text| named("normal", text)).transpose()?,
    };
    let source = Surface { path, options };
    let request = request(name, fidelity, rate, preview);
    let own = author.map(|author| &author.compiler);
    let compiled = py.detach(|| {
        let shared = match own {
            Some(_) => None,
            None => Some(author::shared()?),
        };
        let tools = own.or(shared.as_deref()).map(Tools::of);
        measured(
            &source,
            &request,
            tools.unwrap_or_default(),
            plot.as_deref(),
        )
    })?;
    let report = compiled.json();
    author::texture(py, compiled, &report)
}

/// The value that a text names.
fn named<T: FromStr<Err = String>>(argument: &str, text: &str) -> Result<T, Failure> {
    text.parse().map_err(|wanted: String| {
        let message = format!("{argument} = {text:?}: must be {wanted}");
        Failure::usage(message, "correct it, or leave it out")
    })
}
