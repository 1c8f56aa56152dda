//! `asperity-lab servo --studio`: the loop as its page sees it, and a texture that the page has played.

use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Sends a request as the page does and returns the answer's JSON.
fn ask(url: &str, method: &str, path: &str, body: &[u8]) -> Value {
    let (host, page) = url
        .strip_prefix("http://")
        .and_then(|rest| rest.split_once('/'))
        .expect("an address");
    let mut stream = TcpStream::connect(host).expect("the studio listens");
    let head = format!(
        "{method} /{page}{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n",
        body.len()
    );
    stream
        .write_all(&[head.as_bytes(), body].concat())
        .expect("it is sent");
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).expect("an answer");
    let answer = String::from_utf8(answer).expect("text");
    let (head, body) = answer.split_once("\r\n\r\n").expect("a head");
    assert!(head.starts_with("HTTP/1.1 200"), "{answer}");
    serde_json::from_str(body).expect("JSON")
}

#[test]
fn the_page_sees_the_loop_and_swaps_its_texture() {
    let folder = tempfile::tempdir().expect("a folder");
    let cork = asperity::emit::lower::lower(&asperity::sources::builtin::texture(), None)
        .expect("an asset");
    let cork = asperity::emit::sections::renamed(&cork.bytes, "cork").expect("an asset");
    fs::write(folder.path().join("cork.asp"), &cork).expect("a file");
    let mut servo = Command::new(env!("CARGO_BIN_EXE_asperity-lab"))
        .current_dir(folder.path())
        .args([
            "servo",
            "--device",
            "sim:",
            "--studio",
            "--no-open",
            "--json",
        ])
        .args(["--policy", "other", "--no-lock", "--deep-idle", "--quiet"])
        .args(["--seconds", "60"])
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    let mut said = BufReader::new(servo.stderr.take().expect("a pipe")).lines();
    let url = loop {
        let line = said.next().expect("it names its address").expect("text");
        if let Some(url) = line.strip_prefix("studio: ") {
            break url.to_owned();
        }
    };
    let device = &ask(&url, "GET", "api/about.json", b"")["device"];
    assert_eq!(
        (&device["rate_hz"], &device["swaps"]),
        (&json!(1000), &json!(true))
    );

    // What plays is said seldom, and a busy machine takes its time.
    let began = Instant::now();
    let mut after = String::new();
    let mut until = |claim: &dyn Fn(&Value) -> bool, what: &str| {
        loop {
            let news = ask(&url, "GET", &format!("api/device/ticks{after}"), b"");
            after = format!("?after={}", news["next"]);
            if claim(&news) {
                return;
            }
            assert!(began.elapsed() < Duration::from_secs(50), "{what}: {news}");
        }
    };
    let feels = |news: &Value| {
        let runs = news["ticks"]["runs"].as_array().expect("runs");
        let rows = runs
            .iter()
            .flat_map(|run| run["columns"].as_array().expect("numbers").chunks(9));
        rows.clone()
            .any(|row| row[0].as_f64() > Some(0.0) && row[8].as_f64() > Some(0.1))
    };
    until(&feels, "the hand feels the surface");
    until(&|news| news["playing"] != "", "it names what plays");
    let opened = ask(&url, "POST", "api/open?name=cork.asp", &cork);
    let texture = opened.get("texture").unwrap_or(&opened);
    let body = json!({ "texture": texture["id"] }).to_string();
    ask(&url, "POST", "api/device/play", body.as_bytes());
    until(
        &|news| news["playing"] == "cork",
        "it plays the page's texture",
    );

    let id = servo.id().to_string();
    let killed = Command::new("kill").args(["-INT", &id]).status();
    assert!(killed.expect("kill").success());
    let output = servo.wait_with_output().expect("it ends");
    assert!(output.status.success());
    let summary: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(summary["reloads"], 1, "{summary}");
}
