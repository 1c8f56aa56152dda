//! Imports, and the built-in texture.

use crate::{
    arguments::{Fidelity, Preview, within},
    author,
    contents::Texture,
    error::{self, Failure},
    watch::watched,
};
use asperity::{
    driver::{self, Compiled},
    interchange::ranges,
    pipeline::{Clock, Request},
    sources::{
        Source, Tools,
        builtin::Builtin,
        effects::{Effects, EffectsKind, Options},
        hatt::{self, Hatt},
        model_file::ModelFile,
    },
};
use asperity_io::{
    clock::now,
    input::{self, InputError},
};
use pyo3::{IntoPyObjectExt as _, prelude::*};
use std::path::PathBuf;

/// Imports materials of the Penn Haptic Texture Toolkit.
///
/// HaTT holds no tapping traces: they are synthesised, or decoded by the learned model, and
/// marked so in the provenance. Other threads run meanwhile, and Ctrl-C stops between materials.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     One ``Models_<name>.xml``, or a folder of them.
/// fidelity : {"full", "auto"} or int, default "full"
///     How much of the source is kept: every vertex and triangle, the least within 0.5 dB, or
///     an AR order.
/// complete_taps : bool, default False
///     Whether the learned model decodes the taps from the AR grid.
/// progress : callable, optional
///     Called now and then with the materials that are done and all of them, on this thread.
///
/// Returns
/// -------
/// Texture or list of Texture
///     One texture of a file; of a folder, one of each file in order of name.
///
/// Raises
/// ------
/// AsperityError
///     Where a file is refused. Of a folder, all refused files are named.
#[pyfunction]
#[pyo3(
    signature = (path, *, fidelity=Fidelity::FULL, complete_taps=false, progress=None),
    text_signature = "(path, *, fidelity='full', complete_taps=False, progress=None)"
)]
pub(crate) fn import_hatt(
    py: Python<'_>,
    path: PathBuf,
    fidelity: Fidelity,
    complete_taps: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let is_folder = path.is_dir();
    let mut textures = watched(py, progress, |steps| {
        let materials: Vec<Hatt> = hatt::files(&path)?
            .into_iter()
            .map(|file| Hatt {
                file,
                complete_taps,
            })
            .collect();
        steps.of(materials.len());
        let author = complete_taps.then(author::shared).transpose()?;
        let tools = Tools {
            model: author.as_ref().map(|author| author.model()),
            clock: Clock(now),
            stop: Some(&steps.stop),
            ..Tools::default()
        };
        let request = Request {
            fidelity: fidelity.0,
            ..Request::default()
        };
        let mut results = driver::compile_all(&materials, &request, &tools, || steps.done());
        hatt::refuse_namesakes(&materials, &mut results);
        textures(results)
    })??;
    if is_folder {
        return textures.into_py_any(py);
    }
    // A single file gives a single texture.
    match textures.pop() {
        Some(texture) => texture.into_py_any(py),
        None => Err(Failure::new("no material", "give a file or a folder").into()),
    }
}

/// The textures, or all that went wrong.
fn textures(results: Vec<Result<Compiled, driver::Failure>>) -> Result<Vec<Texture>, Failure> {
    let mut textures = Vec::with_capacity(results.len());
    let mut failures: Option<Failure> = None;
    for result in results {
        match result {
            Ok(compiled) => textures.push(texture(compiled)?),
            Err(error) => {
                let failure = error::stopped(error);
                failures = Some(match failures {
                    None => failure,
                    Some(others) => others.and(failure),
                });
            }
        }
    }
    failures.map_or(Ok(textures), Err)
}

/// Imports a model of one's own, as JSON.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The model (.json), as ``docs/model.md`` describes it.
/// fidelity : {"full", "auto"} or int, default "full"
///     How much of the model is kept.
/// rate : float, optional
///     Rate of the models, Hz: that of the servo loop. The file's by default.
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
///
/// Returns
/// -------
/// Texture
///
/// Raises
/// ------
/// AsperityError
///     With the file and the key that is wrong.
#[pyfunction]
#[pyo3(
    signature = (path, *, fidelity=Fidelity::FULL, rate=None, preview=Preview::Usual),
    text_signature = "(path, *, fidelity='full', rate=None, preview=True)"
)]
pub(crate) fn import_model(
    py: Python<'_>,
    path: PathBuf,
    fidelity: Fidelity,
    rate: Option<f64>,
    preview: Preview,
) -> Result<Texture, Failure> {
    let request = request(None, fidelity, rate, preview);
    texture(py.detach(|| compiled(&ModelFile { file: path }, &request))?)
}

fn compiled(source: &dyn Source, request: &Request) -> Result<Compiled, Failure> {
    driver::compile(
        source,
        request,
        &Tools {
            clock: Clock(now),
            ..Tools::default()
        },
    )
    .map_err(error::stopped)
}

/// The texture with its report.
fn texture(compiled: Compiled) -> Result<Texture, Failure> {
    let report = compiled.json().to_string();
    Texture::made(compiled.lowered.bytes, Some(report))
}

/// Imports effects of another tool: AHAP, NiceVibrations ``.haptic`` or HJIF.
///
/// Such a file gives no speed, force or acceleration: arguments do. Its continuous effects become
/// one stroke, its transients taps. The asset equals that of ``asperity import ahap``, ``haptic``
/// or ``hjif``. Other threads run meanwhile.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     The file. Its content tells the format, or else its name.
/// name : str, optional
///     Name of the texture; that of the file by default.
/// speed_mm_s : float, default 100
///     Speed of the stroke, mm/s, 1 to 1000.
/// force_n : float, default 1
///     Normal force of the stroke, N, 0.05 to 20.
/// full_scale_m_s2, tap_full_scale_m_s2 : float, default 5 and 50
///     Acceleration at full scale in strokes and in taps, m/s², 0.001 to 10000.
/// tap_speed_m_s : float, default 0.3
///     Impact speed of the loudest tap, m/s, 0.01 to 5.
/// mu : float, default 0.5
///     Coefficient of friction, 0 to 2.
/// fidelity : {"full", "auto"} or int, default "auto"
///     How much is kept.
/// rate : float, optional
///     Rate of the models, Hz: that of the servo loop; 1000 by default.
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
///
/// Returns
/// -------
/// Texture
///
/// Warns
/// -----
/// AsperityWarning
///     For everything in the file that a texture cannot hold.
///
/// Raises
/// ------
/// UsageError
///     For an argument outside its range.
/// AsperityError
///     With the file and the field that is wrong.
#[pyfunction]
#[pyo3(
    signature = (
        path, *, name=None, speed_mm_s=100.0, force_n=1.0, full_scale_m_s2=5.0,
        tap_full_scale_m_s2=50.0, tap_speed_m_s=0.3, mu=0.5, fidelity=Fidelity::AUTO, rate=None,
        preview=Preview::Usual
    ),
    text_signature = "(path, *, name=None, speed_mm_s=100.0, force_n=1.0, full_scale_m_s2=5.0, \
                      tap_full_scale_m_s2=50.0, tap_speed_m_s=0.3, mu=0.5, fidelity='auto', \
                      rate=None, preview=True)"
)]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn import_effect(
    py: Python<'_>,
    path: PathBuf,
    name: Option<String>,
    speed_mm_s: f32,
    force_n: f32,
    full_scale_m_s2: f32,
    tap_full_scale_m_s2: f32,
    tap_speed_m_s: f32,
    mu: f32,
    fidelity: Fidelity,
    rate: Option<f64>,
    preview: Preview,
) -> PyResult<Texture> {
    let number = |name, number, range| within(name, number, &range).map(f64::from);
    let options = Options {
        speed_mm_s: number("speed_mm_s", speed_mm_s, ranges::SPEED_MM_S)?,
        force_n: number("force_n", force_n, ranges::FORCE_N)?,
        full_scale_m_s2: number("full_scale_m_s2", full_scale_m_s2, ranges::FULL_SCALE_M_S2)?,
        tap_full_scale_m_s2: number(
            "tap_full_scale_m_s2",
            tap_full_scale_m_s2,
            ranges::FULL_SCALE_M_S2,
        )?,
        tap_speed_m_s: number("tap_speed_m_s", tap_speed_m_s, ranges::TAP_SPEED_M_S)?,
        mu: number("mu", mu, ranges::MU)?,
    };
    let request = request(name, fidelity, rate, preview);
    let compiled = py.detach(|| {
        let found = input::format_of(&path).map_err(|problem| InputError {
            file: path.clone(),
            problem,
        })?;
        let kind = found
            .and_then(EffectsKind::of_format)
            .or_else(|| EffectsKind::of_name(&path));
        let kind = kind.ok_or_else(|| {
            let message = format!("{}: neither AHAP, .haptic nor HJIF", path.display());
            Failure::new(message, "give a file of one of these formats")
        })?;
        let source = Effects {
            file: path,
            kind,
            options,
        };
        compiled(&source, &request)
    })?;
    let report = compiled.json();
    author::texture(py, compiled, &report)
}

/// Builds the request for an imported texture.
pub(crate) fn request(
    name: Option<String>,
    fidelity: Fidelity,
    rate_hz: Option<f64>,
    preview: Preview,
) -> Request {
    Request {
        name,
        fidelity: fidelity.0,
        rate_hz,
        preview_px: preview.px(),
        ..Request::default()
    }
}

/// The built-in synthetic texture.
///
/// Returns
/// -------
/// Texture
#[pyfunction]
pub(crate) fn builtin(py: Python<'_>) -> Result<Texture, Failure> {
    let compiled = py.detach(|| compiled(&Builtin, &Request::default()))?;
    Texture::made(compiled.lowered.bytes, None)
}
