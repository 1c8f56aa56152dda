//! Limits of the machine, and browsers that reach it from elsewhere.

use super::{Case, Check};
use crate::studio::Running;
use std::process::Command;

pub(super) const CHECKS: &[(&str, Check)] = &[
    ("studio-tunnel", names_of_this_machine_are_not_foreign),
    ("thread-limit-panic", few_threads_bring_no_command_down),
];

fn names_of_this_machine_are_not_foreign(case: &Case) {
    let studio = Running::start(case.scratch.path(), &[]);
    let (page, port) = (&studio.page, &studio.host["127.0.0.1:".len()..]);
    let body = r#"{"prompt": "cork"}"#;
    let answer = |line: &str, headers: &str, body: &str| {
        let length = body.len();
        let answer = studio.send(&format!(
            "{line} HTTP/1.1\r\n{headers}Connection: close\r\nContent-Length: {length}\r\n\r\n{body}"
        ));
        let answer = String::from_utf8_lossy(&answer).into_owned();
        (answer[9..12].to_owned(), answer)
    };
    let get = |headers: &str| answer(&format!("GET {page}"), headers, "");
    for host in [
        &*format!("localhost:{port}"),
        "localhost:18080",
        "127.0.0.1:9000",
        "[::1]:9000",
        "LOCALHOST:18080",
        "localhost.:18080",
        "127.0.0.2:18080",
        "localhost",
        "127.0.0.1",
        "[::1]",
    ] {
        let (status, said) = get(&format!("Host: {host}\r\n"));
        assert_eq!(status, "200", "{host}: {said}");
        // The page that came so asks for textures so.
        let own = format!("Host: {host}\r\nOrigin: http://{host}\r\n");
        let (status, said) = answer(&format!("POST {page}api/compile"), &own, body);
        assert_eq!(status, "200", "{host}: {said}");
    }
    let foreign = [
        format!("evil.example:{port}"),
        format!("localhost.evil.com:{port}"),
        format!("127.0.0.1.evil.com:{port}"),
        format!("localhost:{port}@evil.com"),
        format!("localhost@evil.com:{port}"),
        format!("evil.com@localhost:{port}"),
        format!("127.0.0.1:{port}:evil.com"),
        format!("0.0.0.0:{port}"),
        format!("[::1].evil.com:{port}"),
        String::new(),
    ];
    let hosts = foreign.map(|host| format!("Host: {host}\r\n"));
    let pages = ["http://localhost:9000", "http://evil.com", "null"]
        .map(|origin| format!("Host: localhost:{port}\r\nOrigin: {origin}\r\n"));
    for headers in hosts.iter().chain(&pages).chain([&String::new()]) {
        let (status, said) = get(headers);
        assert_eq!(status, "403", "{headers}: {said}");
        assert!(said.contains("\"help\""), "{headers}: {said}");
        assert!(!said.contains(page.trim_matches('/')), "{headers}: {said}");
    }
    for host in ["localhost", "evil.com"] {
        let two = format!("Host: localhost:{port}\r\nHost: {host}:{port}\r\n");
        assert_eq!(get(&two).0, "400", "{two}");
        let absolute = format!("GET http://{host}:{port}{page}");
        let own = format!("Host: localhost:{port}\r\n");
        assert_eq!(answer(&absolute, &own, "").0, "400", "{absolute}");
    }
}

fn few_threads_bring_no_command_down(case: &Case) {
    let limited = "su nobody -s /bin/bash -c 'ulimit -u 20'";
    let can = Command::new("bash").args(["-c", limited]).output();
    if !can.is_ok_and(|output| output.status.success()) {
        println!(
            "thread-limit-panic: skipped: limits of processes cannot be set here (needs root, su, user nobody)"
        );
        return;
    }
    let output = Command::new("bash")
        .arg(case.file("run.sh"))
        .arg(env!("CARGO_BIN_EXE_asperity"))
        .output()
        .expect("bash runs");
    let said = String::from_utf8_lossy(&output.stdout);
    let text = format!("{said}{}", String::from_utf8_lossy(&output.stderr));
    let statuses: Vec<&str> = said
        .lines()
        .filter_map(|line| line.strip_prefix("rc "))
        .collect();
    assert_eq!(statuses.len(), 2, "{text}");
    assert!(
        statuses.iter().all(|status| ["0", "1"].contains(status)),
        "{text}"
    );
    assert!(!text.contains("panicked"), "{text}");
}
