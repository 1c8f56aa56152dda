//! The measured certainty into the model that it was measured of.

use super::{EvaluateError, held_out::HeldOut};
use asperity::{
    learned::{ModelError, description::ModelDescription},
    output::write_atomic,
};
use std::path::Path;

/// Replaces the certainty curve in `model.json` by that of held-out families.
///
/// # Errors
/// [`EvaluateError::Model`] for a folder that is no model, [`EvaluateError::Output`]; the
/// file is then as it was.
pub fn calibrate(model: &Path, measured: &HeldOut) -> Result<(), EvaluateError> {
    const FILE: &str = "model.json";
    let path = model.join(FILE);
    let text = std::fs::read_to_string(&path).map_err(|source| ModelError::Unreadable {
        path: path.clone(),
        source,
    })?;
    let mut description: ModelDescription =
        serde_json::from_str(&text).map_err(|error| ModelError::Description {
            file: FILE.into(),
            message: error.to_string(),
        })?;
    description.certainty = measured.certainty.clone();
    let mut json = serde_json::to_vec(&description).map_err(|error| EvaluateError::Encode {
        file: FILE.into(),
        message: error.to_string(),
    })?;
    json.push(b'\n');
    Ok(write_atomic(&path, &json)?)
}
