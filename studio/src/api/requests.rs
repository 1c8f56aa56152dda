//! Requests in JSON: which fields they have, and within which bounds.

use crate::{
    error::ApiError,
    http::Status,
    recipe::{Link, Operation},
    studio::Studio,
    texture::Texture,
};
use asperity::sources::latents::{Edit as LatentEdit, Sliders};
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::json;
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

/// `POST api/link`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Linked {
    link: String,
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
    studio.perform(Operation::Compile { prompt, seed })
}

fn edit(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    const EXPECTED: &str = "{\"texture\": ID, \"steps\": {\"rougher\": NUMBER, …}} with rougher, sharper, harder, \
         slipperier, or {\"texture\": ID, \"words\": TEXT}; \"draft\": true leaves the picture out";
    let Edit {
        texture,
        steps,
        words,
        draft,
    } = parsed(bytes, EXPECTED)?;
    let edit = match (steps, words) {
        (Some(steps), None) => LatentEdit::Steps(steps),
        (None, Some(words)) => LatentEdit::Words(words),
        (Some(_), Some(_)) => return Err(unexpected("it has both steps and words", EXPECTED)),
        (None, None) => return Err(unexpected("it has neither steps nor words", EXPECTED)),
    };
    studio.perform(Operation::Edit {
        texture,
        edit,
        draft,
    })
}

fn blend(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    const EXPECTED: &str =
        "{\"a\": ID, \"b\": ID, \"t\": NUMBER}; \"draft\": true leaves the picture out";
    let Blend { a, b, t, draft } = parsed(bytes, EXPECTED)?;
    studio.perform(Operation::Blend { a, b, t, draft })
}

fn compose(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    let Compose {
        tap,
        slide,
        friction,
    } = parsed(bytes, "{\"tap\": ID, \"slide\": ID, \"friction\": ID}")?;
    studio.perform(Operation::Compose {
        tap,
        slide,
        friction,
    })
}

fn encode(studio: &Studio, bytes: &[u8]) -> Result<Arc<Texture>, ApiError> {
    let texture = texture(bytes)?;
    studio.perform(Operation::Encode { texture })
}

/// What a link leads to: `{texture, base, steps, same}`, where steps of the sliders lead from the base to the texture, if
/// they are the last operation, and `same` tells whether the bytes are those that the link was written for.
pub(super) fn link(studio: &Studio, bytes: &[u8]) -> Result<String, ApiError> {
    let Linked { link } = parsed(bytes, "{\"link\": TEXT}")?;
    let link = Link::parse(&link)?;
    let made = studio.follow(&link)?;
    let (texture, before) = (&made[made.len() - 1], link.steps.last());
    let stepped = match before {
        Some(Operation::Edit {
            texture,
            edit: LatentEdit::Steps(steps),
            ..
        }) => Some((&made[Link::place(made.len() - 1, texture)?], steps)),
        _ => None,
    };
    let base = stepped.map_or_else(|| "null".to_owned(), |(base, _)| studio.shown(base));
    let steps = json!(stepped.map(|(_, steps)| steps));
    let same = texture.id() == link.id;
    let shown = studio.shown(texture);
    Ok(format!(
        "{{\"texture\":{shown},\"base\":{base},\"steps\":{steps},\"same\":{same}}}"
    ))
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
