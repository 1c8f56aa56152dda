//! From a file to a model that keeps to the limits of an asset.

use super::{
    check::model,
    error::{Fault, ModelFileError, ModelFileProblem},
    schema::{Document, FORMAT, VERSION},
};
use crate::sources::Tools;
use asperity_io::input::{self, Kind};
use asperity_texture::model::TextureModel;
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::Value;
use std::path::Path;

/// The model in a file, and the file's CRC-32.
///
/// # Errors
/// [`ModelFileError`] with the field at fault.
pub fn read(file: &Path) -> Result<(TextureModel, u32), ModelFileError> {
    read_with(file, &Tools::default())
}

/// As [`read`], of a file that may have been given.
pub(super) fn read_with(
    file: &Path,
    tools: &Tools<'_>,
) -> Result<(TextureModel, u32), ModelFileError> {
    let fail = |(field, problem)| ModelFileError {
        file: file.to_owned(),
        field,
        problem,
    };
    let bytes = tools.file(file, Kind::Model);
    let bytes = bytes.map_err(|e| fail((String::new(), e.into())))?;
    let texture = from_json(&bytes).map_err(fail)?;
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
/// The JSON path of the first field at fault, and what is wrong with it.
pub fn from_json(bytes: &[u8]) -> Result<TextureModel, (String, ModelFileProblem)> {
    let text = input::text(bytes).map_err(|e| (String::new(), e.into()))?;
    let text = &*input::lenient_json(text);
    let head: Head = parsed(text)?;
    let stated = |value: Option<Value>| value.map_or("absent".into(), |value| value.to_string());
    if head.format != Some(FORMAT.into()) {
        let found = stated(head.format);
        return Err(("format".into(), ModelFileProblem::Format { found }));
    }
    if head.version != Some(VERSION.into()) {
        let found = stated(head.version);
        return Err(("version".into(), ModelFileProblem::Version { found }));
    }
    model(parsed::<Document>(text)?)
}

/// JSON as a type, or the path of what is not of it.
fn parsed<T: DeserializeOwned>(text: &str) -> Result<T, Fault> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        // What cannot be parsed has no name within its object; a single dot is the file as a whole.
        let path = error.path().to_string();
        let field = path.trim_end_matches('?').trim_end_matches('.');
        let fault = input::json_fault(text, error.inner());
        (field.to_owned(), ModelFileProblem::Json(fault))
    })?;
    let trailing = |e: serde_json::Error| (String::new(), ModelFileProblem::Json(e.to_string()));
    json.end().map_err(trailing)?;
    Ok(value)
}
