//! Errors of requests: a status, and the texts of the command.

use crate::http::Status;
use asperity_io::diagnostic::{Diagnostic, texts};
use serde::Serialize;

/// A request that failed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ApiError {
    /// The status of the answer.
    pub(crate) status: Status,
    /// The problem.
    pub(crate) error: String,
    /// The remedy.
    pub(crate) help: Option<String>,
}

/// The body of such an answer.
#[derive(Serialize)]
struct Body<'a> {
    error: &'a str,
    help: Option<&'a str>,
}

impl ApiError {
    pub(crate) fn new(status: Status, error: impl Into<String>, help: &str) -> Self {
        Self {
            status,
            error: error.into(),
            help: Some(help.to_owned()),
        }
    }

    /// A failure of the compiler in the command's words: 400 where the request was wrong, 422 where what it holds is.
    pub(crate) fn of(failure: &dyn Diagnostic) -> Self {
        let (error, help) = texts(failure);
        Self {
            status: if failure.is_usage() {
                Status::BadRequest
            } else {
                Status::Unprocessable
            },
            error,
            help: Some(help),
        }
    }

    /// An error that only a bug can cause.
    pub(crate) fn panicked() -> Self {
        Self::new(
            Status::Internal,
            "the server failed at this request",
            "please report what you did, with what the terminal shows",
        )
    }

    /// The body of the answer.
    pub(crate) fn json(&self) -> Vec<u8> {
        let body = Body {
            error: &self.error,
            help: self.help.as_deref(),
        };
        // Two texts always serialise.
        serde_json::to_vec(&body).unwrap_or_default()
    }
}

/// Returns the error of a request with a bad file: the request itself is valid.
pub(crate) fn refused(error: &dyn Diagnostic) -> ApiError {
    ApiError {
        status: Status::Unprocessable,
        ..ApiError::of(error)
    }
}
