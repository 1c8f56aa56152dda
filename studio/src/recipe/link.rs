//! A recipe as a link: what is made of words alone, so that a page elsewhere makes the same bytes.

use super::{MOST, Operation, Recipe};
use crate::{error::ApiError, http::Status};
use base64::{Engine as _, engine::general_purpose::URL_SAFE_NO_PAD};
use serde::{Deserialize, Serialize};

/// Operations that lead to a texture, each after those that it takes textures of, which it names by their places: the
/// letters of base64url, of JSON.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Link {
    pub(crate) steps: Vec<Operation>,
    /// Identifier of the texture's bytes.
    pub(crate) id: String,
}

impl Recipe {
    /// The link of the texture; `None` where a file is part of it.
    pub(crate) fn link(&self) -> Option<String> {
        let place = |id: &str| {
            let at = self.0.iter().position(|step| step.id == id);
            at.map_or_else(String::new, |at| at.to_string())
        };
        if self.0.iter().any(|step| step.operation.opened().is_some()) {
            return None;
        }
        let link = Link {
            steps: self.0.iter().map(|step| step.operation.of(place)).collect(),
            id: self.0.last()?.id.clone(),
        };
        Some(URL_SAFE_NO_PAD.encode(serde_json::to_vec(&link).ok()?))
    }
}

impl Link {
    /// Reads a link.
    ///
    /// # Errors
    /// For what is none, and for one of no steps or very many.
    pub(crate) fn parse(text: &str) -> Result<Self, ApiError> {
        let bytes = URL_SAFE_NO_PAD.decode(text).ok();
        let link = bytes.and_then(|bytes| serde_json::from_slice::<Self>(&bytes).ok());
        let link = link.filter(|link| (1..=MOST).contains(&link.steps.len()));
        link.ok_or_else(|| {
            let error = "this link holds no recipe: it was cut short, or a later Asperity wrote it";
            ApiError::new(Status::BadRequest, error, "copy the whole link again")
        })
    }

    /// The place of a texture that the step at `at` takes.
    ///
    /// # Errors
    /// For one that is not made before.
    pub(crate) fn place(at: usize, name: &str) -> Result<usize, ApiError> {
        let place = name.parse().ok().filter(|place| *place < at);
        place.ok_or_else(|| {
            let error = format!("step {at} of this link takes a texture that is not made before");
            ApiError::new(Status::BadRequest, error, "copy the link again")
        })
    }
}
