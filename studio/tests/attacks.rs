//! Requests of others than the page: refused with the right status, and the server goes on. Those that are wrong as HTTP
//! are in `connection`.

use crate::client::{SHARED, Site};
use asperity_studio::Limits;

/// A request as it goes over the socket, and the status that it must get.
struct Stranger {
    what: &'static str,
    request: String,
    status: u16,
}

fn stranger(what: &'static str, status: u16, request: String) -> Stranger {
    Stranger {
        what,
        request,
        status,
    }
}

#[test]
fn requests_of_strangers_are_refused_and_learn_nothing() {
    let site = &*SHARED;
    let (page, host) = (&site.page, &site.address);
    let port = host.port();
    let get = |path: &str, headers: &str| format!("GET {path} HTTP/1.1\r\n{headers}\r\n");
    let own = format!("Host: {host}\r\n");
    let compile = |headers: &str| {
        let body = r#"{"prompt": "cork"}"#;
        let length = body.len();
        format!(
            "POST {page}api/compile HTTP/1.1\r\n{headers}Content-Type: text/plain\r\n\
             Content-Length: {length}\r\n\r\n{body}"
        )
    };
    let mut wrong_token = page.clone().into_bytes();
    wrong_token[3] ^= 1;
    let wrong_token = String::from_utf8(wrong_token).expect("text");
    let token = page.trim_matches('/');
    let strangers = [
        stranger(
            "another origin",
            403,
            compile(&format!("{own}Origin: https://evil.example\r\n")),
        ),
        stranger(
            "another port",
            403,
            compile(&format!("{own}Origin: http://127.0.0.1:{}\r\n", port ^ 1)),
        ),
        stranger(
            "a sandboxed page",
            403,
            compile(&format!("{own}Origin: null\r\n")),
        ),
        stranger(
            "two origins",
            400,
            compile(&format!(
                "{own}Origin: http://{host}\r\nOrigin: https://evil.example\r\n"
            )),
        ),
        stranger(
            "a form of another site",
            403,
            compile(&format!("{own}Sec-Fetch-Site: cross-site\r\n")),
        ),
        stranger(
            "a picture in another site",
            403,
            get(
                &format!("{page}worklet.js"),
                &format!("{own}Sec-Fetch-Site: cross-site\r\n"),
            ),
        ),
        stranger(
            "a check before a request",
            403,
            format!(
                "OPTIONS {page}api/compile HTTP/1.1\r\n{own}Origin: https://evil.example\r\n\r\n"
            ),
        ),
        stranger("no token", 404, get("/", &own)),
        stranger("no token, a file", 404, get("/worklet.js", &own)),
        stranger("no token, the interface", 404, get("/api/about.json", &own)),
        stranger("another token", 404, get(&wrong_token, &own)),
        stranger(
            "a part of the token",
            404,
            get(&format!("/{}/", &token[1..]), &own),
        ),
        stranger("the token and more", 404, get(&format!("/{token}A/"), &own)),
        stranger(
            "the token in a query",
            404,
            get(&format!("/?{token}/"), &own),
        ),
        stranger(
            "the token in small letters",
            404,
            get(&page.to_lowercase(), &own),
        ),
    ];
    for Stranger {
        what,
        request,
        status,
    } in strangers
    {
        let reply = site.send(request.as_bytes());
        assert_eq!(reply.status, status, "{what}: {reply:?}");
        assert_eq!(
            reply.header("x-content-type-options"),
            Some("nosniff"),
            "{what}"
        );
        let text = reply.head.clone() + &String::from_utf8_lossy(&reply.body);
        assert!(
            !text.contains(token) && !text.contains("Access-Control"),
            "{what}: {text}"
        );
        if status == 404 {
            assert!(reply.body.is_empty(), "{what}");
        }
    }
    // The same requests with the right words pass, so it is the words that were refused.
    let origin = format!("{own}Origin: http://{host}\r\nSec-Fetch-Site: same-origin\r\n");
    assert_eq!(site.send(compile(&origin).as_bytes()).status, 200);
    let link = format!("{own}Sec-Fetch-Site: cross-site\r\n");
    assert_eq!(site.send(get(page, &link).as_bytes()).status, 200);
    site.still_compiles();
}

#[test]
fn no_path_leaves_the_table_of_files() {
    let site = &*SHARED;
    for path in [
        "../Cargo.toml",
        "../../../../../../etc/passwd",
        "..%2fCargo.toml",
        "%2e%2e/Cargo.toml",
        "%252e%252e%252fCargo.toml",
        "..%5cCargo.toml",
        "..\\..\\Cargo.toml",
        "....//Cargo.toml",
        "./index.html",
        "//etc/passwd",
        "/etc/passwd",
        "index.html/",
        "index.html%00.png",
        "index%2ehtml",
        "INDEX.HTML",
        ".",
        "..",
        "api",
        "api/",
        "api/../index.html",
        "api/texture/",
        "api/texture/../../index.html",
        "api/texture/..%2f..%2findex.html",
        "api/texture/0123456789abcdef0123456789abcdef.asp",
        "api/texture/%30.asp",
        "api/texture/.asp",
        "api/texture/a.exe",
        "api/texture/../../../etc/passwd.export.c",
        "api/texture/0123456789abcdef0123456789abcdef.export.",
        "api/library/..%2f..%2fetc%2fpasswd.json",
        "api/library/0/../../x.png",
        "api/difference/../../etc/passwd.json",
    ] {
        let reply = site.get(path);
        assert_eq!(reply.status, 404, "{path}: {reply:?}");
        let json = reply.json();
        assert!(
            json["error"].is_string() && json["help"].is_string(),
            "{path}: {json}"
        );
    }
    assert_eq!(site.get("index.html").status, 200);
}

#[test]
fn methods_that_an_address_does_not_answer_are_named() {
    let site = &*SHARED;
    for (method, path, allowed) in [
        ("POST", "", "GET, HEAD"),
        ("DELETE", "worklet.js", "GET, HEAD"),
        ("PUT", "api/about.json", "GET, HEAD"),
        ("GET", "api/compile", "POST"),
        ("GET", "api/edit", "POST"),
        ("PUT", "api/blend", "POST"),
        ("TRACE", "api/open", "POST"),
        ("GET", "api/pack", "POST"),
        ("POST", "api/texture/a.asp", "GET, HEAD"),
    ] {
        let reply = site.request(method, path, "", b"");
        assert_eq!(reply.status, 405, "{method} {path}: {reply:?}");
        assert_eq!(reply.header("allow"), Some(allowed), "{method} {path}");
    }
}

#[test]
fn bodies_end_at_their_limit() {
    let site = &*SHARED;
    let json = |bytes: usize| {
        let frame = r#"{"prompt": "cork"}"#;
        format!("{}{frame}", " ".repeat(bytes - frame.len())).into_bytes()
    };
    assert_eq!(site.post("api/compile", &json(64 << 10)).status, 200);
    let open = vec![0; (64 << 20) + 1];
    for (path, body) in [
        ("api/compile", json((64 << 10) + 1)),
        ("api/open?name=x.asp", open),
    ] {
        let reply = site.post(path, &body);
        assert_eq!(reply.status, 413, "{path}: {}", reply.head);
        let error = reply.json()["error"].to_string();
        assert!(error.contains(&body.len().to_string()), "{error}");
    }
    // One that is only stated is refused before it comes, and no memory is taken for it.
    let stated = format!(
        "POST {}api/open HTTP/1.1\r\nHost: {}\r\nContent-Length: {}\r\n\r\n",
        site.page,
        site.address,
        u64::MAX
    );
    assert_eq!(site.send(stated.as_bytes()).status, 413);
    site.still_compiles();
}

#[test]
fn every_server_has_a_token_of_its_own() {
    let other = Site::start(None, Limits::default());
    assert_ne!(other.page, SHARED.page);
    let mixed = format!(
        "GET {} HTTP/1.1\r\nHost: {}\r\n\r\n",
        SHARED.page, other.address
    );
    assert_eq!(other.send(mixed.as_bytes()).status, 404);
    other.stopper.stop();
    other.thread.join().expect("it ends");
}
