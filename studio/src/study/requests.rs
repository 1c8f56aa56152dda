//! The interface between a participant's page and the study.

use super::{answers::Answered, host::StudyHost};
use crate::{
    api::queried,
    device,
    error::ApiError,
    http::{Answer, Body, Content, Head, Keep, Method, Status},
    page,
};
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::{Value, json};

/// Bytes of an answer, and of a part of a log: twenty seconds.
const JSON_BYTES: u64 = 256 << 10;
const LOG_BYTES: u64 = 4 << 20;

/// `POST api/join`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Join {
    me: Option<String>,
}

/// `POST api/try`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Try {
    index: usize,
    prompt: String,
}

/// Answers a request for a path below the study's address.
///
/// # Errors
/// [`ApiError`] for a path that nothing answers, and for what cannot be answered.
pub(crate) fn answer(
    host: &StudyHost,
    head: &Head,
    path: &str,
    body: &mut Body<'_, '_>,
) -> Result<Answer, ApiError> {
    let reads = matches!(head.method, Method::Get | Method::Head);
    let me = || queried(&head.target, "me").unwrap_or_default();
    if reads {
        if let Some(file) = page::study_file(path) {
            return Ok(Answer::new(
                file.content_type,
                Content::Static(file.bytes),
                Keep::No,
            ));
        }
        if let Some(address) = path.strip_prefix("api/stimulus/") {
            let (content_type, bytes) = host.stimulus(address)?;
            return Ok(Answer::new(content_type, Content::Shared(bytes), Keep::No));
        }
        return match path {
            "api/step" => Ok(Answer::json(host.step(me())?.to_string())),
            "api/device/ticks" => {
                let ticks = device::requests::ticks(host.device(), &head.target)?;
                Ok(Answer::json(blind(&ticks.into_bytes())))
            }
            _ => Err(nothing_here()),
        };
    }
    if head.method != Method::Post {
        return Ok(Answer::only("GET, HEAD, POST"));
    }
    match path {
        "api/join" => {
            let Join { me } = parsed(body)?;
            return Ok(Answer::json(host.join(me.as_deref())?.to_string()));
        }
        "api/try" => {
            let Try { index, prompt } = parsed(body)?;
            return Ok(Answer::json(
                host.try_prompt(me(), index, &prompt)?.to_string(),
            ));
        }
        "api/log" => {
            let number = |key| queried(&head.target, key).and_then(|text| text.parse().ok());
            let (Some(index), Some(first)) = (number("index"), number("first")) else {
                return Err(nothing_here());
            };
            host.log(me(), index, first, &body.read(LOG_BYTES)?)?;
        }
        "api/answer" => host.answer(me(), &parsed::<Answered>(body)?)?,
        "api/withdraw" => host.withdraw(me())?,
        _ => return Err(nothing_here()),
    }
    Ok(Answer::json("{}"))
}

/// The ticks of a device, without what names the texture that plays.
fn blind(ticks: &[u8]) -> Vec<u8> {
    let mut ticks: Value = serde_json::from_slice(ticks).unwrap_or_default();
    ticks["playing"] = json!("");
    ticks["said"] = json!([]);
    ticks.to_string().into_bytes()
}

fn parsed<T: DeserializeOwned>(body: &mut Body<'_, '_>) -> Result<T, ApiError> {
    serde_json::from_slice(&body.read(JSON_BYTES)?).map_err(|error| {
        let error = format!("the request is not what this address takes: {error}");
        ApiError::new(Status::BadRequest, error, "reload the page")
    })
}

fn nothing_here() -> ApiError {
    ApiError::new(
        Status::NotFound,
        "nothing has this address",
        "reload the page",
    )
}
