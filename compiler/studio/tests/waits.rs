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

#[test]
fn a_thousand_silent_sockets_shut_nobody_out() {
    #[cfg(unix)]
    allow_files(4096);
    let site = Site::start(None, Limits::default());
    let half_a_head = format!("GET {} HTTP/1.1\r\nHost:", site.page);
    let held: Vec<TcpStream> = (0..1000)
        .map(|n| {
            let mut stream = site.connect();
            if n % 2 == 0 {
                // A socket that made room for others already takes none.
                let _ = stream.write_all(half_a_head.as_bytes());
            }
            stream
        })
        .collect();
    let began = Instant::now();
    site.still_compiles();
    assert!(
        began.elapsed() < Duration::from_secs(5),
        "{:?}",
        began.elapsed()
    );
    let open = held.iter().filter(|stream| {
        let mut stream = *stream;
        stream.set_nonblocking(true).expect("a socket");
        // One that was shut reads its end.
        stream
            .read(&mut [0])
            .is_err_and(|e| e.kind() == std::io::ErrorKind::WouldBlock)
    });
    let open = open.count();
    assert!(open <= 64, "{open} are held open");
    drop(held);
    site.still_compiles();
}

/// Lets this process hold more files, as 1,000 sockets and their other ends are.
#[cfg(unix)]
fn allow_files(count: u64) {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let limit = getrlimit(Resource::Nofile);
    if limit.current.is_some_and(|current| current < count) {
        let current = Some(limit.maximum.map_or(count, |most| most.min(count)));
        setrlimit(Resource::Nofile, Rlimit { current, ..limit }).expect("files");
    }
}
