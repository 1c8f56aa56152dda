//! Files that open, and files that are refused.

use super::*;
use crate::{
    emit::{
        lower::lower,
        pack::{NamedAsset, encode},
    },
    sources::builtin,
};
use asperity_formats::Asset;
use asperity_io::diagnostic::Diagnostic as _;
use asperity_io::input::InputProblem;
use std::fs;

/// A library that holds the same asset under every name.
pub(crate) fn library_of(names: &[String], asset: &[u8]) -> Vec<u8> {
    let assets: Vec<_> = (names.iter())
        .map(|name| NamedAsset { name, bytes: asset })
        .collect();
    encode(&assets).unwrap()
}

fn problem(error: TexturesError) -> TexturesProblem {
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
    let mut textures = Textures::open(&path).unwrap();
    assert_eq!(textures.names().unwrap(), ["a", "b"]);
    for (wanted, name) in [("a", "a"), ("b", "b"), ("0", "a"), ("1", "b")] {
        let chosen = textures.choose(Some(wanted)).unwrap();
        assert_eq!(Asset::parse(&chosen).unwrap().name(), name);
    }
    let missing = problem(textures.choose(Some("2")).unwrap_err());
    assert!(matches!(
        missing,
        TexturesProblem::NoSuchTexture { count: 2, .. }
    ));
    let none = textures.choose(None).unwrap_err();
    assert!(none.is_usage());
}

/// Pipes and standard input open as files do.
#[test]
fn an_asset_or_a_library_comes_through_a_reader() {
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let library = encode(&[NamedAsset {
        name: "a",
        bytes: &asset,
    }])
    .unwrap();
    for bytes in [&asset, &library] {
        let mut textures = Textures::from_reader(Path::new("-"), &bytes[..]).unwrap();
        assert_eq!(textures.choose(None).unwrap(), asset);
    }
    let endless = Textures::from_reader(Path::new("-"), std::io::repeat(b'A')).unwrap_err();
    let text = endless.to_string();
    assert!(text.contains("-: larger than 67108864 bytes"), "{text}");
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
    assert_eq!(Textures::open(&path).unwrap().choose(None).unwrap(), asset);
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
    let refused = problem(Textures::open(&path).unwrap_err());
    assert!(matches!(
        refused,
        TexturesProblem::Format(asperity_formats::FormatError::TooShort { .. })
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
        let mut textures = Textures::open(&path).map_err(problem)?;
        textures.choose(None).map_err(problem)
    };
    assert!(open(&asset).is_ok() && open(&library).is_ok());
    for bytes in [b"ASP".as_slice(), b"<?xml version"] {
        assert!(matches!(open(bytes), Err(TexturesProblem::WrongKind)));
    }
    let empty = open(b"");
    assert!(matches!(
        empty,
        Err(TexturesProblem::Input(InputProblem::Empty))
    ));
    for len in [4, 20, 27, 40, 100, library.len() - 1] {
        assert!(matches!(
            open(&library[..len]),
            Err(TexturesProblem::Format(_))
        ));
    }
    for len in [4, 20, 100, asset.len() - 1] {
        assert!(matches!(
            open(&asset[..len]),
            Err(TexturesProblem::Format(_))
        ));
    }
    assert!(matches!(
        problem(Textures::open(folder.path()).unwrap_err()),
        TexturesProblem::Input(InputProblem::Folder)
    ));
}

/// Counts the bytes that are read of it.
#[derive(Debug)]
struct Counting(
    Cursor<Vec<u8>>,
    std::sync::Arc<std::sync::atomic::AtomicUsize>,
);

impl Read for Counting {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.0.read(buffer)?;
        self.1.fetch_add(read, std::sync::atomic::Ordering::Relaxed);
        Ok(read)
    }
}

impl Seek for Counting {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.seek(to)
    }
}

/// Bytes that are read, and entries of the index, where all textures of a library are read, found
/// by name, and looked at.
fn work(count: usize) -> usize {
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let names: Vec<String> = (0..count).map(|n| format!("t{n:05}")).collect();
    let bytes = library_of(&names, &asset);
    let read = std::sync::Arc::default();
    let entries = index::ENTRIES_READ.get();
    let counting = Counting(Cursor::new(bytes), std::sync::Arc::clone(&read));
    let mut textures = Textures::with(Path::new("-"), Box::new(counting)).unwrap();
    for (index, name) in names.iter().enumerate() {
        assert_eq!(textures.texture(index).unwrap(), asset);
        assert_eq!(textures.choose(Some(name)).unwrap(), asset);
        assert_eq!(
            textures.chosen_name(Some(name)).unwrap().as_ref(),
            Some(name)
        );
    }
    let found = textures.each(|| (), |(), name, _| name.to_owned()).unwrap();
    assert_eq!(found, names);
    assert!(textures.library().unwrap().is_some());
    read.load(std::sync::atomic::Ordering::Relaxed) + index::ENTRIES_READ.get() - entries
}

#[test]
fn twice_the_textures_take_twice_the_work() {
    let (once, twice) = (work(200), work(400));
    let ratio = twice as f64 / once as f64;
    assert!((1.9..2.1).contains(&ratio), "{once} and {twice}: {ratio}");
    // The index is read when the library is opened, and never again.
    let before = index::ENTRIES_READ.get();
    work(100);
    assert_eq!(index::ENTRIES_READ.get() - before, 100);
}

/// Small or large, neighbours or alone: every texture is looked at once, and the first that is
/// damaged is named.
#[test]
fn each_texture_is_looked_at_once_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.aspl");
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let names: Vec<String> = (0..TOGETHER + 3).map(|n| format!("t{n:05}")).collect();
    let mut bytes = library_of(&names, &asset);
    fs::write(&path, &bytes).unwrap();
    let look = || {
        let mut textures = Textures::open(&path).unwrap();
        textures.each(
            || (),
            |(), name, asset| (name.to_owned(), asset.total_len()),
        )
    };
    let found = look().unwrap();
    assert!(
        found
            .iter()
            .zip(&names)
            .all(|((found, _), name)| found == name)
    );
    assert!(found.iter().all(|(_, len)| *len == asset.len()));
    assert_eq!(found.len(), names.len());
    let at = bytes.len() - asset.len() - 1;
    bytes[at] ^= 1;
    fs::write(&path, &bytes).unwrap();
    let damaged = look().unwrap_err();
    assert_eq!(damaged.texture.as_ref(), names.get(TOGETHER + 1));
    fs::write(&path, &asset).unwrap();
    assert_eq!(look().unwrap(), [("Built-in Grit".to_owned(), asset.len())]);
}

/// An index whose haptic length is not the asset's is refused however the texture is asked for.
#[test]
fn a_haptic_length_of_the_index_that_is_wrong_is_refused_by_every_reader() {
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let mut bytes = library_of(&["a".into(), "b".into()], &asset);
    // The second entry's; the checksum covers the first 24 bytes and all from 28 on.
    let at = library::HEADER_LEN + 24 + 12;
    bytes[at] ^= 1;
    let end = library::index_len(&bytes).unwrap();
    let sum = crc32fast::hash(&[&bytes[..24], &bytes[28..end]].concat());
    bytes[24..28].copy_from_slice(&sum.to_le_bytes());
    let mut textures = Textures::from_bytes(Path::new("x"), bytes.clone()).unwrap();
    assert!(textures.choose(Some("a")).is_ok());
    let names = |(): &mut (), name: &str, _: &Asset<'_>| name.to_owned();
    for refused in [
        textures.choose(Some("b")).map(drop),
        textures.texture(1).map(drop),
        textures.library().map(drop),
        textures.each(|| (), names).map(drop),
    ] {
        let error = refused.unwrap_err();
        assert_eq!(error.texture.as_deref(), Some("b"));
        let text = error.to_string();
        assert!(text.contains("haptic_len[1]"), "{text}");
    }
}

/// Claim: a library gives its own bytes and says whether it has a scene; an asset is no library.
#[test]
fn a_library_gives_its_bytes_and_tells_of_its_scene() {
    let asset = lower(&builtin::texture(), None).unwrap().bytes;
    let open = |bytes: &[u8]| Textures::from_reader(Path::new("-"), bytes).unwrap();
    let plain = library_of(&["a".into(), "b".into()], &asset);
    let surface = SceneSurface {
        solid: asperity_formats::Solid::Plane {
            point_m: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        },
        from_m: [-1.0; 3],
        to_m: [1.0; 3],
        texture: 0,
    };
    let mut scene = vec![0; 1 << 16];
    let textures = [("a", asset.as_slice())];
    let len = asperity_formats::library::encode_scene(&textures, &[surface], &mut scene).unwrap();
    scene.truncate(len);
    for (bytes, has_scene) in [(&plain, false), (&scene, true)] {
        let mut textures = open(bytes);
        assert!(textures.is_library());
        assert_eq!(textures.has_scene(), has_scene);
        assert_eq!(textures.surfaces().unwrap().len(), usize::from(has_scene));
        assert_eq!(textures.library().unwrap().as_ref(), Some(bytes));
    }
    let mut alone = open(&asset);
    assert!(!alone.is_library() && !alone.has_scene());
    assert_eq!(alone.library().unwrap(), None);
}

/// Claim: every problem has a remedy that fits it and names the file where that helps.
#[test]
fn each_problem_has_its_remedy() {
    let remedy = |problem| {
        let path = "all.aspl".into();
        TexturesError {
            path,
            texture: None,
            problem,
        }
        .remedy()
    };
    let version = FormatError::Version {
        found: 9,
        supported: 2,
    };
    for (problem, words) in [
        (TexturesProblem::Format(version), "update asperity"),
        (TexturesProblem::WrongKind, "`asperity compile`"),
        (TexturesProblem::NoneChosen { count: 3 }, "--texture"),
        (
            TexturesProblem::NoSuchTexture {
                wanted: "x".into(),
                count: 3,
                suggestion: None,
            },
            "list the names with `asperity list \"all.aspl\"`",
        ),
        (
            TexturesProblem::NoSuchTexture {
                wanted: "crok".into(),
                count: 3,
                suggestion: Some("did you mean \"cork\"?".into()),
            },
            "did you mean \"cork\"? `asperity list \"all.aspl\"`",
        ),
    ] {
        let found = remedy(problem);
        assert!(found.contains(words), "{found}");
    }
}
