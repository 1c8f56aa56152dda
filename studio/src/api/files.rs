//! Files of textures, files that are opened, and libraries that are packed.

use super::{nothing_here, requests::parsed};
use crate::{
    about::Library,
    download::Download,
    error::ApiError,
    folder::Folder,
    http::{Answer, Body, Content, Head, Keep, Status},
    packing,
    studio::{OpenedFile, Studio},
};
use asperity::sources::surface::KEYS;
use serde::Deserialize;
use serde_json::json;

/// Bytes of a file that is opened.
const FILE_BYTES: u64 = 64 << 20;
/// Bytes of the name of a file, as systems have them.
const NAME_BYTES: usize = 255;

/// Bytes of the request for a library: thousands of names.
const PACK_BYTES: u64 = 1 << 20;

/// `POST api/pack`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Pack {
    textures: Vec<Packed>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Packed {
    texture: String,
    name: String,
}

/// Opens a file, or the files of a folder: `{texture}` or `{library}`.
pub(super) fn open(
    studio: &Studio,
    head: &Head,
    body: &mut Body<'_, '_>,
    is_folder: bool,
) -> Result<Answer, ApiError> {
    let name = file_name(&head.target)?;
    let stated = |key| Some((key, decoded(queried(&head.target, key)?)?));
    let stated: Vec<_> = KEYS.into_iter().filter_map(stated).collect();
    let kept = studio.send(|| {
        let bytes = body.read(FILE_BYTES)?;
        if is_folder {
            studio.open_folder(&Folder::parse(&name, &bytes)?, &stated)
        } else {
            studio.open(&name, bytes, &stated)
        }
    })?;
    Ok(Answer::json(match kept {
        OpenedFile::Texture(texture) => format!("{{\"texture\":{}}}", studio.shown(&texture)),
        OpenedFile::Library(named) => json!({ "library": Library::of(&named) }).to_string(),
    }))
}

/// What the page shows of a texture, `ID.page.json`, or a file of it, `ID.ENDING`.
pub(super) fn download(studio: &Studio, file: &str) -> Result<Answer, ApiError> {
    let (id, ending) = file.split_once('.').ok_or_else(nothing_here)?;
    if ending == "page.json" {
        return Ok(Answer::json(studio.shown(&*studio.texture(id)?)));
    }
    let download = Download::of(ending).ok_or_else(nothing_here)?;
    let texture = studio.texture(id)?;
    let bytes = studio.compute(|| download.bytes(&texture))?;
    Ok(Answer::new(
        download.content_type(),
        Content::Shared(bytes),
        Keep::Forever,
    ))
}

/// Packs a library.
pub(super) fn pack(studio: &Studio, body: &mut Body<'_, '_>) -> Result<Answer, ApiError> {
    let bytes = body.read(PACK_BYTES)?;
    let expected = "{\"textures\": [{\"texture\": ID, \"name\": TEXT}, …]}";
    let Pack { textures } = parsed(&bytes, expected)?;
    let mut named = Vec::with_capacity(textures.len());
    for Packed { texture, name } in textures {
        named.push((name, studio.texture(&texture)?));
    }
    let bytes = studio.compute(|| packing::pack(&named))?;
    let content = Content::Owned(bytes);
    Ok(Answer::new("application/octet-stream", content, Keep::No))
}

/// The value of a key in the query, still encoded.
pub(crate) fn queried<'a>(target: &'a str, key: &str) -> Option<&'a str> {
    let (_, query) = target.split_once('?')?;
    let mut pairs = query.split('&').filter_map(|pair| pair.split_once('='));
    pairs.find_map(|(found, value)| (found == key).then_some(value))
}

/// The name of the file that is opened, which errors repeat: `name` of the query.
fn file_name(target: &str) -> Result<String, ApiError> {
    let named = queried(target, "name").unwrap_or("asset.asp");
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
