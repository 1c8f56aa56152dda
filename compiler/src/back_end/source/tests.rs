//! What opens, and what is refused.

use super::*;
use crate::diagnostic::Diagnostic as _;
use crate::{
    back_end::{
        library::{NamedAsset, encode},
        lower::lower,
    },
    front_ends::builtin,
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
        SourceProblem::Unreadable(_)
    ));
}
