//! A client that sends any bytes, and a server to send them to.

use asperity::{driver::Failure, learned::inference::Backend, sources::prompt::PromptCompiler};
use asperity_studio::{Collection, Limits, Server, Stopper, Studio};
use serde_json::Value;
use std::{
    io::{Read, Write},
    net::{SocketAddr, TcpStream},
    sync::LazyLock,
    thread::{self, JoinHandle},
    time::Duration,
};

/// A client that waits longer than this for the server fails its test.
const PATIENCE: Duration = Duration::from_secs(30);

/// A server that tests share, with its usual limits.
pub(crate) static SHARED: LazyLock<Site> = LazyLock::new(|| Site::start(None, Limits::default()));

/// The prompt compiler of the command.
pub(crate) fn embedded() -> Result<PromptCompiler, Failure> {
    Ok(PromptCompiler::embedded(&Backend::Portable)?)
}

/// A server at work.
pub(crate) struct Site {
    pub(crate) address: SocketAddr,
    /// `/TOKEN/`
    pub(crate) page: String,
    pub(crate) stopper: Stopper,
    pub(crate) thread: JoinHandle<()>,
}

/// An answer.
#[derive(Debug)]
pub(crate) struct Reply {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

impl Site {
    pub(crate) fn start(collection: Option<Collection>, limits: Limits) -> Self {
        Self::of(Studio::new(collection, Some(embedded)), limits)
    }

    /// A server of a studio or a study.
    pub(crate) fn of(site: impl Into<asperity_studio::Site>, limits: Limits) -> Self {
        let server = Server::bind(0, site, limits).expect("a free port");
        let url = server.url();
        let (address, page) = url
            .strip_prefix("http://")
            .and_then(|rest| rest.split_once('/'))
            .expect("an address and a path");
        Self {
            address: address.parse().expect("an address"),
            page: format!("/{page}"),
            stopper: server.stopper(),
            thread: thread::spawn(move || server.run()),
        }
    }

    pub(crate) fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).expect("the server listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("a socket");
        stream
    }

    /// Sends bytes as they are, and reads one answer. A server that refuses a body may close before it has all of it.
    pub(crate) fn send(&self, bytes: &[u8]) -> Reply {
        let mut stream = self.connect();
        let _ = stream.write_all(bytes);
        if bytes.starts_with(b"HEAD ") {
            return head_of(&mut stream).expect("an answer");
        }
        reply(&mut stream).expect("an answer")
    }

    /// A request of the page itself: a path below it, and more headers with their line breaks.
    pub(crate) fn request(&self, method: &str, path: &str, headers: &str, body: &[u8]) -> Reply {
        let head = format!(
            "{method} {page}{path} HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n{headers}\r\n",
            page = self.page,
            host = self.address,
            length = body.len(),
        );
        self.send(&[head.as_bytes(), body].concat())
    }

    pub(crate) fn get(&self, path: &str) -> Reply {
        self.request("GET", path, "", b"")
    }

    pub(crate) fn post(&self, path: &str, body: &[u8]) -> Reply {
        self.request("POST", path, "", body)
    }

    /// The server answers a compile.
    pub(crate) fn still_compiles(&self) {
        let texture = self.post("api/compile", br#"{"prompt": "cork"}"#);
        assert_eq!(texture.status, 200, "{texture:?}");
        assert_eq!(texture.json()["name"], "cork");
    }
}

impl Reply {
    pub(crate) fn json(&self) -> Value {
        assert_eq!(self.header("content-type"), Some("application/json"));
        serde_json::from_slice(&self.body).expect("JSON")
    }

    pub(crate) fn header(&self, name: &str) -> Option<&str> {
        self.head.lines().find_map(|line| {
            let (found, value) = line.split_once(": ")?;
            found.eq_ignore_ascii_case(name).then_some(value)
        })
    }
}

/// Reads one answer of a connection, and no byte more; `None` where it was closed.
pub(crate) fn reply(stream: &mut TcpStream) -> Option<Reply> {
    let mut reply = head_of(stream)?;
    let length = reply
        .header("content-length")
        .map_or(0, |length| length.parse().expect("a length"));
    reply.body.resize(length, 0);
    stream.read_exact(&mut reply.body).ok()?;
    Some(reply)
}

/// Reads the head of an answer.
pub(crate) fn head_of(stream: &mut TcpStream) -> Option<Reply> {
    let mut head = Vec::new();
    while !head.ends_with(b"\r\n\r\n") {
        let mut byte = [0];
        match stream.read(&mut byte) {
            Ok(1) => head.push(byte[0]),
            _ => return None,
        }
    }
    let head = String::from_utf8(head).expect("a head of text");
    Some(Reply {
        status: head[9..12].parse().expect("a status"),
        head,
        body: Vec::new(),
    })
}
