//! `asperity.import_hatt`, `import_model` and `builtin`.

use crate::{
    arguments::Fidelity,
    author,
    error::{self, Failure},
    texture::Texture,
};
use asperity::{
    builtin::Builtin,
    driver::{self, Compiled},
    hatt::{self, Hatt},
    model_file::ModelFile,
    pipeline::{Clock, Request},
    sources::{Source, Tools},
};
use asperity_io::clock::now;
use pyo3::{IntoPyObjectExt as _, prelude::*};
use std::path::PathBuf;

/// Imports materials of the Penn Haptic Texture Toolkit.
///
/// HaTT holds no tapping traces: they are synthesised, or decoded by the learned model, and
/// marked so in the provenance. Other threads run meanwhile.
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
    signature = (path, *, fidelity=Fidelity::FULL, complete_taps=false),
    text_signature = "(path, *, fidelity='full', complete_taps=False)"
)]
pub(crate) fn import_hatt(
    py: Python<'_>,
    path: PathBuf,
    fidelity: Fidelity,
    complete_taps: bool,
) -> PyResult<Py<PyAny>> {
    let mut textures = py.detach(|| {
        let materials: Vec<Hatt> = hatt::files(&path)?
            .into_iter()
            .map(|file| Hatt {
                file,
                complete_taps,
            })
            .collect();
        let author = complete_taps.then(author::shared).transpose()?;
        let tools = Tools {
            model: author.as_ref().map(|author| author.model()),
            clock: Clock(now),
            ..Tools::default()
        };
        let request = Request {
            fidelity: fidelity.0,
            ..Request::default()
        };
        let mut results = driver::compile_all(&materials, &request, &tools, || {});
        hatt::refuse_namesakes(&materials, &mut results);
        textures(results)
    })?;
    if path.is_dir() {
        return textures.into_py_any(py);
    }
    // A single file gives a single texture.
    match textures.pop() {
        Some(texture) => texture.into_py_any(py),
        None => Err(Failure::new(path.display(), "give a file or a folder").into()),
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
/// preview : bool, default True
///     Whether the asset holds a preview.
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
    signature = (path, *, fidelity=Fidelity::FULL, rate=None, preview=true),
    text_signature = "(path, *, fidelity='full', rate=None, preview=True)"
)]
pub(crate) fn import_model(
    py: Python<'_>,
    path: PathBuf,
    fidelity: Fidelity,
    rate: Option<f64>,
    preview: bool,
) -> Result<Texture, Failure> {
    let request = Request {
        fidelity: fidelity.0,
        rate_hz: rate,
        preview_px: preview.then_some(asperity::preview::SIZE),
        ..Request::default()
    };
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
