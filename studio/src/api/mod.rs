//! The interface between page and server: which address answers what.

mod files;
mod libraries;
mod requests;

pub(crate) use files::queried;

use crate::{
    device,
    error::ApiError,
    http::{Answer, Body, Content, Head, Keep, Method, Status},
    page,
    project::STATE_BYTES,
    studio::Studio,
};
use serde_json::json;

/// Answers a request for a path below the page's address.
///
/// # Errors
/// [`ApiError`] for a path that nothing answers, and for what cannot be answered.
pub(crate) fn answer(
    studio: &Studio,
    head: &Head,
    path: &str,
    body: &mut Body<'_, '_>,
) -> Result<Answer, ApiError> {
    let reads = matches!(head.method, Method::Get | Method::Head);
    let posts = head.method == Method::Post;
    if let Some(file) = page::file(path) {
        return Ok(if reads {
            Answer::new(file.content_type, Content::Static(file.bytes), Keep::No)
        } else {
            Answer::only("GET, HEAD")
        });
    }
    if let Some(make) = requests::make(path) {
        if !posts {
            return Ok(Answer::only("POST"));
        }
        let texture = make(studio, &body.read(requests::JSON_BYTES)?)?;
        return Ok(Answer::json(studio.shown(&texture)));
    }
    if let Some(below) = path.strip_prefix("api/library/") {
        return libraries::answer(studio, below, reads);
    }
    if let Some(below) = path.strip_prefix("api/difference/") {
        return libraries::difference(studio, below, reads);
    }
    match path {
        "api/about.json" if reads => Ok(Answer::json(studio.about())),
        "api/about.json" => Ok(Answer::only("GET, HEAD")),
        "api/batch.json" if reads => Ok(Answer::json(json!(studio.batch().progress()).to_string())),
        "api/batch.json" if posts => {
            studio.batch().stop();
            Ok(Answer::json("{}"))
        }
        "api/batch.json" => Ok(Answer::only("GET, HEAD, POST")),
        "api/project.json" if reads => {
            let page = files::queried(&head.target, "page").unwrap_or_default();
            Ok(Answer::json(studio.project()?.state(page)?))
        }
        "api/project.json" if posts => {
            let page = files::queried(&head.target, "page").unwrap_or_default();
            studio.save(page, &body.read(STATE_BYTES)?)?;
            Ok(Answer::json("{}"))
        }
        "api/project.json" => Ok(Answer::only("GET, HEAD, POST")),
        "api/link" if posts => {
            let found = requests::link(studio, &body.read(requests::JSON_BYTES)?)?;
            Ok(Answer::json(found))
        }
        "api/folder" if posts => files::open(studio, head, body, true),
        "api/open" if posts => files::open(studio, head, body, false),
        "api/pack" if posts => files::pack(studio, body),
        "api/device/ticks" if reads => device::requests::ticks(studio.device(), &head.target),
        "api/device/ticks" => Ok(Answer::only("GET, HEAD")),
        "api/device/play" if posts => play(studio, body),
        "api/link" | "api/folder" | "api/open" | "api/pack" | "api/device/play" => {
            Ok(Answer::only("POST"))
        }
        _ => match path.strip_prefix("api/texture/") {
            Some(file) if reads => files::download(studio, file),
            Some(_) => Ok(Answer::only("GET, HEAD")),
            None => Err(nothing_here()),
        },
    }
}

fn play(studio: &Studio, body: &mut Body<'_, '_>) -> Result<Answer, ApiError> {
    let texture = studio.texture(&requests::texture(&body.read(requests::JSON_BYTES)?)?)?;
    device::requests::play(studio.device(), &texture)
}

fn nothing_here() -> ApiError {
    ApiError::new(
        Status::NotFound,
        "nothing has this address",
        "reload the page",
    )
}
