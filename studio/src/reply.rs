//! The interface for those who ask within the program, without a server: the page's module of WebAssembly.

use crate::{
    api,
    http::{Answer, Body, Head, Method},
    studio::Studio,
};

/// An answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reply {
    /// Its status, as HTTP numbers it; what is not 200 has `{error, help}` as its body.
    pub status: u16,
    /// The type of the body.
    pub content_type: &'static str,
    /// The body.
    pub bytes: Vec<u8>,
}

impl Studio {
    /// Answers a request of the page, as the server does. `target` is the path below the page's address, with its query;
    /// a request with a body is a POST.
    #[must_use]
    pub fn reply(&self, target: &str, body: Option<Vec<u8>>) -> Reply {
        let path = target.split_once('?').map_or(target, |(path, _)| path);
        let head = Head {
            method: if body.is_some() {
                Method::Post
            } else {
                Method::Get
            },
            target: target.to_owned(),
            ..Head::default()
        };
        let mut body = Body::from(body.unwrap_or_default());
        let answer = api::answer(self, &head, path, &mut body);
        let answer = answer.unwrap_or_else(|error| Answer::from(&error));
        Reply {
            status: answer.code(),
            content_type: answer.content_type(),
            bytes: answer.into_bytes(),
        }
    }
}
