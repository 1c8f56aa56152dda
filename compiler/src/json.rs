//! JSON as a type, with the path of what is not of it.

use asperity_io::{diagnostic::Fault, input};
use serde::de::DeserializeOwned;

/// Parses a text that is one JSON value of a type.
pub(crate) fn parsed<T: DeserializeOwned>(text: &str, remedy: &str) -> Result<T, Fault> {
    let mut json = serde_json::Deserializer::from_str(text);
    let value = serde_path_to_error::deserialize(&mut json).map_err(|error| {
        // What cannot be parsed has no name within its object; a single dot is the file as a whole.
        let path = error.path().to_string();
        let field = path.trim_end_matches('?').trim_end_matches('.');
        Fault::new(input::json_fault(text, error.inner()), remedy).field(field)
    })?;
    json.end().map_err(|error| Fault::new(error, remedy))?;
    Ok(value)
}
