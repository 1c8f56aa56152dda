//! The interface between page and server: which address answers what.

mod requests;

use crate::{
    device,
    error::ApiError,
    http::{Answer, Body, Content, Head, Keep, Method, Status},
    page,
    studio::Studio,
    texture::Texture,
};
use std::sync::Arc;

/// Bytes of a request in JSON.
const JSON_BYTES: u64 = 64 << 10;
/// Bytes of an asset that is opened.
const ASSET_BYTES: u64 = 16 << 20;
/// Bytes of the name of a file, as systems have them.
const NAME_BYTES: usize = 255;

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
        let texture = make(studio, &body.read(JSON_BYTES)?)?;
        return Ok(Answer::json(studio.shown(&texture)));
    }
    match path {
        "api/about" if reads => Ok(Answer::json(studio.about())),
        "api/about" => Ok(Answer::only("GET, HEAD")),
        "api/open" if posts => open(studio, head, body),
        "api/device/ticks" if reads => device::requests::ticks(studio.device(), &head.target),
        "api/device/ticks" => Ok(Answer::only("GET, HEAD")),
        "api/device/play" if posts => play(studio, body),
        "api/device/play" => Ok(Answer::only("POST")),
        "api/open" => Ok(Answer::only("POST")),
        _ => match path.strip_prefix("api/texture/") {
            Some(file) if reads => texture(studio, file),
            Some(_) => Ok(Answer::only("GET, HEAD")),
            None => Err(nothing_here()),
        },
    }
}

fn open(studio: &Studio, head: &Head, body: &mut Body<'_, '_>) -> Result<Answer, ApiError> {
    let name = file_name(&head.target)?;
    let bytes = body.read(ASSET_BYTES)?;
    let texture = studio.open(&name, bytes)?;
    Ok(Answer::json(studio.shown(&texture)))
}

fn play(studio: &Studio, body: &mut Body<'_, '_>) -> Result<Answer, ApiError> {
    let texture = studio.texture(&requests::texture(&body.read(JSON_BYTES)?)?)?;
    device::requests::play(studio.device(), &texture)
}

/// A file of a texture: `ID.ENDING`.
fn texture(studio: &Studio, file: &str) -> Result<Answer, ApiError> {
    let (id, ending) = file.split_once('.').ok_or_else(nothing_here)?;
    let content: fn(&Texture) -> Result<Arc<[u8]>, ApiError> = match ending {
        "asp" => |texture| Ok(Arc::clone(texture.asset())),
        "worklet.asp" => Texture::worklet,
        "png" => |texture| Ok(texture.pictures()?.color),
        "normal.png" => |texture| Ok(texture.pictures()?.normal),
        "height.png" => |texture| Ok(texture.pictures()?.height),
        "json" => |texture| Ok(texture.inspected().into_bytes().into()),
        _ => return Err(nothing_here()),
    };
    let content_type = match ending.rsplit('.').next() {
        Some("png") => "image/png",
        Some("json") => "application/json",
        _ => "application/octet-stream",
    };
    let texture = studio.texture(id)?;
    let bytes = studio.compute(|| content(&texture))?;
    Ok(Answer::new(
        content_type,
        Content::Shared(bytes),
        Keep::Forever,
    ))
}

fn nothing_here() -> ApiError {
    ApiError::new(
        Status::NotFound,
        "nothing has this address",
        "reload the page",
    )
}

/// The name of the file that is opened, which errors repeat: `name` of the query.
fn file_name(target: &str) -> Result<String, ApiError> {
    let query = target.split_once('?').map_or("", |(_, query)| query);
    let named = query
        .split('&')
        .find_map(|pair| pair.strip_prefix("name="))
        .unwrap_or("asset.asp");
    let name = decoded(named).filter(|name| (1..=NAME_BYTES).contains(&name.len()));
    name.ok_or_else(|| {
        ApiError::new(
            Status::BadRequest,
            format!("the name of the file is not 1 to {NAME_BYTES} bytes of UTF-8"),
            "give another one: api/open?name=FILE",
        )
    })
}

/// A text of a query: `%` and two digits are a byte, `+` a space. `None` for what is no UTF-8 then.
fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        bytes.push(match byte {
            b'+' => b' ',
            b'%' => {
                let (digits, after) = rest.split_at_checked(2)?;
                rest = after;
                let digit = |place: usize| char::from(digits[place]).to_digit(16);
                (digit(0)? * 16 + digit(1)?) as u8
            }
            byte => byte,
        });
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_decoded_once_and_as_utf8() {
        for (query, name) in [
            ("", Some("asset.asp")),
            ("?x=1&name=wet%20ice.asp", Some("wet ice.asp")),
            ("?name=wet+ice.asp", Some("wet ice.asp")),
            ("?name=%252e", Some("%2e")),
            ("?name=K%C3%A4se.asp", Some("Käse.asp")),
            ("?name=%C3", None),
            ("?name=%+1", None),
            ("?name=%4", None),
            ("?name=", None),
        ] {
            let found = file_name(&format!("/api/open{query}")).ok();
            assert_eq!(found.as_deref(), name, "{query}");
        }
        assert!(file_name(&format!("?name={}", "x".repeat(NAME_BYTES + 1))).is_err());
    }
}
