//! The page's requests to the device.

use super::LiveDevice;
use crate::{
    error::ApiError,
    http::{Answer, Status},
    texture::Texture,
};
use std::time::Duration;

/// Longest wait of a request for ticks. Shorter than the page's timeout for a server that does not answer.
const PATIENCE: Duration = Duration::from_millis(500);

/// `GET api/device/ticks?after=N`: what was published from N on, which is `next` of the answer before.
pub(crate) fn ticks(device: Option<&LiveDevice>, target: &str) -> Result<Answer, ApiError> {
    let device = device.ok_or_else(none)?;
    let query = target.split_once('?').map_or("", |(_, query)| query);
    let after = match query.strip_prefix("after=") {
        None if query.is_empty() => None,
        None => return Err(not_a_number()),
        Some(number) => Some(number.parse().map_err(|_| not_a_number())?),
    };
    Ok(Answer::json(device.news(after, PATIENCE)))
}

/// `POST api/device/play`: has a texture played.
pub(crate) fn play(device: Option<&LiveDevice>, texture: &Texture) -> Result<Answer, ApiError> {
    let device = device.ok_or_else(none)?;
    if !device.swaps() {
        return Err(ApiError::new(
            Status::Unprocessable,
            "the loop plays a scene, which takes no other texture",
            "start asperity-lab servo with a texture instead",
        ));
    }
    device.want(texture.name(), texture.asset());
    Ok(Answer::json("{}"))
}

fn none() -> ApiError {
    ApiError::new(
        Status::NotFound,
        "no device is behind this studio",
        "start asperity-lab servo with --studio",
    )
}

fn not_a_number() -> ApiError {
    ApiError::new(
        Status::BadRequest,
        "the query is not after=NUMBER",
        "reload the page",
    )
}
