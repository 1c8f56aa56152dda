//! From a file to a model that keeps to the limits of an asset.

use super::{
    check::model,
    schema::{Document, FORMAT, VERSION},
};
use crate::{json::parsed, sources::Tools};
use asperity_io::{
    diagnostic::Fault,
    input::{self, InputKind},
};
use asperity_texture::model::TextureModel;
use serde::Deserialize;
use serde_json::Value;
use std::path::Path;

/// Remedy for what is not JSON, or not of its type.
const WRONG_JSON: &str = "correct this place of the file: docs/model.md lists every key";

/// The model in a file, and the file's CRC-32.
///
/// # Errors
/// [`Fault`] with the field.
pub fn read(file: &Path) -> Result<(TextureModel, u32), Fault> {
    read_with(file, &Tools::default())
}

/// As [`read`], of a file that may have been given.
pub(super) fn read_with(file: &Path, tools: &Tools<'_>) -> Result<(TextureModel, u32), Fault> {
    let bytes = tools.file(file, InputKind::Model);
    let bytes = bytes.map_err(|problem| Fault::from(problem).at(file))?;
    let texture = from_json(&bytes).map_err(|fault| fault.at(file))?;
    Ok((texture, crc32fast::hash(&bytes)))
}

/// Fields common to all versions.
#[derive(Deserialize)]
struct Head {
    format: Option<Value>,
    version: Option<Value>,
}

/// The model that the bytes of a file describe; what they leave out is set to a default or
/// triangulated.
///
/// # Errors
/// [`Fault`] with the JSON path of the first field that is wrong.
pub fn from_json(bytes: &[u8]) -> Result<TextureModel, Fault> {
    let text = input::text(bytes)?;
    let text = &*input::lenient_json(text);
    let head: Head = parsed(text, WRONG_JSON)?;
    let stated = |value: Option<Value>| value.map_or("absent".into(), |value| value.to_string());
    if head.format != Some(FORMAT.into()) {
        let what = format!("{}, but {FORMAT:?} is expected", stated(head.format));
        let remedy = "give a model file, as `--emit-model` writes it: see docs/model.md";
        return Err(Fault::new(what, remedy).field("format"));
    }
    if head.version != Some(VERSION.into()) {
        let found = stated(head.version);
        let what = format!("{found}, but this program reads version {VERSION}");
        let remedy = format!("set \"version\": {VERSION}, or update asperity for a later one");
        return Err(Fault::new(what, remedy).field("version"));
    }
    model(parsed::<Document>(text, WRONG_JSON)?)
}
