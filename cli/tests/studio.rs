//! `asperity studio` as a user starts it: one line with the address, the bytes of `compile`, a clean end.

use super::{
    recording::{description, recorded, table},
    *,
};
use serde_json::{Value, json};
use std::{
    io::{BufRead as _, BufReader, Read as _, Write as _},
    net::{TcpListener, TcpStream},
    process::{Child, Stdio},
};

/// A studio that runs; it is killed where a test fails.
pub(crate) struct Running {
    child: Child,
    /// `127.0.0.1:PORT`
    pub(crate) host: String,
    /// `/TOKEN/`
    pub(crate) page: String,
}

/// Variables by which a studio keeps its project in a folder.
fn home(folder: &Path) -> [(&str, &Path); 3] {
    ["XDG_DATA_HOME", "HOME", "LOCALAPPDATA"].map(|name| (name, folder))
}

impl Running {
    pub(crate) fn start(folder: &Path, arguments: &[&str]) -> Self {
        Self::launch(folder, &[&["studio"], arguments].concat())
    }

    /// Starts a command that serves a page.
    pub(crate) fn launch(folder: &Path, arguments: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args([arguments, &["--no-open", "--port", "0"]].concat())
            .current_dir(folder)
            .envs(home(folder))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        let mut line = String::new();
        let stdout = child.stdout.as_mut().expect("a pipe");
        BufReader::new(stdout).read_line(&mut line).expect("a line");
        let url = line.trim_end().strip_prefix("http://").expect("an address");
        let (host, page) = url.split_once('/').expect("a path");
        Self {
            host: host.to_owned(),
            page: format!("/{page}"),
            child,
        }
    }

    /// The answer to these bytes, with its head.
    pub(crate) fn send(&self, request: &str) -> Vec<u8> {
        let mut stream = TcpStream::connect(&self.host).expect("it listens");
        stream.write_all(request.as_bytes()).expect("it reads");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("an answer");
        answer
    }

    /// The answer to a request below the page.
    fn answer(&self, request: &str, body: &str) -> Vec<u8> {
        let (method, path) = request.split_once(' ').expect("a method and a path");
        self.send(&format!(
            "{method} {}{path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{body}",
            self.page,
            self.host,
            body.len()
        ))
    }

    /// The body of a good answer.
    fn ask(&self, request: &str, body: &str) -> Vec<u8> {
        let mut answer = self.answer(request, body);
        assert!(answer.starts_with(b"HTTP/1.1 200 "), "{}", text(&answer));
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n");
        answer.split_off(end.expect("a head") + 4)
    }

    fn compile(&self, prompt: &str, seed: u64) -> Value {
        let body = json!({ "prompt": prompt, "seed": seed }).to_string();
        serde_json::from_slice(&self.ask("POST api/compile", &body)).expect("JSON")
    }

    fn file(&self, texture: &Value, ending: &str) -> Vec<u8> {
        let id = texture["id"].as_str().expect("a name");
        self.ask(&format!("GET api/texture/{id}.{ending}"), "")
    }
}

impl Running {
    /// Kills it, whatever it does.
    pub(crate) fn kill(mut self) {
        self.child.kill().expect("it runs");
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // It has ended already where the test did that.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// JSON without what differs from run to run: times.
fn timeless(json: &[u8]) -> Value {
    let mut json: Value = serde_json::from_slice(json).expect("JSON");
    json.as_object_mut().expect("an object").remove("stages_ms");
    json
}

#[test]
fn a_prompt_on_the_page_and_in_a_shell_gives_the_bytes_of_the_command() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let studio = Running::start(folder, &[]);
    for (prompt, seed) in [("gritty sheet", 0), ("-wet 'ice' \"$(id)\\`", 7)] {
        let texture = studio.compile(prompt, seed);
        let asset = studio.file(&texture, "asp");
        let seed = seed.to_string();
        let command = [
            "compile",
            "-o",
            "c.asp",
            "--seed",
            &seed,
            "--json",
            "--explain",
            "--",
            prompt,
        ];
        let report = good(folder, &command);
        assert!(bytes(folder, "c.asp") == asset, "{prompt}");
        let compiled = texture["compiled"].to_string();
        assert_eq!(timeless(compiled.as_bytes()), timeless(report.as_bytes()));
        assert_eq!(
            good(folder, &["inspect", "c.asp", "--json"]).as_bytes(),
            studio.file(&texture, "json")
        );
        #[cfg(unix)]
        {
            let line = texture["command"].as_str().expect("a command");
            let shell = tempfile::tempdir().expect("a folder");
            let programs = Path::new(env!("CARGO_BIN_EXE_asperity"))
                .parent()
                .expect("a folder");
            let run = Command::new("sh")
                .args(["-c", line])
                .env("PATH", format!("{}:/usr/bin:/bin", programs.display()))
                .current_dir(shell.path())
                .output()
                .expect("a shell");
            assert!(run.status.success(), "{line}: {}", text(&run.stderr));
            let written = entries(shell.path());
            assert_eq!(written.len(), 1, "{line}: {written:?}");
            assert!(bytes(shell.path(), &written[0]) == asset, "{line}");
        }
    }
}

/// The first line that a studio says beside its address, which then ends.
fn warned(command: &mut Command) -> String {
    let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("it starts");
    let mut said = String::new();
    let stderr = child.stderr.take().expect("a pipe");
    BufReader::new(stderr).read_line(&mut said).expect("a line");
    let _ = child.kill();
    let _ = child.wait();
    said
}

#[test]
fn a_port_that_is_taken_and_a_path_that_is_no_library_are_refused_with_a_remedy() {
    let inputs = inputs();
    let folder = inputs.path();
    let taken = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("an address").port().to_string();
    refused(
        folder,
        &["studio", "--no-open", "--port", &port],
        &[&port, "another --port"],
    );
    for (path, named) in [
        ("flipped.asp", "flipped.asp"),
        ("missing.aspl", "missing.aspl"),
        ("dir", "no asset"),
    ] {
        refused(folder, &["studio", "--no-open", path], &[named]);
    }
    // Without a port that is asked for, another one does where the usual one is taken.
    let _usual = TcpListener::bind("127.0.0.1:8417");
    let said = warned(
        Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(["studio", "--no-open"])
            .envs(home(folder)),
    );
    assert!(said.contains("port 8417 is taken"), "{said}");
    let usage = asperity(folder, &["studio", "--port", "65536"]);
    assert_eq!(usage.status.code(), Some(2));
}

#[test]
fn a_folder_of_assets_is_named_on_the_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::create_dir(folder.join("mine")).expect("a folder");
    good(folder, &["builtin", "-o", "mine/grit.asp"]);
    let studio = Running::start(folder, &["mine"]);
    let about: Value = serde_json::from_slice(&studio.ask("GET api/about.json", "")).expect("JSON");
    assert_eq!(
        about["library"],
        json!({ "id": "0", "name": "mine", "textures": 1 })
    );
    assert_eq!(about["folder"], "mine");
    assert!(text(&studio.ask("GET index.html", "")).starts_with("<!doctype html>"));
}

#[test]
fn the_page_of_a_library_is_written_once_and_replaces_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::create_dir(folder.join("mine")).expect("a folder");
    good(folder, &["builtin", "-o", "mine/grit.asp"]);
    let said = good(folder, &["studio", "mine", "--export", "page"]);
    assert!(said.starts_with("page: 1 texture in "), "{said}");
    assert!(said.contains("http.server"), "{said}");
    assert_eq!(entries(folder), ["mine", "page"]);
    assert!(entries(&folder.join("page")).contains(&"index.html".to_owned()));
    for to in ["page", "mine"] {
        let before = entries(&folder.join(to));
        refused(
            folder,
            &["studio", "mine", "--export", to],
            &[to, "remove what is in this one"],
        );
        assert_eq!(entries(&folder.join(to)), before);
    }
    for wrong in [
        &["studio", "--export", "new"][..],
        &["studio", "mine", "--export", "new", "--no-open"],
        &["studio", "mine", "--compiler", "mine/grit.asp"],
    ] {
        assert_eq!(asperity(folder, wrong).status.code(), Some(2), "{wrong:?}");
    }
    fs::write(folder.join("mine/notes.txt"), "no module").expect("room");
    for (file, named) in [
        (
            "mine/notes.txt",
            ["not the studio's compiler", "build-module"],
        ),
        ("mine/grit.asp", ["an asset", "not the studio's compiler"]),
        #[cfg(unix)]
        ("/dev/zero", ["/dev/zero", "may have no end"]),
    ] {
        let command = ["studio", "mine", "--export", "new", "--compiler", file];
        refused(folder, &command, &named);
    }
    assert_eq!(entries(folder), ["mine", "page"]);
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_it_with_success_and_prints_nothing_more() {
    let folder = tempfile::tempdir().expect("a folder");
    for signal in ["INT", "TERM"] {
        let mut studio = Running::start(folder.path(), &[]);
        studio.compile("cork", 0);
        // An open connection keeps it no longer.
        let open = TcpStream::connect(&studio.host).expect("it listens");
        let id = studio.child.id().to_string();
        let killed = Command::new("sh")
            .args(["-c", &format!("kill -{signal} {id}")])
            .status();
        assert!(killed.expect("a shell").success());
        let status = studio.child.wait().expect("it ends");
        assert_eq!(status.code(), Some(0), "{signal}");
        let mut rest = Vec::new();
        studio
            .child
            .stdout
            .take()
            .expect("a pipe")
            .read_to_end(&mut rest)
            .expect("an end");
        studio
            .child
            .stderr
            .take()
            .expect("a pipe")
            .read_to_end(&mut rest)
            .expect("an end");
        assert_eq!(text(&rest), "", "{signal}");
        drop(open);
    }
}

/// Without a browser, the address is still there, and what to do is said.
#[cfg(target_os = "linux")]
#[test]
fn a_missing_browser_is_a_warning_with_the_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = warned(
        Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args(["studio", "--port", "0"])
            .envs(home(folder.path()))
            .env("DISPLAY", ":0")
            .env("PATH", folder.path()),
    );
    for part in ["warning: ", "xdg-open", "open the address above by hand"] {
        assert!(said.contains(part), "{said}");
    }
}

#[test]
fn a_recording_that_is_dropped_on_the_page_gives_the_bytes_of_the_command() {
    let (table, description) = (table(9), description());
    let folder = recorded(&table, Some(&description));
    let folder = folder.path();
    let studio = Running::start(folder, &[]);
    let sent = |description: &str| {
        let list = json!([
            { "name": "all.csv", "bytes": table.len() },
            { "name": "recording.toml", "bytes": description.len() },
        ]);
        format!("{list}\n{table}{description}")
    };
    let answer = studio.ask("POST api/folder?name=oak", &sent(&description));
    let answer: Value = serde_json::from_slice(&answer).expect("JSON");
    let texture = &answer["texture"];
    let command = texture["command"].as_str().expect("a command");
    assert_eq!(command, "asperity import recording oak -o Oak.asp");
    good(folder, &["import", "recording", "oak", "-o", "Oak.asp"]);
    let written = fs::read(folder.join("Oak.asp")).expect("an asset");
    assert!(studio.file(texture, "asp") == written);

    let wrong = sent(&description.replace("all.csv", "old.csv"));
    let said = studio.answer("POST api/folder?name=oak", &wrong);
    let said = text(&said);
    let temporary = std::env::temp_dir().display().to_string();
    assert!(
        said.starts_with("HTTP/1.1 422 ") && said.contains("oak/"),
        "{said}"
    );
    assert!(!said.contains(&temporary), "{said}");
}
