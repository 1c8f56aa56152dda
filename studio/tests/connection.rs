//! Requests on one connection beside a small model of it: which answers come, in which order, and after which one it
//! ends. Where a body ends decides what the next request is, so lengths are wrong in every way, and bodies hold requests.

use crate::client::{Reply, Site, head_of, reply};
use asperity_studio::{Limits, Studio};
use asperity_tests::draw::Draw;
use std::{
    collections::BTreeSet,
    io::{Read as _, Write as _},
    net::{Shutdown, TcpStream},
    thread::yield_now,
};

/// Sequences of requests.
const SEQUENCES: u64 = 600;
const HEAD_BYTES: usize = 16 << 10;
const JSON_BYTES: usize = 64 << 10;
const FILE_BYTES: usize = 64 << 20;

/// An answer that must come.
#[derive(Debug)]
struct Expected {
    status: u16,
    /// A part of its body.
    says: String,
    /// True for the last answer of the connection.
    closes: bool,
    /// True if it has no body, whatever its head says.
    bare: bool,
    /// Bytes of the stream after which it must come.
    after: usize,
}

/// A head as this model reads it.
#[derive(Default)]
struct Head<'a> {
    method: &'a str,
    target: &'a str,
    host: Option<&'a str>,
    length: usize,
    expects: bool,
    closes: bool,
}

/// The answers to a stream of bytes. Where the last one does not close the connection, the client must.
fn expected(site: &Site, stream: &[u8]) -> Vec<Expected> {
    let mut answers = Vec::new();
    let mut at = 0;
    loop {
        let mut begin = at;
        while let Some(b"\r" | b"\n") = stream.get(begin..=begin) {
            begin += 1;
        }
        let end = stream[begin..].windows(4).position(|w| w == b"\r\n\r\n");
        let Some(end) = end.map(|end| begin + end + 4) else {
            return answers;
        };
        let mut answer = |status, says: &str, closes, bare, after| {
            let says = says.to_owned();
            answers.push(Expected {
                status,
                says,
                closes,
                bare,
                after,
            });
            closes
        };
        let head = if end - at > HEAD_BYTES {
            Err((431, "head has more"))
        } else {
            read(std::str::from_utf8(&stream[begin..end]).expect("text"))
        };
        at = end;
        let head = match head {
            Ok(head) => head,
            Err((status, says)) => {
                answer(status, says, true, false, at);
                return answers;
            }
        };
        let bare = head.method == "HEAD";
        let unread = head.closes || head.length > 0;
        let page = site.page.trim_end_matches('/');
        let below = head.target.strip_prefix(page);
        let over = match (head.method, below) {
            _ if head.host != Some(&site.address.to_string()) => {
                answer(403, "another host", true, bare, at)
            }
            (_, None) => answer(404, "", true, bare, at),
            ("POST", Some(path)) if path.starts_with("/api/") => {
                let (most, status, says) = match path.split_once("?name=") {
                    Some((_, name)) => (FILE_BYTES, 422, name),
                    None => (JSON_BYTES, 400, "not as expected"),
                };
                if head.length > most {
                    answer(413, "too many", true, false, at)
                } else {
                    if head.expects {
                        answer(100, "", false, true, at);
                    }
                    at += head.length;
                    if at > stream.len() {
                        answer(400, "before its body", true, false, stream.len())
                    } else {
                        answer(status, says, head.closes, false, at)
                    }
                }
            }
            (_, Some("")) => answer(308, "", unread, bare, at),
            ("GET" | "HEAD", Some("/icon.svg")) => answer(200, "<svg", unread, bare, at),
            (_, Some("/none")) => answer(404, "nothing has this address", unread, bare, at),
            _ => answer(405, "alone", unread, bare, at),
        };
        if over {
            return answers;
        }
    }
}

/// Reads a head, with the empty line behind it.
fn read(text: &str) -> Result<Head<'_>, (u16, &'static str)> {
    let wrong = || (400, "not an HTTP request");
    let token = |word: &str| {
        let letter = |b: u8| b.is_ascii_alphanumeric() || b"!#$%&'*+-.^_`|~".contains(&b);
        !word.is_empty() && word.bytes().all(letter)
    };
    let mut lines = text.trim_end().split("\r\n");
    let mut words = lines.next().unwrap_or_default().split(' ');
    let first = [words.next(), words.next(), words.next(), words.next()];
    let [Some(method), Some(target), Some(version), None] = first else {
        return Err(wrong());
    };
    let kept_alive = match version {
        "HTTP/1.1" => true,
        "HTTP/1.0" => false,
        _ => return Err(wrong()),
    };
    let mut head = Head {
        method,
        target,
        closes: !kept_alive,
        ..Head::default()
    };
    let headers: Vec<(String, &str)> = lines
        .map(|line| line.split_once(':').filter(|(name, _)| token(name)))
        .map(|pair| pair.map(|(name, value)| (name.to_ascii_lowercase(), value.trim())))
        .collect::<Option<_>>()
        .ok_or_else(wrong)?;
    if !token(method) {
        return Err(wrong());
    }
    if headers.len() > 64 {
        return Err((431, "head has more"));
    }
    if !target.starts_with('/') {
        return Err(wrong());
    }
    if headers.iter().any(|(name, _)| name == "transfer-encoding") {
        return Err((411, "in chunks"));
    }
    let mut once = BTreeSet::new();
    for (name, value) in &headers {
        match &**name {
            "host" => head.host = Some(value),
            "content-length" if value.bytes().all(|b| b.is_ascii_digit()) => {
                head.length = value.parse().map_err(|_| wrong())?;
            }
            "content-length" => return Err(wrong()),
            "expect" => head.expects = true,
            "connection" => head.closes = *value != "keep-alive",
            _ => continue,
        }
        if !once.insert(name) {
            return Err(wrong());
        }
    }
    Ok(head)
}

/// The `n`th request: as the page sends it, more often than not.
fn request(draw: &mut Draw, site: &Site, n: usize) -> String {
    let page = site.page.trim_end_matches('/');
    let good = draw.below(8) > 0;
    let pick = |draw: &mut Draw, from: &[&str]| from[draw.below(from.len())].to_owned();
    let inner = format!(
        "GET {page}/icon.svg HTTP/1.1\r\nHost: {}\r\n\r\n",
        site.address
    );
    let body = match draw.below(8) {
        0 | 1 => inner,
        2 => "\r\n\r\n".into(),
        3 => format!("x\r\n\r\n{inner}"),
        4 if draw.below(4) == 0 => "x".repeat(JSON_BYTES + draw.below(2)),
        _ => "x".repeat(draw.below(40)),
    };
    let open = format!("/api/open?name=m{n}");
    let (method, path) = match draw.below(8) {
        0..=2 => ("POST".to_owned(), open),
        3 => ("POST".to_owned(), "/api/compile".to_owned()),
        4 | 5 => ("GET".to_owned(), "/icon.svg".to_owned()),
        _ => {
            let method = pick(draw, &["GET", "HEAD", "POST", "PUT", "OPTIONS"]);
            (method, pick(draw, &["/icon.svg", "/none", "", &open]))
        }
    };
    // Whatever is not read ends the connection, so that most requests have no such body.
    let reads = method == "POST" && path.starts_with("/api/");
    let body = if reads || draw.below(6) == 0 {
        body
    } else {
        String::new()
    };
    let address = site.address;
    let mut target = format!("{page}{path}");
    let mut head = format!("Host: {address}\r\n");
    let mut version = "HTTP/1.1";
    let mut length = format!("Content-Length: {}\r\n", body.len());
    if body.is_empty() && draw.below(2) == 0 {
        length.clear();
    }
    if !good {
        let stated = |length: usize| format!("Content-Length: {length}\r\n");
        match draw.below(14) {
            0 => length = stated(draw.below(body.len() + 1)),
            1 => length = stated(body.len() + 1 + draw.below(300)),
            2 => length.clear(),
            3 => {
                length = pick(
                    draw,
                    &["+5", "-5", "5, 5", "5;", "0x5", "", "99999999999999999999"],
                )
            }
            4 => length += &stated(body.len() + draw.below(2)),
            5 => length = "Transfer-Encoding: chunked\r\n".into(),
            6 => {
                length += &pick(
                    draw,
                    &[
                        "Transfer-Encoding: chunked\r\n",
                        "transfer-encoding: identity\r\n",
                    ],
                )
            }
            7 => length = stated([FILE_BYTES, FILE_BYTES + 1, u32::MAX as usize][draw.below(3)]),
            8 => head = pick(draw, &["", "Host: evil.example\r\n", &head.repeat(2)]),
            9 => {
                target = pick(
                    draw,
                    &["/", "/wrong/icon.svg", "*", "http://localhost/icon.svg"],
                )
            }
            10 => version = ["HTTP/1.0", "HTTP/3.0", "HTTP/1.1 "][draw.below(3)],
            11 => head += &"X: a\r\n".repeat(62 + draw.below(4)),
            12 => {
                // To the last byte that a head may have, or one more.
                let line = |more| {
                    format!("{method} {target} {version}\r\n{head}{length}X: {more}\r\n\r\n")
                };
                let room = HEAD_BYTES - line("").len();
                head += &format!("X: {}\r\n", "a".repeat(room + draw.below(2)));
            }
            _ => {
                head += &pick(
                    draw,
                    &[" folded\r\n", "Host : a\r\n", ": a\r\n", "no header\r\n"],
                )
            }
        }
        if length.starts_with(['+', '-']) || !length.is_empty() && !length.contains(':') {
            length = format!("Content-Length: {length}\r\n");
        }
    }
    match draw.below(12) {
        0 => head += "Connection: close\r\n",
        1 => {
            version = "HTTP/1.0";
            head += "Connection: keep-alive\r\n";
        }
        2 if reads => head += "Expect: 100-continue\r\n",
        _ => {}
    }
    format!("{method} {target} {version}\r\n{head}{length}\r\n{body}")
}

fn answered(stream: &mut TcpStream, one: &Expected) -> Option<Reply> {
    if one.bare {
        head_of(stream)
    } else {
        reply(stream)
    }
}

/// Sends the stream in one of three ways, and compares what comes.
fn compare(
    site: &Site,
    stream: &[u8],
    answers: &[Expected],
    draw: &mut Draw,
) -> Result<(), String> {
    let mut socket = site.connect();
    socket.set_nodelay(true).map_err(|e| e.to_string())?;
    let mut sent = 0;
    let mut send = |socket: &mut TcpStream, to: usize, piece: usize| {
        while sent < to {
            let next = to.min(sent + piece);
            // One that is over already takes no more.
            let _ = socket.write_all(&stream[sent..next]);
            sent = next;
            yield_now();
        }
    };
    let way = draw.below(3);
    match way {
        0 => send(&mut socket, stream.len(), stream.len()),
        1 => send(
            &mut socket,
            stream.len(),
            1 + draw.below(stream.len() / 8 + 1),
        ),
        // No answer waits for what comes behind its request.
        _ => {}
    }
    let token = site.page.trim_matches('/');
    let closed = answers.last().is_some_and(|last| last.closes);
    for (n, one) in answers.iter().enumerate() {
        send(&mut socket, one.after, stream.len());
        if one.after == stream.len() {
            // Where the body is short, this is how the server learns of it.
            let _ = (one.says == "before its body").then(|| socket.shutdown(Shutdown::Write));
        }
        let reply = answered(&mut socket, one).ok_or(format!("no answer {n}, way {way}"))?;
        let body = String::from_utf8_lossy(&reply.body);
        let connection = if one.closes { "close" } else { "keep-alive" };
        let says_so = one.status == 100 || reply.header("connection") == Some(connection);
        let tells = one.status != 308 && reply.head.contains(token) || body.contains(token);
        let fits = reply.status == one.status && (one.bare || body.contains(&one.says));
        if !fits || !says_so || tells {
            return Err(format!("answer {n}, way {way}: {}{body}", reply.head));
        }
    }
    if !closed {
        send(&mut socket, stream.len(), stream.len());
        let _ = socket.shutdown(Shutdown::Write);
    }
    let mut rest = Vec::new();
    let end = socket.read_to_end(&mut rest);
    if end.is_err() || !rest.is_empty() {
        let rest = String::from_utf8_lossy(&rest);
        return Err(format!("way {way}: after the last answer: {end:?} {rest}"));
    }
    Ok(())
}

#[test]
fn a_connection_answers_as_its_model_whatever_is_sent() {
    let site = Site::of(Studio::new(None, None), Limits::default());
    let last = format!(
        "GET {}icon.svg HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
        site.page, site.address
    );
    let mut seen = BTreeSet::new();
    let mut longest = 0;
    for seed in 0..SEQUENCES {
        let mut draw = Draw::new(seed);
        let count = 1 + draw.below(6);
        let mut stream: String = (0..count).map(|n| request(&mut draw, &site, n)).collect();
        stream += &last;
        let answers = expected(&site, stream.as_bytes());
        seen.extend(answers.iter().map(|one| (one.status, one.closes)));
        longest = longest.max(answers.len());
        if let Err(error) = compare(&site, stream.as_bytes(), &answers, &mut draw) {
            panic!("seed {seed}: {error}\nto {stream:?}\nmust be {answers:#?}");
        }
    }
    let both = [200, 308, 400, 404, 405, 422].into_iter();
    let either = both.flat_map(|status| [(status, false), (status, true)]);
    let one = [
        (100, false),
        (403, true),
        (411, true),
        (413, true),
        (431, true),
    ];
    let all: BTreeSet<_> = either.chain(one).collect();
    assert_eq!(seen, all, "every answer is drawn");
    assert!(longest > 6, "{longest}");
}
