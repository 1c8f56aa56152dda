//! Clients that keep the server waiting: each is dropped, and none shuts another out.

use crate::client::{Site, reply};
use asperity_studio::Limits;
use std::{
    io::{Read as _, Write as _},
    net::TcpStream,
    thread::sleep,
    time::{Duration, Instant},
};

/// A server with little patience.
fn hasty(connections: usize) -> Site {
    let time = Duration::from_millis(300);
    Site::start(None, Limits { connections, time })
}

fn head(site: &Site, length: usize) -> String {
    let (page, host) = (&site.page, &site.address);
    format!("POST {page}api/compile HTTP/1.1\r\nHost: {host}\r\nContent-Length: {length}\r\n\r\n")
}

#[test]
fn a_request_that_comes_byte_by_byte_is_dropped_in_time() {
    let site = hasty(64);
    let whole = format!("{}{{\"prompt\": \"cork\"}}   ", head(&site, 21));
    // Each byte comes soon, and the whole does not: the first, in the head; the second, in the body.
    for already in [4, whole.len() - 12] {
        let mut stream = site.connect();
        stream
            .write_all(&whole.as_bytes()[..already])
            .expect("a beginning");
        let began = Instant::now();
        let mut slow = stream.try_clone().expect("a socket");
        let (rest, _) = whole.as_bytes()[already..].split_at(11);
        let writer = std::thread::spawn({
            let rest = rest.to_vec();
            move || {
                for byte in rest {
                    sleep(Duration::from_millis(100));
                    if slow.write_all(&[byte]).is_err() {
                        break;
                    }
                }
            }
        });
        let answer = reply(&mut stream).expect("an answer");
        assert_eq!(answer.status, 408, "{answer:?}");
        assert!(
            began.elapsed() < Duration::from_secs(1),
            "{:?}",
            began.elapsed()
        );
        writer.join().expect("it ends");
    }
    // Who says nothing gets nothing.
    let mut silent = site.connect();
    let began = Instant::now();
    assert_eq!(silent.read(&mut [0]).expect("an end"), 0);
    assert!(began.elapsed() < Duration::from_secs(2));
    site.still_compiles();
}

#[test]
fn answers_that_nobody_reads_are_given_up() {
    let site = hasty(64);
    let mut stream = site.connect();
    let (page, host) = (&site.page, &site.address);
    let get = format!("GET {page}asperity.wasm HTTP/1.1\r\nHost: {host}\r\n\r\n");
    let requests = 400;
    let asked = get.repeat(requests);
    let writer = std::thread::spawn({
        let mut stream = stream.try_clone().expect("a socket");
        // Given up, the server reads no more of them.
        move || drop(stream.write_all(asked.as_bytes()))
    });
    sleep(Duration::from_millis(1200));
    let size = site.get("asperity.wasm").body.len();
    let mut read = 0;
    let mut buffer = vec![0; 1 << 16];
    while let Ok(count @ 1..) = stream.read(&mut buffer) {
        read += count;
    }
    assert!(
        read < requests * size,
        "{read} bytes came though nobody read for four times the limit"
    );
    writer.join().expect("it ends");
    site.still_compiles();
}

/// Sockets that strangers open: how, and what each sends. None of them reads.
fn strangers(site: &Site) -> [(&'static str, String); 8] {
    let (page, host) = (&site.page, site.address);
    let endless = "Content-Length: 1000000\r\n\r\nx";
    let own = format!("Host: {host}\r\n");
    let get = |path: &str| format!("GET {path} HTTP/1.1\r\n{own}\r\n");
    [
        ("silent", String::new()),
        ("half a head", format!("GET {page} HTTP/1.1\r\nHost:")),
        (
            "a head byte by byte",
            format!("GET {page} HTTP/1.1\r\n{own}X: {}", "x".repeat(40)),
        ),
        (
            "another host, and a body that never comes",
            format!("POST {page}api/open HTTP/1.1\r\nHost: evil.example\r\n{endless}"),
        ),
        (
            "another origin, and a body that never comes",
            format!(
                "POST {page}api/open HTTP/1.1\r\n{own}Origin: https://evil.example\r\n{endless}"
            ),
        ),
        (
            "no token, and a body that never comes",
            format!("POST /api/open HTTP/1.1\r\n{own}{endless}"),
        ),
        ("no token, and no answer read", get("/").repeat(200)),
        ("no HTTP, and no answer read", "\r\nhello\r\n".repeat(200)),
    ]
}

#[test]
fn strangers_shut_nobody_out_whatever_they_do() {
    #[cfg(unix)]
    allow_files(4096);
    let site = Site::start(None, Limits::default());
    site.still_compiles();
    let mut held: Vec<TcpStream> = Vec::new();
    for (what, sends) in strangers(&site) {
        let by_byte = what.contains("byte by byte");
        let new = (0..170).map(|_| {
            let mut stream = site.connect();
            stream.set_nonblocking(true).expect("a socket");
            // One that made room for others already takes none; one that is full stays so.
            let _ = stream.write(if by_byte { b"" } else { sends.as_bytes() });
            stream
        });
        let new: Vec<TcpStream> = new.collect();
        let asks = || {
            let began = Instant::now();
            site.still_compiles();
            for _ in 0..10 {
                let page = site.get("");
                assert_eq!(page.status, 200, "{what}: {page:?}");
            }
            let took = began.elapsed();
            assert!(took < Duration::from_secs(5), "{what}: {took:?}");
        };
        asks();
        if by_byte {
            for byte in sends.as_bytes() {
                let dripped = new.iter().map(|mut stream| stream.write(&[*byte]).is_ok());
                assert!(dripped.filter(|ok| *ok).count() > 0, "{what}");
            }
            asks();
        }
        held.extend(new);
        let open = held.iter().filter(|stream| {
            // One that was shut or answered reads that.
            let read = (&mut &**stream).read(&mut [0]);
            read.is_err_and(|e| e.kind() == std::io::ErrorKind::WouldBlock)
        });
        let open = open.count();
        assert!(open <= 64, "{what}: {open} are held open");
    }
    drop(held);
    site.still_compiles();
}

/// The user's own places: a client that has its last answer holds none, though it sends on and closes nothing.
#[test]
fn a_client_that_lingers_holds_no_place() {
    let one = Limits {
        connections: 1,
        ..Limits::default()
    };
    let site = Site::start(None, one);
    let large = head(&site, 70_000);
    let held: Vec<TcpStream> = (0..8)
        .map(|_| {
            let mut stream = site.connect();
            stream.write_all(large.as_bytes()).expect("room");
            assert_eq!(reply(&mut stream).expect("an answer").status, 413);
            stream
        })
        .collect();
    site.still_compiles();
    drop(held);
}

/// A place is given once the token is right: strangers, answered one after another, take none from the one who has it.
#[test]
fn refused_requests_take_no_place() {
    let one = Limits {
        connections: 1,
        ..Limits::default()
    };
    let site = Site::start(None, one);
    let (page, host) = (&site.page, site.address);
    let get = format!("GET {page} HTTP/1.1\r\nHost: {host}\r\n\r\n");
    let mut own = site.connect();
    let mut asks = || {
        own.write_all(get.as_bytes()).expect("it is open");
        reply(&mut own).expect("an answer").status
    };
    assert_eq!(asks(), 200);
    for _ in 0..100 {
        for (path, host, status) in [
            ("/", host.to_string(), 404),
            (page.as_str(), "evil.example".into(), 403),
        ] {
            let mut stranger = site.connect();
            let request = format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n");
            stranger.write_all(request.as_bytes()).expect("room");
            assert_eq!(reply(&mut stranger).expect("an answer").status, status);
        }
    }
    assert_eq!(asks(), 200, "its connection was not shut for them");
}

/// Lets this process hold more files, as 1,360 sockets and their other ends are.
#[cfg(unix)]
fn allow_files(count: u64) {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let limit = getrlimit(Resource::Nofile);
    if limit.current.is_some_and(|current| current < count) {
        let current = Some(limit.maximum.map_or(count, |most| most.min(count)));
        setrlimit(Resource::Nofile, Rlimit { current, ..limit }).expect("files");
    }
}
