//! Outputs that are written, kept and refused.

use super::*;
use crate::diagnostic::Diagnostic as _;
use std::{
    fs,
    io::{self, Write as _},
    path::PathBuf,
};
use tempfile::TempDir;

fn entries(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// A folder with the file `in.json` and the folder `sub`.
fn folder() -> (TempDir, impl Fn(&str) -> PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().to_owned();
    let at = move |name: &str| root.join(name);
    fs::write(at("in.json"), b"{}").unwrap();
    fs::create_dir(at("sub")).unwrap();
    (folder, at)
}

/// Why these outputs cannot be opened together.
fn refused(inputs: &[&Path], outputs: &[&Path]) -> Option<OpenError> {
    let mut opened = Outputs::beside(inputs);
    outputs.iter().find_map(|path| opened.open(path).err())
}

#[test]
fn a_committed_file_replaces_and_leaves_nothing_beside() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("a.asp");
    write_atomic(&target, b"old").unwrap();
    write_atomic(&target, b"new").unwrap();
    assert_eq!(fs::read(&target).unwrap(), b"new");
    assert_eq!(entries(folder.path()), ["a.asp"]);
}

#[test]
fn an_abandoned_file_leaves_the_target_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("a.asp");
    write_atomic(&target, b"old").unwrap();
    let mut file = AtomicFile::create(&target).unwrap();
    file.write_all(b"half").unwrap();
    drop(file);
    assert_eq!(fs::read(&target).unwrap(), b"old");
    assert_eq!(entries(folder.path()), ["a.asp"]);
}

#[test]
fn a_missing_folder_and_a_folder_as_target_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let missing = write_atomic(&folder.path().join("no/a.asp"), b"x").unwrap_err();
    assert_eq!(missing.source.kind(), io::ErrorKind::NotFound);
    let is_folder = write_atomic(folder.path(), b"x").unwrap_err();
    assert_eq!(is_folder.source.kind(), io::ErrorKind::IsADirectory);
}

#[test]
fn a_failed_folder_leaves_nothing() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("out");
    let files = [
        ("a.asp".to_owned(), b"a".as_slice()),
        ("no/b.asp".to_owned(), b"b".as_slice()),
    ];
    assert!(write_folder(&folder, &files).is_err());
    assert!(!folder.exists());
    assert!(write_folder(&folder, &files[..1]).is_ok());
    assert_eq!(entries(&folder), ["a.asp"]);
    let input = folder.join("a.asp");
    assert!(write_folder_beside(&[input], &folder, &files[..1]).is_err());
}

#[test]
fn a_read_only_file_is_not_replaced() {
    let (_folder, at) = folder();
    let target = at("in.json");
    let mut permissions = fs::metadata(&target).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&target, permissions).unwrap();
    let error = write_atomic(&target, b"new").unwrap_err();
    assert!(error.to_string().contains("read-only"), "{error}");
    assert_eq!(fs::read(&target).unwrap(), b"{}");
}

#[cfg(unix)]
#[test]
fn a_replaced_file_keeps_its_permissions() {
    use std::os::unix::fs::PermissionsExt as _;
    let (_folder, at) = folder();
    for mode in [0o600, 0o640, 0o755] {
        fs::set_permissions(at("in.json"), fs::Permissions::from_mode(mode)).unwrap();
        write_atomic(&at("in.json"), b"new").unwrap();
        let kept = fs::metadata(at("in.json")).unwrap().permissions().mode();
        assert_eq!(kept & 0o777, mode);
    }
}

#[test]
fn one_file_by_two_paths_is_found() {
    let (_folder, at) = folder();
    let input = at("in.json");
    let is_input = |path: &Path| {
        let error = refused(&[&input], &[path]);
        matches!(error, Some(OpenError::Same { other, .. }) if other == "an input")
    };
    assert!(!is_input(&at("out.asp")));
    assert!(is_input(&at("in.json")));
    assert!(is_input(&at("sub/../in.json")));
    fs::hard_link(&input, at("hard")).unwrap();
    assert!(is_input(&at("hard")));
    let twice = refused(&[], &[&at("new.asp"), &at("sub/../new.asp")]);
    assert!(matches!(twice, Some(OpenError::Same { other, .. }) if other == "another output"));
    let case = refused(&[], &[&at("new.asp"), &at("sub/../NEW.asp")]);
    assert!(matches!(case, Some(OpenError::Case { .. })));
    assert!(refused(&[], &[&at("new.asp"), &at("sub/NEW.asp")]).is_none());
}

#[cfg(unix)]
#[test]
fn links_are_followed_also_where_they_lead_nowhere_yet() {
    use std::os::unix::fs::symlink;
    let (_folder, at) = folder();
    symlink("in.json", at("link")).unwrap();
    assert!(refused(&[&at("in.json")], &[&at("link")]).is_some());
    symlink("sub/new.asp", at("dangling")).unwrap();
    let both = [at("dangling"), at("sub/new.asp")];
    assert!(refused(&[], &[&both[0], &both[1]]).is_some());
    write_atomic(&both[0], b"new").unwrap();
    assert_eq!(fs::read(&both[1]).unwrap(), b"new");
    assert!(fs::symlink_metadata(&both[0]).unwrap().is_symlink());
    let null = Path::new("/dev/null");
    assert!(refused(&[null], &[null, null]).is_none());
}

#[test]
fn only_one_output_goes_to_standard_output() {
    let stdout = Path::new("-");
    let twice = refused(&[], &[stdout, stdout]);
    assert!(matches!(twice, Some(OpenError::TwoToStandardOutput)));
    let mut outputs = Outputs::beside([""; 0]);
    assert!(!outputs.to_standard_output());
    outputs.open(stdout).unwrap();
    assert!(outputs.to_standard_output());
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_is_written_to_not_replaced() {
    let full = write_atomic(Path::new("/dev/full"), b"x").unwrap_err();
    assert_eq!(full.source.kind(), io::ErrorKind::StorageFull);
    write_atomic(Path::new("/dev/null"), b"x").unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

/// More files than a process may have open become one folder, and become it again.
#[cfg(unix)]
#[test]
fn a_folder_of_files_takes_no_open_files() {
    let open = || fs::read_dir("/proc/self/fd").map_or(0, Iterator::count);
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("files");
    for content in ["a", "b"] {
        if content == "a" {
            write_folder(&folder, &[("first".into(), b"")]).unwrap();
        }
        let mut outputs = Outputs::beside([outer.path()]);
        let before = open();
        for n in 0..300 {
            let id = outputs.open(&folder.join(format!("{n}.asp"))).unwrap();
            outputs.fill(id, content.as_bytes()).unwrap();
            outputs.file(id).close().unwrap();
        }
        // Other tests open files meanwhile.
        assert!(open() < before + 200, "{} and {before}", open());
        outputs.commit().unwrap();
        assert_eq!(fs::read_to_string(folder.join("299.asp")).unwrap(), content);
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 301);
    }
}

/// An interrupt removes what is unfinished in the opposite order of paths.
#[test]
fn what_is_unfinished_in_a_new_folder_is_listed_below_it() {
    let here = tempfile::tempdir_in(".").unwrap();
    let relative = Path::new(here.path().file_name().unwrap()).join("new");
    let absolute = fs::canonicalize(here.path()).unwrap().join("new");
    let below = || {
        let list = unfinished::unfinished();
        list.iter()
            .filter(|path| path.starts_with(&absolute))
            .count()
    };
    let filled = WholeFolder::create(&relative).unwrap();
    filled.write("a/b.txt", b"b").unwrap();
    assert_eq!(
        below(),
        4,
        "the folder, the hidden one, and what is in that"
    );
    drop(filled);
    assert_eq!(below(), 0);
    let made = folder::NewFolder::make(&relative).unwrap();
    let file = AtomicFile::create(&relative.join("c.txt")).unwrap();
    assert_eq!(below(), 2);
    drop((file, made));
    assert_eq!(below(), 0);
    assert!(!relative.exists());
}

#[test]
fn the_files_of_a_whole_folder_appear_together_or_not_at_all() {
    let (_kept, at) = folder();
    for (name, stays) in [("sub", true), ("new", false)] {
        let target = at(name);
        let filled = WholeFolder::create(&target).unwrap();
        filled.write("a.txt", b"old").unwrap();
        filled.write("b/c/d.txt", b"d").unwrap();
        filled.write("b/e.txt", b"e").unwrap();
        assert!(!target.join("a.txt").exists(), "{name}");
        drop(filled);
        assert_eq!(target.exists(), stays, "{name}: as it was");
        if stays {
            assert!(entries(&target).is_empty(), "{name}");
        }

        let filled = WholeFolder::create(&target).unwrap();
        filled.write("a.txt", b"old, and longer").unwrap();
        filled.write("a.txt", b"new").unwrap();
        filled.write("b/c/d.txt", b"d").unwrap();
        filled.commit().unwrap();
        assert_eq!(entries(&target), ["a.txt", "b"], "{name}");
        assert_eq!(fs::read(target.join("a.txt")).unwrap(), b"new");
        assert_eq!(fs::read(target.join("b/c/d.txt")).unwrap(), b"d");
        assert!(
            !unfinished::unfinished()
                .iter()
                .any(|path| path.starts_with(&target))
        );
    }
    for (name, named) in [
        ("new", "remove what is in this one"),
        ("in.json", "give a folder"),
        ("gone/new", "create the folder first"),
        ("-", "give a folder"),
    ] {
        let target = if name == "-" {
            PathBuf::from("-")
        } else {
            at(name)
        };
        let error = WholeFolder::create(&target).unwrap_err();
        assert!(error.remedy().contains(named), "{name}: {error}");
    }
    assert_eq!(entries(&at("new")), ["a.txt", "b"], "as it was");
}
