//! `asperity.compile` and `asperity.Author`.

use crate::{
    arguments::{Fidelity, Preview, Seed},
    contents::Texture,
    error::{self, Failure},
};
use asperity::{
    driver::{self, Compiled},
    learned::{inference::Backend, text::TextEncoderChoice},
    library::Setup,
    pipeline::{Clock, Request},
    sources::{
        Tools,
        prompt::{self, Options, Prompt, PromptError},
    },
};
use asperity_io::clock::now;
use pyo3::prelude::*;
use serde_json::Value;
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
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
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
    signature = (prompt, *, seed=Seed(0), fidelity=Fidelity::AUTO, rate=None, preview=Preview::Usual),
    text_signature = "(prompt, *, seed=0, fidelity='auto', rate=None, preview=True)"
)]
pub(crate) fn compile(
    py: Python<'_>,
    prompt: &str,
    seed: Seed,
    fidelity: Fidelity,
    rate: Option<f64>,
    preview: Preview,
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
    let report = authored.json();
    texture(py, authored, &report)
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
#[pyclass(name = "Author", frozen, module = "asperity")]
pub(crate) struct PromptCompiler {
    pub(crate) compiler: prompt::PromptCompiler,
}

#[pymethods]
impl PromptCompiler {
    #[new]
    #[pyo3(signature = (model=None, *, text_encoder="minilm", backend="portable"))]
    fn new(
        py: Python<'_>,
        model: Option<PathBuf>,
        text_encoder: &str,
        backend: &str,
    ) -> Result<Self, Failure> {
        let setup = networks(model, text_encoder, backend)?;
        if let (TextEncoderChoice::Clip(_), None) = (&setup.text_encoder, &setup.model) {
            let message = "text_encoder: the embedded model was not trained with CLIP";
            let remedy = "give a model that was, as model=DIR";
            return Err(Failure::usage(message, remedy));
        }
        let compiler = py.detach(|| setup.prompt_compiler().map_err(Failure::all))?;
        Ok(Self { compiler })
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
    /// preview : bool or int, default True
    ///     Whether the asset holds a preview, or its size.
    ///
    /// Returns
    /// -------
    /// Texture
    #[pyo3(
        signature = (prompt, *, seed=Seed(0), fidelity=Fidelity::AUTO, rate=None, preview=Preview::Usual),
        text_signature = "($self, prompt, *, seed=0, fidelity='auto', rate=None, preview=True)"
    )]
    fn compile(
        &self,
        py: Python<'_>,
        prompt: &str,
        seed: Seed,
        fidelity: Fidelity,
        rate: Option<f64>,
        preview: Preview,
    ) -> PyResult<Texture> {
        let options = options(seed, fidelity, rate, preview);
        let authored = py.detach(|| authored(&self.compiler, prompt, &options))?;
        let report = authored.json();
        texture(py, authored, &report)
    }
}

/// A prompt's texture, timed.
fn authored(
    compiler: &prompt::PromptCompiler,
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
        ..Tools::of(compiler)
    };
    driver::compile(&source, &options.request, &tools).map_err(error::stopped)
}

/// The networks that arguments name.
pub(crate) fn networks(
    model: Option<PathBuf>,
    text_encoder: &str,
    backend: &str,
) -> Result<Setup, Failure> {
    Ok(Setup {
        text_encoder: text_encoder.parse().map_err(|rule: String| {
            let message = format!("text_encoder = {text_encoder:?}: not {rule}");
            Failure::usage(message, "leave it out for the embedded encoder")
        })?,
        model,
        backend: backend.parse().map_err(|rule: String| {
            let message = format!("backend = {backend:?}: not {rule}");
            Failure::usage(message, "leave it out for the portable engine")
        })?,
    })
}

fn options(seed: Seed, fidelity: Fidelity, rate_hz: Option<f64>, preview: Preview) -> Options {
    Options {
        seed: seed.0,
        request: Request {
            fidelity: fidelity.0,
            rate_hz,
            preview_px: preview.px(),
            ..Request::default()
        },
    }
}

/// The texture with its report; its warnings are issued as `AsperityWarning`.
pub(crate) fn texture(py: Python<'_>, compiled: Compiled, report: &Value) -> PyResult<Texture> {
    warn(py, &compiled.warnings)?;
    Ok(Texture::made(
        compiled.lowered.bytes,
        Some(report.to_string()),
    )?)
}

/// Issues warnings.
pub(crate) fn warn(py: Python<'_>, warnings: &[String]) -> PyResult<()> {
    let category = py.import("asperity._errors")?.getattr("AsperityWarning")?;
    for warning in warnings {
        let text = CString::new(warning.as_str()).unwrap_or_default();
        PyErr::warn(py, &category, &text, 1)?;
    }
    Ok(())
}
