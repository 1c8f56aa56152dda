//! Requests in JSON: which fields they have, and within which bounds.

use crate::{error::ApiError, http::Status, making, studio::Studio, texture::Texture};
use asperity::sources::latents::{AXES, Axis, Edit as LatentEdit, Sliders};
use serde::{Deserialize, de::DeserializeOwned};
use std::sync::Arc;

/// Bytes of a request.
pub(super) const JSON_BYTES: u64 = 64 << 10;

/// `POST api/compile`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Compile {
    prompt: String,
    #[serde(default)]
    seed: u64,
}

/// `POST api/edit`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Edit {
    texture: String,
    steps: Option<Sliders>,
    words: Option<String>,
    #[serde(default)]
    draft: bool,
}

/// `POST api/blend`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Blend {
    a: String,
    b: String,
    t: f64,
    #[serde(default)]
    draft: bool,
}

/// `POST api/compose`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Compose {
    tap: String,
    slide: String,
    friction: String,
}

/// `POST api/encode`, `POST api/device/play`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct One {
    texture: String,
}

/// A handler that answers the bytes of a request with a texture.
pub(super) type Make = fn(&Studio, &[u8]) -> Result<Arc<Texture>, ApiError>;

/// Such an address, by its path.
pub(super) fn make(path: &str) -> Option<Make> {
    Some(match path {
        "api/compile" => compile,
        "api/edit" => edit,
        "api/blend" => blend,
        "api/compose" => compose,
        "api/encode" => encode,
        _ => return None,
    })
}

fn compile(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    let expected = "{\"prompt\": TEXT, \"seed\": NUMBER}, in UTF-8; the seed may be left out";
    let Compile { prompt, seed } = parsed(bytes, expected)?;
    studio.compile(&prompt, seed)
}

fn edit(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    const EXPECTED: &str = "{\"texture\": ID, \"steps\": {\"rougher\": NUMBER, …}} with rougher, sharper, harder, \
         slipperier, or {\"texture\": ID, \"words\": TEXT}; \"draft\": true leaves the picture out";
    let request: Edit = parsed(bytes, EXPECTED)?;
    let asked = match (request.steps, request.words) {
        (Some(steps), None) => LatentEdit::Steps(within(steps)?),
        (None, Some(words)) => LatentEdit::Words(words),
        (Some(_), Some(_)) => return Err(unexpected("it has both steps and words", EXPECTED)),
        (None, None) => return Err(unexpected("it has neither steps nor words", EXPECTED)),
    };
    let texture = studio.texture(&request.texture)?;
    studio.make(request.draft, |loaded| {
        making::edit(loaded, &texture, asked, request.draft)
    })
}

fn blend(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    const EXPECTED: &str =
        "{\"a\": ID, \"b\": ID, \"t\": NUMBER}; \"draft\": true leaves the picture out";
    let Blend { a, b, t, draft } = parsed(bytes, EXPECTED)?;
    if !(0.0..=1.0).contains(&t) {
        return Err(out_of_bounds("t", t, "from 0 to 1"));
    }
    let (a, b) = (studio.texture(&a)?, studio.texture(&b)?);
    // No command line takes −0.
    studio.make(draft, |loaded| {
        making::blend(loaded, [&a, &b], t + 0.0, draft)
    })
}

fn compose(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    let expected = "{\"tap\": ID, \"slide\": ID, \"friction\": ID}";
    let request: Compose = parsed(bytes, expected)?;
    let tap = studio.texture(&request.tap)?;
    let slide = studio.texture(&request.slide)?;
    let friction = studio.texture(&request.friction)?;
    studio.make(false, |loaded| {
        making::compose(loaded, [&tap, &slide, &friction])
    })
}

fn encode(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    let texture = studio.texture(&texture(bytes)?)?;
    studio.make(false, |loaded| making::encode(loaded, &texture))
}

/// The name of the texture that a request is about.
pub(super) fn texture(bytes: &[u8]) -> Result<String, ApiError> {
    let One { texture } = parsed(bytes, "{\"texture\": ID}")?;
    Ok(texture)
}

/// A request in JSON.
pub(super) fn parsed<T: DeserializeOwned>(bytes: &[u8], expected: &str) -> Result<T, ApiError> {
    serde_json::from_slice(bytes).map_err(|error| unexpected(&error.to_string(), expected))
}

fn unexpected(why: &str, expected: &str) -> ApiError {
    let error = format!("the request is not as expected: {why}");
    ApiError::new(Status::BadRequest, error, &format!("send {expected}"))
}

/// Steps that the command takes.
fn within(steps: Sliders) -> Result<Sliders, ApiError> {
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
        None => Ok(steps),
    }
}

fn out_of_bounds(field: &str, value: f64, bounds: &str) -> ApiError {
    let error = format!("{field} is {value}");
    ApiError::new(
        Status::BadRequest,
        error,
        &format!("give a number {bounds}"),
    )
}
