//! Configurations in JSON.

use crate::error::Problem;
use serde::de::DeserializeOwned;

/// Reads a configuration; keys that are not asked for are skipped.
pub(crate) fn parse<T: DeserializeOwned>(text: &str) -> Result<T, Problem> {
    let mut reader = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let path = error.path().to_string();
        let inner = error.into_inner();
        Problem::Json(match path.as_str() {
            "." => inner.to_string(),
            _ => format!("`{path}`: {inner}"),
        })
    })
}
