//! Textures as the commands `compile`, `edit`, `blend`, `compose` and `encode` make them, without options of theirs that
//! are not stated here.

use crate::{
    error::ApiError,
    http::Status,
    prompts::Loaded,
    recipe::Operation,
    texture::{Making, Texture, damaged},
};
use asperity::{
    driver,
    pipeline::{Clock, Request},
    sources::{
        Tools,
        latents::{AXES, Axis, Edit, LatentEditor, Mix, MixOptions, MixPreview, Sliders, explain},
        prompt::{self, Options, Prompt, PromptCompiler},
    },
};
use asperity_io::clock::now;
use std::sync::Arc;

/// Performs an operation on the textures that it takes, in their order.
///
/// # Errors
/// As the command, for numbers out of bounds, and for what names a file.
pub(crate) fn perform(
    loaded: &Loaded,
    operation: &Operation,
    others: &[Arc<Texture>],
) -> Result<Texture, ApiError> {
    match (operation, others) {
        (Operation::Compile { prompt, seed }, []) => compile(loaded, prompt, *seed),
        (
            Operation::Edit {
                edit: asked, draft, ..
            },
            [texture],
        ) => edit(loaded, texture, within(asked.clone())?, *draft),
        (Operation::Blend { t, .. }, _) if !(0.0..=1.0).contains(t) => {
            Err(out_of_bounds("t", *t, "from 0 to 1"))
        }
        // No command line takes −0.
        (Operation::Blend { t, draft, .. }, [a, b]) => blend(loaded, [a, b], t + 0.0, *draft),
        (Operation::Compose { .. }, [tap, slide, friction]) => {
            compose(loaded, [tap, slide, friction])
        }
        (Operation::Encode { .. }, [texture]) => encode(loaded, texture),
        _ => {
            let error = "this names a file, which is not here";
            Err(ApiError::new(Status::BadRequest, error, "open the file"))
        }
    }
}

/// Steps that the command takes.
fn within(edit: Edit) -> Result<Edit, ApiError> {
    let Edit::Steps(steps) = &edit else {
        return Ok(edit);
    };
    let largest = Sliders::LARGEST;
    let beyond = |axis: &Axis| !(-largest..=largest).contains(&steps.along(*axis));
    match AXES.into_iter().find(beyond) {
        Some(axis) => {
            let field = match axis {
                Axis::Rough => "steps.rougher",
                Axis::Sharp => "steps.sharper",
                Axis::Hard => "steps.harder",
                Axis::Slippery => "steps.slipperier",
            };
            let bounds = format!("from {} to {largest}", -largest);
            Err(out_of_bounds(field, steps.along(axis), &bounds))
        }
        None => Ok(edit),
    }
}

fn out_of_bounds(field: &str, value: f64, bounds: &str) -> ApiError {
    let error = format!("{field} is {value}");
    let help = format!("give a number {bounds}");
    ApiError::new(Status::BadRequest, error, &help)
}

/// Compiles a prompt, as `asperity compile`.
fn compile(loaded: &Loaded, text: &str, seed: u64) -> Result<Texture, ApiError> {
    prompt::check(text).map_err(|e| ApiError::of(&e))?;
    let request: Request = Options::default().request;
    let source = Prompt {
        text: text.to_owned(),
        seed,
        picture: None,
    };
    let compiled = driver::compile(&source, &request, &tools(&loaded.compiler))
        .map_err(|failure| ApiError::of(failure.as_ref()))?;
    let explanation = explain(&loaded.editor(), text).map_err(|e| ApiError::of(&e))?;
    let mut report = compiled.json();
    explanation.add_to(&mut report);
    let making = Making {
        compiled: Some(report),
        ..Making::default()
    };
    let prompt = text.to_owned();
    let operation = |_: &str| Operation::Compile { prompt, seed };
    Texture::new(compiled.lowered.bytes, making, operation).map_err(damaged)
}

/// A draft has no picture, as with `--no-preview`: drawing one takes longer than all else, and what is felt and verified
/// is the same.
fn options(draft: bool) -> MixOptions {
    MixOptions {
        preview: if draft {
            MixPreview::None
        } else {
            MixPreview::Kept
        },
        ..MixOptions::default()
    }
}

/// Edits a texture, as `asperity edit`.
fn edit(loaded: &Loaded, texture: &Texture, edit: Edit, draft: bool) -> Result<Texture, ApiError> {
    let editor = loaded.editor();
    let asset = texture.parsed()?;
    let mix = editor
        .change(&asset, Some(&edit), &options(draft))
        .map_err(|e| ApiError::of(&e))?;
    let operation = Operation::Edit {
        texture: texture.id().to_owned(),
        edit,
        draft,
    };
    mixed(&editor, mix, &[texture], operation)
}

/// A texture between two, as `asperity blend`.
fn blend(loaded: &Loaded, [a, b]: [&Texture; 2], t: f64, draft: bool) -> Result<Texture, ApiError> {
    let editor = loaded.editor();
    let mix = editor
        .blend(&a.parsed()?, &b.parsed()?, t, &options(draft))
        .map_err(|e| ApiError::of(&e))?;
    let operation = Operation::Blend {
        a: a.id().to_owned(),
        b: b.id().to_owned(),
        t,
        draft,
    };
    mixed(&editor, mix, &[a, b], operation)
}

/// A texture that taps, slides and rubs like these, as `asperity compose`.
fn compose(loaded: &Loaded, [tap, slide, friction]: [&Texture; 3]) -> Result<Texture, ApiError> {
    let editor = loaded.editor();
    let rubbed = friction.parsed()?;
    let mix = editor
        .compose(
            &tap.parsed()?,
            &slide.parsed()?,
            Some(&rubbed),
            &MixOptions::default(),
        )
        .map_err(|e| ApiError::of(&e))?;
    let operation = Operation::Compose {
        tap: tap.id().to_owned(),
        slide: slide.id().to_owned(),
        friction: friction.id().to_owned(),
    };
    mixed(&editor, mix, &[tap, slide, friction], operation)
}

/// The texture that the latent of a recording decodes to, as `asperity encode`.
fn encode(loaded: &Loaded, texture: &Texture) -> Result<Texture, ApiError> {
    let editor = loaded.editor();
    let mix = editor
        .encoded(&texture.parsed()?, None, &MixOptions::default())
        .map_err(|e| ApiError::of(&e))?;
    let operation = Operation::Encode {
        texture: texture.id().to_owned(),
    };
    mixed(&editor, mix, &[texture], operation)
}

/// Compiles a mixture, with the report of the command.
fn mixed(
    editor: &LatentEditor<'_>,
    mix: Mix,
    others: &[&Texture],
    operation: Operation,
) -> Result<Texture, ApiError> {
    let compiled = driver::compile(&mix.source, &mix.request, &tools(editor.prompt_compiler()))
        .map_err(|failure| ApiError::of(failure.as_ref()))?;
    let report = mix.report(editor, &compiled);
    let making = Making {
        made: Some(report.json),
        others,
        ..Making::default()
    };
    Texture::new(compiled.lowered.bytes, making, |_| operation).map_err(damaged)
}

fn tools(compiler: &PromptCompiler) -> Tools<'_> {
    Tools {
        clock: Clock(now),
        ..Tools::of(compiler)
    }
}
