//! An answer: its status, its headers, which are nearly the same for all, and its body.

use crate::error::ApiError;
use std::{
    borrow::Cow,
    io::{self, Write},
    sync::Arc,
};

/// Content security policy of the page: it may load, run and send to its own server alone. WebAssembly is compiled in
/// the worklet; pictures may come from memory. This much may also stand in the page itself.
pub(crate) const PAGE_POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
     img-src 'self' blob: data:; connect-src 'self'; worker-src 'self'; font-src 'self'; base-uri 'none'; \
     form-action 'none'";

/// Statuses of answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Status {
    Ok,
    Moved,
    BadRequest,
    Forbidden,
    NotFound,
    MethodNotAllowed,
    Timeout,
    Conflict,
    LengthRequired,
    TooLarge,
    Unprocessable,
    HeadTooLarge,
    Internal,
    Busy,
}

impl Status {
    const fn line(self) -> &'static str {
        match self {
            Self::Ok => "200 OK",
            Self::Moved => "308 Permanent Redirect",
            Self::BadRequest => "400 Bad Request",
            Self::Forbidden => "403 Forbidden",
            Self::NotFound => "404 Not Found",
            Self::MethodNotAllowed => "405 Method Not Allowed",
            Self::Timeout => "408 Request Timeout",
            Self::Conflict => "409 Conflict",
            Self::LengthRequired => "411 Length Required",
            Self::TooLarge => "413 Content Too Large",
            Self::Unprocessable => "422 Unprocessable Content",
            Self::HeadTooLarge => "431 Request Header Fields Too Large",
            Self::Internal => "500 Internal Server Error",
            Self::Busy => "503 Service Unavailable",
        }
    }
}

/// The bytes of a body.
#[derive(Debug, Clone)]
pub(crate) enum Content {
    Static(&'static [u8]),
    Owned(Vec<u8>),
    Shared(Arc<[u8]>),
}

impl Content {
    fn bytes(&self) -> &[u8] {
        match self {
            Self::Static(bytes) => bytes,
            Self::Owned(bytes) => bytes,
            Self::Shared(bytes) => bytes,
        }
    }
}

/// Cache lifetime of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keep {
    /// Not at all.
    No,
    /// For ever: its address names its bytes.
    Forever,
}

/// An answer to a request.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    status: Status,
    content_type: &'static str,
    content: Content,
    keep: Keep,
    /// A further header, with its line break.
    more: Cow<'static, str>,
}

impl Answer {
    /// Bytes of a type.
    pub(crate) fn new(content_type: &'static str, content: Content, keep: Keep) -> Self {
        Self {
            status: Status::Ok,
            content_type,
            content,
            keep,
            more: "".into(),
        }
    }

    /// JSON.
    pub(crate) fn json(text: impl Into<Vec<u8>>) -> Self {
        Self::new("application/json", Content::Owned(text.into()), Keep::No)
    }

    /// No bytes at all.
    pub(crate) fn empty(status: Status) -> Self {
        let content = Content::Static(b"");
        Self {
            status,
            ..Self::new("text/plain; charset=utf-8", content, Keep::No)
        }
    }

    /// The page is at this path.
    pub(crate) fn moved(path: &str) -> Self {
        Self {
            more: format!("Location: {path}\r\n").into(),
            ..Self::empty(Status::Moved)
        }
    }

    /// Methods that the address answers, where it was asked by another one.
    pub(crate) fn only(methods: &'static str) -> Self {
        let error = ApiError::new(
            Status::MethodNotAllowed,
            format!("this address answers {methods} alone"),
            "reload the page",
        );
        Self {
            more: format!("Allow: {methods}\r\n").into(),
            ..Self::from(&error)
        }
    }

    /// Its status as HTTP numbers it.
    pub(crate) fn code(&self) -> u16 {
        let number = self.status.line().split(' ').next();
        number
            .and_then(|number| number.parse().ok())
            .unwrap_or_default()
    }

    /// The type of its body.
    pub(crate) fn content_type(&self) -> &'static str {
        self.content_type
    }

    /// Its body.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        match self.content {
            Content::Owned(bytes) => bytes,
            content => content.bytes().to_vec(),
        }
    }

    /// Sends it. `closes` says that no further request is read; `bare` leaves the body out, as for HEAD.
    ///
    /// # Errors
    /// Where the client is gone, or too slow.
    pub(crate) fn send(&self, stream: &mut impl Write, closes: bool, bare: bool) -> io::Result<()> {
        let bytes = self.content.bytes();
        let head = format!(
            "HTTP/1.1 {status}\r\n\
             Content-Type: {content_type}\r\n\
             Content-Length: {length}\r\n\
             Content-Security-Policy: {PAGE_POLICY}; frame-ancestors 'none'\r\n\
             X-Content-Type-Options: nosniff\r\n\
             Referrer-Policy: no-referrer\r\n\
             Cross-Origin-Resource-Policy: same-origin\r\n\
             Cache-Control: {cache}\r\n\
             Connection: {connection}\r\n\
             {more}\r\n",
            status = self.status.line(),
            content_type = self.content_type,
            length = bytes.len(),
            cache = match self.keep {
                Keep::No => "no-store",
                Keep::Forever => "private, max-age=31536000, immutable",
            },
            connection = if closes { "close" } else { "keep-alive" },
            more = self.more,
        );
        stream.write_all(head.as_bytes())?;
        if !bare {
            stream.write_all(bytes)?;
        }
        stream.flush()
    }
}

impl From<&ApiError> for Answer {
    fn from(error: &ApiError) -> Self {
        Self {
            status: error.status,
            ..Self::json(error.json())
        }
    }
}
