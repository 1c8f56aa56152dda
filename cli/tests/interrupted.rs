//! Builds that were killed go on where they stopped, to the same bytes.

use super::*;
use std::{
    process::{Child, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

/// Materials of a manifest: enough that a build takes longer than the first kills.
const MATERIALS: usize = 24;

/// A manifest of imports and prompts, and blends of them.
fn manifest(folder: &Path) {
    let mut manifest = "[defaults]\npreview = false\n".to_owned();
    for n in 0..MATERIALS {
        let mu = format!("<mu>0.{}</mu>", 10 + n);
        let wood = material("Wood").replace("<mu>0.4</mu>", &mu);
        fs::write(folder.join(format!("{n}.xml")), wood).expect("a material");
        let _ = writeln!(
            manifest,
            "[[texture]]\nname = \"wood {n}\"\nimport = \"{n}.xml\"\nfidelity = \"auto\""
        );
    }
    for (n, prompt) in ["hard velvet", "cork", "wet ice", "rough bark"]
        .iter()
        .enumerate()
    {
        let _ = writeln!(
            manifest,
            "[[texture]]\nprompt = \"{prompt}\"\n\
             [[texture]]\nname = \"mix {n}\"\nblend = {{ a = \"{prompt}\", b = \"wood {n}\" }}"
        );
    }
    fs::write(folder.join("library.toml"), manifest).expect("a manifest");
}

fn start(folder: &Path, more: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_asperity"))
        .args(["build", "library.toml", "--cache", "cache"])
        .args(more)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts")
}

/// Files in the cache.
fn cached(folder: &Path) -> usize {
    let Ok(shelves) = fs::read_dir(folder.join("cache")) else {
        return 0;
    };
    let shelves = shelves.filter_map(|shelf| fs::read_dir(shelf.ok()?.path()).ok());
    shelves.map(Iterator::count).sum()
}

#[test]
fn killed_builds_are_resumed_and_parts_are_merged_to_the_same_bytes() {
    let whole = tempfile::tempdir().expect("a folder");
    let broken = tempfile::tempdir().expect("a folder");
    manifest(whole.path());
    manifest(broken.path());
    let done = start(whole.path(), &["-o", "out.aspl"])
        .wait()
        .expect("it ends");
    assert!(done.success());
    let expected = fs::read(whole.path().join("out.aspl")).expect("a library");
    // Killed (SIGKILL on Unix) as soon as the cache has so many entries more.
    let mut kills = 0;
    for more in [1, 3, 9] {
        let out = broken.path().join("out.aspl");
        let _ = fs::remove_file(&out);
        let least = cached(broken.path()) + more;
        let mut build = start(broken.path(), &["-o", "out.aspl"]);
        let began = Instant::now();
        while cached(broken.path()) < least && began.elapsed() < Duration::from_secs(120) {
            if build.try_wait().expect("a status").is_some() {
                break;
            }
            sleep(Duration::from_millis(1));
        }
        kills += usize::from(build.kill().is_ok());
        let killed = build.wait().expect("it ends");
        // The library is whole or not there.
        match fs::read(&out) {
            Ok(bytes) => assert!(bytes == expected),
            Err(_) => assert!(!killed.success()),
        }
    }
    assert!(kills > 0);
    let done = start(broken.path(), &["-o", "out.aspl"])
        .wait()
        .expect("it ends");
    assert!(done.success());
    assert!(fs::read(broken.path().join("out.aspl")).expect("a library") == expected);
    // A killed build may leave its temporary file, and nothing else.
    let left = entries(broken.path());
    let strange = left.iter().filter(|name| {
        let known = ["library.toml", "library.toml.lock", "out.aspl", "cache"];
        let temporary = name.starts_with(".asperity-");
        !known.contains(&name.as_str()) && !name.ends_with(".xml") && !temporary
    });
    assert_eq!(strange.count(), 0, "{left:?}");
    for part in 1..=4 {
        let (shard, file) = (format!("{part}/4"), format!("{part}.aspl"));
        let done = start(broken.path(), &["--shard", &shard, "-o", &file]).wait();
        assert!(done.expect("it ends").success());
    }
    let merge = [
        "merge",
        "4.aspl",
        "2.aspl",
        "1.aspl",
        "3.aspl",
        "-o",
        "merged.aspl",
    ];
    assert!(asperity(broken.path(), &merge).status.success());
    assert!(fs::read(broken.path().join("merged.aspl")).expect("a library") == expected);
}
