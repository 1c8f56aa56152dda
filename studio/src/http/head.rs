//! The head of a request: method, target, and the few headers that matter here.

use super::answer::Status;
use crate::error::ApiError;
use std::io::{ErrorKind, Read};

/// Bytes of a head at most.
const MOST_BYTES: usize = 16 << 10;
/// Headers of a head at most; browsers send about fifteen.
const MOST_HEADERS: usize = 64;

/// The request method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Method {
    #[default]
    Get,
    Head,
    Post,
    /// A method that nothing here answers.
    Other,
}

/// The head of a request.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Head {
    pub(crate) method: Method,
    /// The path with its query.
    pub(crate) target: String,
    pub(crate) host: Option<String>,
    pub(crate) origin: Option<String>,
    pub(crate) fetch_site: Option<String>,
    /// Bytes of the body.
    pub(crate) length: u64,
    /// True if the client waits for `100 Continue` before it sends the body.
    pub(crate) expects_continue: bool,
    /// True if the client wants no further request on this connection.
    pub(crate) closes: bool,
}

/// Reads a head; what came behind it stays in `buffer`, which may hold the beginning already. `None` where the client
/// closed the connection, or sent nothing in time.
///
/// # Errors
/// For what is no head, or a longer one than is read, or one that takes too long.
pub(crate) fn read_head(
    stream: &mut impl Read,
    buffer: &mut Vec<u8>,
) -> Result<Option<Head>, ApiError> {
    loop {
        if let Some((head, end)) = parse(buffer)? {
            buffer.drain(..end);
            return Ok(Some(head));
        }
        if buffer.len() >= MOST_BYTES {
            return Err(too_large());
        }
        let mut more = [0; 4096];
        let room = (MOST_BYTES - buffer.len()).min(more.len());
        match stream.read(&mut more[..room]) {
            Ok(0) => return Ok(None),
            Ok(count) => buffer.extend_from_slice(&more[..count]),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) if error.kind() == ErrorKind::TimedOut && !buffer.is_empty() => {
                return Err(slow());
            }
            Err(_) => return Ok(None),
        }
    }
}

/// The head at the beginning of these bytes, and where it ends; `None` where it goes on.
fn parse(bytes: &[u8]) -> Result<Option<(Head, usize)>, ApiError> {
    let mut headers = [httparse::EMPTY_HEADER; MOST_HEADERS];
    let mut request = httparse::Request::new(&mut headers);
    let end = match request.parse(bytes) {
        Ok(httparse::Status::Complete(end)) => end,
        Ok(httparse::Status::Partial) => return Ok(None),
        Err(httparse::Error::TooManyHeaders) => return Err(too_large()),
        Err(error) => return Err(wrong(&error.to_string())),
    };
    let target = request.path.unwrap_or_default();
    if !target.starts_with('/') {
        return Err(wrong("the address is no path"));
    }
    let connection = all(request.headers, "connection")?.join(",");
    let has = |wanted: &str| {
        let mut words = connection.split(',').map(str::trim);
        words.any(|word| word.eq_ignore_ascii_case(wanted))
    };
    if !all(request.headers, "transfer-encoding")?.is_empty() {
        return Err(ApiError::new(
            Status::LengthRequired,
            "the request's body is sent in chunks",
            "send it with its length",
        ));
    }
    let length = match single(request.headers, "content-length")? {
        // A sign, which `parse` would take, is none of HTTP.
        Some(text) if text.bytes().all(|b| b.is_ascii_digit()) => {
            text.parse().map_err(|_| wrong("the length is none"))?
        }
        Some(_) => return Err(wrong("the length is none")),
        None => 0,
    };
    let head = Head {
        method: match request.method {
            Some("GET") => Method::Get,
            Some("HEAD") => Method::Head,
            Some("POST") => Method::Post,
            _ => Method::Other,
        },
        target: target.to_owned(),
        host: single(request.headers, "host")?.map(str::to_owned),
        origin: single(request.headers, "origin")?.map(str::to_owned),
        fetch_site: single(request.headers, "sec-fetch-site")?.map(str::to_owned),
        length,
        expects_continue: single(request.headers, "expect")?
            .is_some_and(|expected| expected.eq_ignore_ascii_case("100-continue")),
        closes: has("close") || (request.version == Some(0) && !has("keep-alive")),
    };
    Ok(Some((head, end)))
}

/// The values of a header.
fn all<'a>(headers: &[httparse::Header<'a>], name: &str) -> Result<Vec<&'a str>, ApiError> {
    let named = headers
        .iter()
        .filter(|header| header.name.eq_ignore_ascii_case(name));
    named
        .map(|header| {
            std::str::from_utf8(header.value)
                .map(str::trim)
                .map_err(|_| wrong(&format!("the header {name} is no text")))
        })
        .collect()
}

/// The value of a header that may stand only once: two readers of a request could each believe another one.
fn single<'a>(headers: &[httparse::Header<'a>], name: &str) -> Result<Option<&'a str>, ApiError> {
    match all(headers, name)?[..] {
        [] => Ok(None),
        [value] => Ok(Some(value)),
        _ => Err(wrong(&format!("the header {name} stands twice"))),
    }
}

fn wrong(why: &str) -> ApiError {
    let help = "open the address in a browser";
    ApiError::new(
        Status::BadRequest,
        format!("not an HTTP request: {why}"),
        help,
    )
}

fn too_large() -> ApiError {
    ApiError::new(
        Status::HeadTooLarge,
        format!("the request's head has more than {MOST_BYTES} bytes or {MOST_HEADERS} headers"),
        "delete the cookies of this address",
    )
}

/// The error of a request that came too slowly.
pub(super) fn slow() -> ApiError {
    ApiError::new(
        Status::Timeout,
        "the request came too slowly",
        "send it again",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head(text: &str) -> Result<Option<Head>, Status> {
        read_head(&mut text.as_bytes(), &mut Vec::new()).map_err(|error| error.status)
    }

    #[test]
    fn heads_that_two_readers_could_read_differently_are_refused() {
        for lines in [
            "Host: a\r\nHost: b",
            "Origin: a\r\nOrigin: a",
            "Content-Length: 1\r\nContent-Length: 2",
            "Content-Length: +1",
            "Content-Length: -1",
            "Content-Length: 1, 1",
            "Content-Length: 99999999999999999999",
            "Host : a",
            "Host: a\r\n b",
            "Host: \u{0}",
        ] {
            let text = format!("GET / HTTP/1.1\r\n{lines}\r\n\r\n");
            assert_eq!(head(&text), Err(Status::BadRequest), "{lines:?}");
        }
        let chunks = "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n";
        assert_eq!(head(chunks), Err(Status::LengthRequired));
        for line in [
            "GET http://a/ HTTP/1.1",
            "GET * HTTP/1.1",
            "GET / HTTP/3.0",
            "\u{16}\u{3}\u{1}",
        ] {
            assert_eq!(
                head(&format!("{line}\r\n\r\n")),
                Err(Status::BadRequest),
                "{line:?}"
            );
        }
    }
}
