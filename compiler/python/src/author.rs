//! `asperity.compile` and `asperity.Author`.

use crate::{
    arguments::{Fidelity, Seed},
    error::{self, Failure},
    texture::Texture,
};
use asperity::{
    driver::{self, Compiled},
    embedded,
    inference::{Backend, BackendName},
    pipeline::{Clock, Request},
    prompt::{self, Options, Prompt, PromptError},
    sources::Tools,
    text::{TextEncoder, TextEncoderChoice, clip::Clip},
};
use asperity_io::clock::now;
use pyo3::prelude::*;
use std::{
    ffi::CString,
    path::PathBuf,
    sync::{Arc, Mutex, PoisonError},
};

/// The embedded author, once somebody asked for it.
static EMBEDDED: Mutex<Option<Arc<prompt::PromptCompiler>>> = Mutex::new(None);

/// The embedded author, loaded once.
pub(crate) fn shared() -> Result<Arc<prompt::PromptCompiler>, Failure> {
    // A reference that is there or not is whole after any panic.
    let mut author = EMBEDDED.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(author) = &*author {
        return Ok(Arc::clone(author));
    }
    let loaded = Arc::new(prompt::PromptCompiler::embedded(&Backend::Portable)?);
    *author = Some(Arc::clone(&loaded));
    Ok(loaded)
}

/// Compiles a prompt into a texture, verified by the runtime itself.
///
/// The same prompt, arguments and version give the same bytes on every machine, and the same as
/// ``asperity compile``. The model is loaded by the first call. Other threads run meanwhile.
///
/// Parameters
/// ----------
/// prompt : str
///     What the surface feels like, looks like, is made of or is for.
/// seed : int, default 0
///     0 for the texture that the prompt means, others for variations of it.
/// fidelity : {"full", "auto"} or int, default "auto"
///     How much of the texture is kept: all, the least within 0.5 dB, or an AR order.
/// rate : float, optional
///     Rate of the models, Hz: that of the servo loop. The model's own by default.
/// preview : bool, default True
///     Whether the asset holds a preview.
///
/// Returns
/// -------
/// Texture
///     With what there is to know of it as `Texture.report`.
///
/// Warns
/// -----
/// AsperityWarning
///     Where the prompt is far from everything the model knows, or too long for its encoder.
///
/// Raises
/// ------
/// UsageError
///     For an empty prompt, a fidelity or a rate that makes no sense.
/// AsperityError
///     Where the texture does not pass verification.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> marble = asperity.compile("polished marble", seed=3)
/// >>> marble.name
/// 'polished marble'
#[pyfunction]
#[pyo3(
    signature = (prompt, *, seed=Seed(0), fidelity=Fidelity::AUTO, rate=None, preview=true),
    text_signature = "(prompt, *, seed=0, fidelity='auto', rate=None, preview=True)"
)]
pub(crate) fn compile(
    py: Python<'_>,
    prompt: &str,
    seed: Seed,
    fidelity: Fidelity,
    rate: Option<f64>,
    preview: bool,
) -> PyResult<Texture> {
    let options = options(seed, fidelity, rate, preview);
    let authored = py.detach(|| {
        // Before half a second of loading.
        if prompt.trim().is_empty() {
            return Err(error::stopped(PromptError::Empty.into()));
        }
        let author = shared()?;
        authored(&author, prompt, &options)
    })?;
    told(py, authored)
}

/// A model and a text encoder of one's own, loaded once, asked often.
///
/// Parameters
/// ----------
/// model : str or os.PathLike, optional
///     A model folder that ``asperity-train fit`` wrote. The embedded model by default.
/// text_encoder : str, default "minilm"
///     ``"minilm"``, embedded, or ``"clip:DIR"`` with an export of CLIP's text tower.
/// backend : {"portable", "onnxruntime"}, default "portable"
///     What runs the networks: the same bits everywhere, or ONNX Runtime where it is installed.
///
/// Raises
/// ------
/// UsageError
///     For a text encoder or back end that does not exist.
/// AsperityError
///     Where the folder is no model, does not fit the encoder, or a library is missing.
#[pyclass(frozen, module = "asperity")]
pub(crate) struct Author {
    author: prompt::PromptCompiler,
}

#[pymethods]
impl Author {
    #[new]
    #[pyo3(signature = (model=None, *, text_encoder="minilm", backend="portable"))]
    fn new(
        py: Python<'_>,
        model: Option<PathBuf>,
        text_encoder: &str,
        backend: &str,
    ) -> Result<Self, Failure> {
        let encoder: TextEncoderChoice = text_encoder.parse().map_err(|rule: String| {
            let message = format!("text_encoder = {text_encoder:?}: not {rule}");
            Failure::usage(message, "leave it out for the embedded encoder")
        })?;
        let name: BackendName = backend.parse().map_err(|rule: String| {
            let message = format!("backend = {backend:?}: not {rule}");
            Failure::usage(message, "leave it out for the portable engine")
        })?;
        let author = py.detach(|| author(model, &encoder, name))?;
        Ok(Self { author })
    }

    /// Compiles a prompt into a texture; see `asperity.compile`.
    ///
    /// Parameters
    /// ----------
    /// prompt : str
    ///     What the surface feels like, looks like, is made of or is for.
    /// seed : int, default 0
    ///     0 for the texture that the prompt means, others for variations of it.
    /// fidelity : {"full", "auto"} or int, default "auto"
    ///     How much of the texture is kept.
    /// rate : float, optional
    ///     Rate of the models, Hz.
    /// preview : bool, default True
    ///     Whether the asset holds a preview.
    ///
    /// Returns
    /// -------
    /// Texture
    #[pyo3(
        signature = (prompt, *, seed=Seed(0), fidelity=Fidelity::AUTO, rate=None, preview=true),
        text_signature = "($self, prompt, *, seed=0, fidelity='auto', rate=None, preview=True)"
    )]
    fn compile(
        &self,
        py: Python<'_>,
        prompt: &str,
        seed: Seed,
        fidelity: Fidelity,
        rate: Option<f64>,
        preview: bool,
    ) -> PyResult<Texture> {
        let options = options(seed, fidelity, rate, preview);
        let authored = py.detach(|| authored(&self.author, prompt, &options))?;
        told(py, authored)
    }
}

/// A prompt's texture, timed.
fn authored(
    author: &prompt::PromptCompiler,
    text: &str,
    options: &Options,
) -> Result<Compiled, Failure> {
    let source = Prompt {
        text: text.to_owned(),
        seed: options.seed,
        picture: None,
    };
    let tools = Tools {
        clock: Clock(now),
        ..Tools::of(author)
    };
    driver::compile(&source, &options.request, &tools).map_err(error::stopped)
}

fn author(
    model: Option<PathBuf>,
    encoder: &TextEncoderChoice,
    backend: BackendName,
) -> Result<prompt::PromptCompiler, Failure> {
    let backend = Backend::open(backend)?;
    let (text, folder): (Box<dyn TextEncoder>, PathBuf) = match (encoder, model) {
        (TextEncoderChoice::MiniLm, None) => {
            return Ok(prompt::PromptCompiler::embedded(&backend)?);
        }
        (TextEncoderChoice::MiniLm, Some(folder)) => {
            (Box::new(embedded::text_encoder(&backend)?), folder)
        }
        (TextEncoderChoice::Clip(clip), Some(folder)) => {
            (Box::new(Clip::open(clip, &backend)?), folder)
        }
        (TextEncoderChoice::Clip(_), None) => {
            let message = "text_encoder: the embedded model was not trained with CLIP";
            return Err(Failure::usage(
                message,
                "give a model that was, as model=DIR",
            ));
        }
    };
    Ok(prompt::PromptCompiler::with_folder(
        text, &folder, &backend,
    )?)
}

fn options(seed: Seed, fidelity: Fidelity, rate_hz: Option<f64>, preview: bool) -> Options {
    Options {
        seed: seed.0,
        request: Request {
            fidelity: fidelity.0,
            rate_hz,
            preview_px: preview.then_some(asperity::preview::SIZE),
            ..Request::default()
        },
    }
}

/// The texture; its warnings are issued as `AsperityWarning`.
fn told(py: Python<'_>, authored: Compiled) -> PyResult<Texture> {
    let category = py.import("asperity._errors")?.getattr("AsperityWarning")?;
    for warning in &authored.warnings {
        let text = CString::new(warning.as_str()).unwrap_or_default();
        PyErr::warn(py, &category, &text, 1)?;
    }
    let report = authored.json().to_string();
    Ok(Texture::made(authored.lowered.bytes, Some(report))?)
}
