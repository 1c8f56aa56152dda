//! System limits on a process: open files, file size, fatal signals. Nothing is half-written, nothing left behind, and
//! the cause is named.
#![cfg(unix)]

use super::*;
use std::{
    process::Stdio,
    thread::sleep,
    time::{Duration, Instant},
};

/// A shell's `ulimit`, then the command.
fn limited(folder: &Path, limit: &str, arguments: &str) -> Output {
    Command::new("sh")
        .args(["-c", &format!("ulimit {limit} && exec \"$0\" {arguments}")])
        .arg(env!("CARGO_BIN_EXE_asperity"))
        .current_dir(folder)
        .output()
        .expect("sh runs")
}

#[test]
fn too_few_open_files_are_called_that_and_leave_the_output_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let target = folder.path().join("x.asp");
    for before in [None, Some(b"before".as_slice())] {
        let (mut refused, mut written) = (0, 0);
        for files in 4..24 {
            match before {
                Some(bytes) => fs::write(&target, bytes).expect("a file"),
                None => drop(fs::remove_file(&target)),
            }
            let output = limited(folder.path(), &format!("-n {files}"), "builtin -o x.asp");
            let error = text(&output.stderr);
            match output.status.code() {
                Some(0) => written += 1,
                // The system could not load its own libraries.
                Some(127) if error.contains("shared libraries") => {}
                Some(1) => {
                    refused += 1;
                    assert!(error.contains("ulimit -n"), "{files} files: {error}");
                    assert!(!error.contains("read-only"), "{files} files: {error}");
                    let left = fs::read(&target).ok();
                    assert_eq!(left.as_deref(), before, "{files} files");
                }
                other => panic!("{files} files: {other:?}: {error}"),
            }
            let others: Vec<_> = entries(folder.path())
                .into_iter()
                .filter(|name| name != "x.asp")
                .collect();
            assert_eq!(others, [""; 0], "{files} files");
        }
        assert!(
            refused > 0 && written > 0,
            "{refused} refused, {written} written"
        );
    }
}

#[test]
fn a_file_that_may_not_grow_is_an_error_that_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    // One block, of 512 or 1024 bytes; the texture takes more.
    let output = limited(folder.path(), "-f 1", "builtin -o x.asp");
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(
        error.contains("x.asp") && error.contains("ulimit -f"),
        "{error}"
    );
    assert_eq!(entries(folder.path()), [""; 0]);
}

#[test]
fn every_signal_that_ends_a_command_leaves_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    let lines: String = (0..20_000).fold(String::new(), |mut lines, n| {
        let _ = writeln!(
            lines,
            "{{\"name\": \"{n}\", \"prompt\": \"cork\", \"seed\": {n}}}"
        );
        lines
    });
    fs::write(folder.path().join("list.jsonl"), lines).expect("a list");
    for signal in [
        "HUP", "INT", "QUIT", "ALRM", "TERM", "USR1", "USR2", "XCPU", "VTALRM", "PROF",
    ] {
        let mut build = Command::new(env!("CARGO_BIN_EXE_asperity"))
            .args([
                "build",
                "list.jsonl",
                "-o",
                "out.aspl",
                "--no-cache",
                "--no-preview",
            ])
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("it starts");
        let began = Instant::now();
        let has_begun = || {
            entries(folder.path())
                .iter()
                .any(|name| name.starts_with(".asperity-"))
        };
        while !has_begun() && began.elapsed() < Duration::from_secs(60) {
            sleep(Duration::from_millis(2));
        }
        assert!(has_begun(), "{signal}: nothing was begun");
        let kill = format!("kill -{signal} {}", build.id());
        let sent = Command::new("sh")
            .args(["-c", &kill])
            .status()
            .expect("sh runs");
        assert!(sent.success(), "{kill}");
        assert_eq!(build.wait().expect("it ends").code(), Some(130), "{signal}");
        assert_eq!(entries(folder.path()), ["list.jsonl"], "{signal}");
    }
}
