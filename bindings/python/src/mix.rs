//! `asperity.blend`, `compose` and `encode`, and the edits of `Texture`.

use crate::{
    arguments::{Preview, within},
    author::{self, PromptCompiler},
    contents::Texture,
    error::{self, Failure},
};
use asperity::{
    driver,
    library::check_name,
    pipeline::Clock,
    sources::{
        Tools,
        latents::{Edit, LatentEditor, Mix, MixOptions, MixPreview, Part, Sliders, nothing_asked},
    },
};
use asperity_io::clock::now;
use pyo3::prelude::*;

/// Common arguments of mixtures, besides the ingredients.
pub(crate) struct Mixing<'a, 'py> {
    pub(crate) name: Option<String>,
    pub(crate) preview: Preview,
    pub(crate) author: Option<&'a Bound<'py, PromptCompiler>>,
}

/// Blends two textures in the latent space of the model.
///
/// The result is decoded from ``(1 - t) * a + t * b``, with the fidelity and the rate of `a`, and
/// equals that of ``asperity blend``. Other threads run meanwhile.
///
/// Parameters
/// ----------
/// a, b : Texture
///     The textures at t = 0 and at t = 1, compiled from prompts or encoded.
/// t : float, default 0.5
///     Where between them, 0 to 1.
/// name : str, optional
///     Name of the texture; one that names both by default.
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
/// author : Author, optional
///     Whose model the textures were compiled with; the embedded one by default.
///
/// Returns
/// -------
/// Texture
///
/// Raises
/// ------
/// UsageError
///     For a `t` or a name that makes no sense.
/// AsperityError
///     For a texture without a latent, or with one of another model.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> cork, ice = asperity.compile("cork"), asperity.compile("wet ice")
/// >>> between = asperity.blend(cork, ice, 0.25, name="icy cork")
/// >>> ice.friction.mu < between.friction.mu < cork.friction.mu
/// True
#[pyfunction]
#[pyo3(
    signature = (a, b, t=0.5, *, name=None, preview=Preview::Usual, author=None),
    text_signature = "(a, b, t=0.5, *, name=None, preview=True, author=None)"
)]
pub(crate) fn blend(
    py: Python<'_>,
    a: &Bound<'_, Texture>,
    b: &Bound<'_, Texture>,
    t: f64,
    name: Option<String>,
    preview: Preview,
    author: Option<&Bound<'_, PromptCompiler>>,
) -> PyResult<Texture> {
    let t = within("t", t, &(0.0..=1.0))?;
    let (a, b) = (a.get(), b.get());
    let mixing = Mixing {
        name,
        preview,
        author,
    };
    mixing.mixed(py, |editor, options| {
        let (a, b) = (a.contents.asset()?, b.contents.asset()?);
        Ok(editor.blend(&a, &b, t, options)?)
    })
}

/// Composes a texture that taps, slides and rubs like others.
///
/// Taps and wall come from `tap`, the models from `slide`, with its fidelity and rate, and friction
/// from `friction`. The result equals that of ``asperity compose``. Other threads run meanwhile.
///
/// Parameters
/// ----------
/// tap, slide : Texture
///     What it taps like, and what sliding over it sounds like.
/// friction : Texture, optional
///     What it rubs like; `slide` by default.
/// name : str, optional
///     Name of the texture; one that names `tap` and `slide` by default.
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
/// author : Author, optional
///     Whose model the textures were compiled with; the embedded one by default.
///
/// Returns
/// -------
/// Texture
///
/// Raises
/// ------
/// AsperityError
///     For a texture without a latent, or with one of another model.
#[pyfunction]
#[pyo3(
    signature = (*, tap, slide, friction=None, name=None, preview=Preview::Usual, author=None),
    text_signature = "(*, tap, slide, friction=None, name=None, preview=True, author=None)"
)]
pub(crate) fn compose(
    py: Python<'_>,
    tap: &Bound<'_, Texture>,
    slide: &Bound<'_, Texture>,
    friction: Option<&Bound<'_, Texture>>,
    name: Option<String>,
    preview: Preview,
    author: Option<&Bound<'_, PromptCompiler>>,
) -> PyResult<Texture> {
    let (tap, slide, friction) = (tap.get(), slide.get(), friction.unwrap_or(slide).get());
    let mixing = Mixing {
        name,
        preview,
        author,
    };
    mixing.mixed(py, |editor, options| {
        let [tap, slide, friction] = [tap, slide, friction].map(|texture| texture.contents.asset());
        Ok(editor.compose(&tap?, &slide?, Some(&friction?), options)?)
    })
}

/// Encodes a recorded or imported texture with the learned model, so that it can be mixed and edited.
///
/// The result is decoded from the latent and equals that of ``asperity encode``; its report states
/// how far the decoded spectra are from the recorded ones. Other threads run meanwhile.
///
/// Parameters
/// ----------
/// texture : Texture
///     The recording.
/// part : {"whole", "taps", "slide"}, optional
///     What is encoded; what was recorded by default, which excludes synthesised taps.
/// name : str, optional
///     Name of the texture; that of the recording by default.
/// preview : bool or int, default True
///     Whether the asset holds a preview, or its width and height in pixels.
/// author : Author, optional
///     Whose model encodes it; the embedded one by default.
///
/// Returns
/// -------
/// Texture
///
/// Raises
/// ------
/// AsperityError
///     For a part that the texture does not have.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> grit = asperity.encode(asperity.builtin())
/// >>> grit.report["part"]
/// 'slide'
#[pyfunction]
#[pyo3(
    signature = (texture, part=None, *, name=None, preview=Preview::Usual, author=None),
    text_signature = "(texture, part=None, *, name=None, preview=True, author=None)"
)]
pub(crate) fn encode(
    py: Python<'_>,
    texture: &Bound<'_, Texture>,
    part: Option<&str>,
    name: Option<String>,
    preview: Preview,
    author: Option<&Bound<'_, PromptCompiler>>,
) -> PyResult<Texture> {
    let parsed = |text: &str| {
        text.parse::<Part>().map_err(|rule| {
            let message = format!("part = {text:?}: not {rule}");
            Failure::usage(message, "leave it out for what was recorded")
        })
    };
    let part = part.map(parsed).transpose()?;
    let texture = texture.get();
    let mixing = Mixing {
        name,
        preview,
        author,
    };
    mixing.mixed(py, |editor, options| {
        Ok(editor.encoded(&texture.contents.asset()?, part, options)?)
    })
}

/// Steps of the sliders, each in its range.
pub(crate) fn sliders(steps: [(&str, f64); 4]) -> Result<Sliders, Failure> {
    let range = -Sliders::LARGEST..=Sliders::LARGEST;
    for (name, steps) in steps {
        within(name, steps, &range)?;
    }
    let [rougher, sharper, harder, slipperier] = steps.map(|(_, steps)| steps);
    Ok(Sliders {
        rougher,
        sharper,
        harder,
        slipperier,
    })
}

impl Mixing<'_, '_> {
    /// A texture after an edit, or before its last one.
    pub(crate) fn changed(
        self,
        py: Python<'_>,
        texture: &Texture,
        edit: Option<&Edit>,
    ) -> PyResult<Texture> {
        if edit.is_some_and(Edit::is_still) {
            return Err(Failure::from(nothing_asked()).into());
        }
        self.mixed(py, |editor, options| {
            Ok(editor.change(&texture.contents.asset()?, edit, options)?)
        })
    }

    /// The texture of a mixture.
    fn mixed(
        self,
        py: Python<'_>,
        mix: impl FnOnce(&LatentEditor<'_>, &MixOptions) -> Result<Mix, Failure> + Send,
    ) -> PyResult<Texture> {
        let options = MixOptions {
            name: self.name,
            preview: match self.preview {
                Preview::Usual => MixPreview::Kept,
                Preview::None => MixPreview::None,
                Preview::Size(px) => MixPreview::Size(px),
            },
        };
        let own = self.author.map(|author| author.get());
        let (compiled, report) = py.detach(|| {
            options.name.as_deref().map_or(Ok(()), check_name)?;
            let shared;
            let prompt_compiler = match own {
                Some(own) => &own.compiler,
                None => {
                    shared = author::shared()?;
                    &*shared
                }
            };
            let editor = LatentEditor::new(prompt_compiler);
            let mix = mix(&editor, &options)?;
            let tools = Tools {
                clock: Clock(now),
                ..Tools::of(prompt_compiler)
            };
            let compiled = driver::compile(&mix.source, &mix.request, &tools);
            let mut compiled = compiled.map_err(error::stopped)?;
            let report = mix.report(&editor, &compiled);
            compiled.warnings.extend(report.warnings);
            Ok::<_, Failure>((compiled, report.json))
        })?;
        author::texture(py, compiled, &report)
    }
}
