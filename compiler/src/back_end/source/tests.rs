//! What opens, and what is refused.

use super::*;
use crate::diagnostic::Diagnostic as _;
use crate::input::InputProblem;
use crate::{
    back_end::lower::lower,
    front_ends::builtin,
    library::{NamedAsset, encode},
};
use asperity_formats::Asset;
use std::fs;

fn problem(error: SourceError) -> SourceProblem {
    error.problem
}

#[test]
fn a_texture_of_a_library_is_found_by_name_and_by_index() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.aspl");
    let bytes = ["b", "a"].map(|name| {
        let mut texture = builtin::texture();
        texture.name = name.into();
        lower(&texture, None).unwrap().bytes
    });
    let assets: Vec<NamedAsset<'_>> = ["b", "a"]
        .into_iter()
        .zip(&bytes)
        .map(|(name, bytes)| NamedAsset { name, bytes })
        .collect();
    fs::write(&path, encode(&assets).unwrap()).unwrap();
    let mut source = Source::open(&path).unwrap();
    assert_eq!(source.names().unwrap(), ["a", "b"]);
    for (wanted, name) in [("a", "a"), ("b", "b"), ("0", "a"), ("1", "b")] {
        let chosen = source.choose(Some(wanted)).unwrap();
        assert_eq!(Asset::parse(&chosen).unwrap().name(), name);
    }
    let missing = problem(source.choose(Some("2")).unwrap_err());
    assert!(matches!(
        missing,
        SourceProblem::NoSuchTexture { count: 2, .. }
    ));
    let none = source.choose(None).unwrap_err();
    assert!(none.is_usage());
}

/// What comes once, through a pipe or standard input, opens as a file does.
#[test]
fn an_asset_or_a_library_comes_through_a_reader() {
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let library = encode(&[NamedAsset {
        name: "a",
        bytes: &asset,
    }])
    .unwrap();
    for bytes in [&asset, &library] {
        let mut source = Source::from_reader(Path::new("-"), &bytes[..]).unwrap();
        assert_eq!(source.choose(None).unwrap(), asset);
    }
    let endless = Source::from_reader(Path::new("-"), std::io::repeat(b'A')).unwrap_err();
    let text = endless.to_string();
    assert!(text.contains("-: more than 67108864 bytes"), "{text}");
}

#[cfg(unix)]
#[test]
fn a_pipe_is_a_source() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&path).status();
    assert!(made.unwrap().success());
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let (writer, bytes) = (path.clone(), asset.clone());
    let write = std::thread::spawn(move || fs::write(writer, bytes));
    assert_eq!(Source::open(&path).unwrap().choose(None).unwrap(), asset);
    write.join().unwrap().unwrap();
}

/// A header that promises a million textures takes no more memory than the file has bytes.
#[test]
fn counts_of_an_index_are_not_believed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.aspl");
    let mut head = b"ASPL".to_vec();
    head.extend([1, 0, 0, 0]);
    head.extend((1_u32 << 20).to_le_bytes());
    head.extend((88_u32 << 20).to_le_bytes());
    head.resize(28, 0);
    fs::write(&path, head).unwrap();
    let refused = problem(Source::open(&path).unwrap_err());
    assert!(matches!(
        refused,
        SourceProblem::Format(asperity_formats::FormatError::TooShort { .. })
    ));
}

#[test]
fn other_and_damaged_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let library = encode(&[NamedAsset {
        name: "a",
        bytes: &asset,
    }])
    .unwrap();
    let open = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        let mut source = Source::open(&path).map_err(problem)?;
        source.choose(None).map_err(problem)
    };
    assert!(open(&asset).is_ok() && open(&library).is_ok());
    for bytes in [b"".as_slice(), b"ASP", b"<?xml version"] {
        assert!(matches!(open(bytes), Err(SourceProblem::WrongKind)));
    }
    for len in [4, 20, 27, 40, 100, library.len() - 1] {
        assert!(matches!(
            open(&library[..len]),
            Err(SourceProblem::Format(_))
        ));
    }
    for len in [4, 20, 100, asset.len() - 1] {
        assert!(matches!(open(&asset[..len]), Err(SourceProblem::Format(_))));
    }
    assert!(matches!(
        problem(Source::open(folder.path()).unwrap_err()),
        SourceProblem::Input(InputProblem::Folder)
    ));
}
