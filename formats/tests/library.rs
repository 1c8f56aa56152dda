//! Libraries: random access to a texture without reading the others.

use crate::common;
use crate::common::{crc32, full, put, small};
use asperity_formats::{
    Asset, EncodeError, FormatError, Library,
    library::{
        HEADER_LEN, IndexedTexture, LibraryIndex, encode_index, encode_library, encoded_index_len,
        encoded_len, index_len,
    },
};
use std::{
    fs::File,
    io::{Read, Seek, SeekFrom, Write},
};

const ENTRY: usize = 24;

fn shelf(textures: &[(&str, &[u8])]) -> Vec<u8> {
    let mut bytes = vec![0xaa; encoded_len(textures)];
    let len = encode_library(textures, &mut bytes).expect("a valid library");
    assert_eq!(len, bytes.len());
    bytes
}

fn three() -> Vec<u8> {
    let (cork, brick) = (small().encode(), full().encode());
    shelf(&[("Brick", &brick), ("Cork", &cork), ("Ünder", &cork)])
}

/// Recomputes the CRC of the index.
fn seal(library: &mut [u8]) {
    let len = common::u32_at(library, 12) as usize;
    let crc = crc32(
        library[..24]
            .iter()
            .chain(&library[HEADER_LEN..len])
            .copied(),
    );
    put(library, 24, &crc.to_le_bytes());
}

#[test]
fn textures_are_found_by_index_and_by_name() {
    let bytes = three();
    let library = Library::parse(&bytes).unwrap();
    let index = library.index();
    assert_eq!(
        (index.len(), index.is_empty(), index.total_len()),
        (3, false, bytes.len() as u64)
    );
    assert_eq!(library.bytes(0), Ok(&full().encode()[..]));
    assert_eq!(library.bytes(2), Ok(&small().encode()[..]));
    for (at, entry) in index.entries().enumerate() {
        assert_eq!(index.find(entry.name), Some(at));
        let asset = library.asset(at).unwrap();
        assert_eq!(asset.haptic_len(), entry.haptic_len as usize);
        assert_eq!(asset.total_len(), entry.len as usize);
    }
    for absent in ["", "Bric", "Brick ", "brick", "Cork\0", "Z", "ß"] {
        assert_eq!(index.find(absent), None, "{absent:?}");
    }
    for absent in [3, 4, usize::MAX, usize::MAX / 24, usize::MAX / 24 + 1] {
        assert_eq!(index.get(absent), None);
        let error = FormatError::NoSuchTexture {
            index: absent,
            count: 3,
        };
        assert_eq!(library.bytes(absent), Err(error));
        assert_eq!(library.asset(absent).map(drop), Err(error));
    }
}

#[test]
fn an_empty_library_is_valid() {
    let bytes = shelf(&[]);
    assert_eq!(bytes.len(), HEADER_LEN);
    let library = Library::parse(&bytes).unwrap();
    assert!(library.index().is_empty());
    assert_eq!(library.index().find("Cork"), None);
}

#[test]
fn names_of_any_number_of_textures_are_all_found() {
    let asset = small().encode();
    for count in [1, 2, 3, 64, 100] {
        let names: Vec<_> = (0..count).map(|n| format!("texture {n:03}")).collect();
        let textures: Vec<_> = names.iter().map(|n| (n.as_str(), &asset[..])).collect();
        let bytes = shelf(&textures);
        let index = LibraryIndex::parse(&bytes).unwrap();
        for (at, name) in names.iter().enumerate() {
            assert_eq!(index.find(name), Some(at));
        }
    }
}

/// A file that counts what is read from it.
struct Counted(File, usize);

impl Counted {
    fn read(&mut self, offset: u64, len: usize) -> Vec<u8> {
        let mut bytes = vec![0; len];
        self.0.seek(SeekFrom::Start(offset)).unwrap();
        self.0.read_exact(&mut bytes).unwrap();
        self.1 += len;
        bytes
    }
}

#[test]
fn one_texture_is_read_from_a_file_without_the_rest() {
    let bytes = three();
    let mut file = tempfile::tempfile().unwrap();
    // The other assets are missing, which shows that nothing else is read.
    let entry_span = {
        let index = LibraryIndex::parse(&bytes).unwrap();
        let entry = index.get(1).unwrap();
        entry.offset as usize..entry.offset as usize + entry.haptic_len as usize
    };
    let len = index_len(&bytes).unwrap();
    let mut holes = vec![0xee; bytes.len()];
    holes[..len].copy_from_slice(&bytes[..len]);
    holes[entry_span.clone()].copy_from_slice(&bytes[entry_span]);
    file.write_all(&holes).unwrap();

    let mut file = Counted(file, 0);
    let header = file.read(0, HEADER_LEN);
    let index_bytes = file.read(0, index_len(&header).unwrap());
    let index = LibraryIndex::parse(&index_bytes).unwrap();
    let entry = index.get(index.find("Cork").unwrap()).unwrap();
    let haptic = file.read(entry.offset, entry.haptic_len as usize);
    assert_eq!(Asset::parse_haptic(&haptic).unwrap().name(), "Cork");
    assert_eq!(
        file.1,
        HEADER_LEN + index_bytes.len() + entry.haptic_len as usize
    );
}

#[test]
fn a_library_in_flash_is_read_in_place() {
    // As `include_bytes!` gives it: a static without a particular alignment.
    static FLASH: &[u8] = include_bytes!("data/two-v1.aspl");
    let library: Library<'static> = Library::parse(FLASH).expect("the committed library");
    let names: Vec<&'static str> = library.index().entries().map(|e| e.name).collect();
    assert_eq!(names, ["Cork", "Cork 2"]);
    let asset: Asset<'static> = library.asset(1).unwrap();
    assert!(
        FLASH.as_ptr_range().contains(&asset.name().as_ptr()),
        "borrowed, not copied"
    );

    let mut shifted = vec![0; FLASH.len() + 1];
    shifted[1..].copy_from_slice(FLASH);
    assert!(
        Library::parse(&shifted[1..]).unwrap().asset(0).is_ok(),
        "at any alignment"
    );
}

#[test]
fn the_committed_library_is_what_is_written_today() {
    let cork = small().encode();
    let bytes = shelf(&[("Cork", &cork), ("Cork 2", &cork)]);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/two-v1.aspl");
    if std::env::var_os("ASPERITY_BLESS").is_some() {
        std::fs::write(path, &bytes).unwrap();
    }
    let committed = std::fs::read(path).unwrap();
    assert!(
        committed == bytes,
        "the writer changed its bytes; if version 1 was never released, run\n\
         ASPERITY_BLESS=1 cargo test -p asperity-formats --test it library::"
    );
}

#[test]
fn names_must_ascend_and_differ() {
    let asset = small().encode();
    for names in [["B", "A"], ["A", "A"], ["a", "B"]] {
        let textures = names.map(|name| (name, &asset[..]));
        let mut bytes = vec![0; encoded_len(&textures)];
        assert_eq!(
            encode_library(&textures, &mut bytes),
            Err(EncodeError::Rejected(FormatError::Text {
                field: "library.entry.name",
                index: 1,
                reason: "names must ascend and differ"
            }))
        );
    }
}

/// The front alone, and the assets behind it, are the library.
#[test]
fn an_index_and_its_assets_are_a_library() {
    let library = three();
    let parsed = Library::parse(&library).unwrap();
    let listed: Vec<IndexedTexture<'_>> = parsed
        .index()
        .entries()
        .map(|entry| IndexedTexture {
            name: entry.name,
            len: entry.len,
            haptic_len: entry.haptic_len,
        })
        .collect();
    let mut front = vec![0; encoded_index_len(&listed)];
    let (index_len, total_len) = encode_index(&listed, &mut front).unwrap();
    assert_eq!((index_len, total_len), (front.len(), library.len() as u64));
    assert_eq!(front, library[..front.len()]);
    let twice = [listed[0], listed[0]];
    let mut front = vec![0; encoded_index_len(&twice)];
    assert!(encode_index(&twice, &mut front).is_err());
    assert!(encode_index(&twice, &mut front[1..]).is_err());
}

#[test]
fn an_asset_that_does_not_parse_is_not_shelved() {
    let mut asset = small().encode();
    asset[30] ^= 1;
    let textures = [("A", &asset[..])];
    let mut bytes = vec![0; encoded_len(&textures)];
    assert!(matches!(
        encode_library(&textures, &mut bytes),
        Err(EncodeError::Rejected(FormatError::Checksum { .. }))
    ));
    for room in 0..bytes.len() {
        assert!(encode_library(&[("A", &small().encode())], &mut bytes[..room]).is_err());
    }
}

#[test]
fn an_index_is_as_long_as_names_can_be_and_ends_with_the_last_one() {
    let whole = three();
    let least = HEADER_LEN + 3 * (ENTRY + 1);
    let most = HEADER_LEN + 3 * (ENTRY + 64);
    for (len, fits) in [
        (least - 1, false),
        (least, true),
        (most, true),
        (most + 1, false),
    ] {
        let mut header = whole[..HEADER_LEN].to_vec();
        put(&mut header, 12, &(len as u32).to_le_bytes());
        assert_eq!(index_len(&header).ok(), fits.then_some(len), "{len}");
    }
    // A byte behind the last name; everything behind it moves along.
    let mut bytes = whole.clone();
    bytes.insert(index_len(&whole).unwrap(), b'x');
    let entries = [0, 1, 2].map(|entry| HEADER_LEN + ENTRY * entry);
    for at in [12, 16].into_iter().chain(entries) {
        let moved = common::u32_at(&bytes, at) + 1;
        put(&mut bytes, at, &moved.to_le_bytes());
    }
    seal(&mut bytes);
    let error = Library::parse(&bytes).map(drop).unwrap_err();
    let field = "library.index_len";
    assert!(
        matches!(error, FormatError::Invalid { field: f, .. } if f == field),
        "{error:?}"
    );
}

#[test]
fn every_field_of_the_index_is_checked() {
    let original = three();
    let at = |entry: usize, offset: usize| HEADER_LEN + ENTRY * entry + offset;
    let first = common::u32_at(&original, 12);
    // Offset, patch, field, index, value.
    let cases: [(usize, &[u8], &str, u32, f64); 13] = [
        (6, &[1, 0], "library.flags", 0, 1.0),
        (8, &[0, 0, 16, 1], "library.count", 0, 17825792.0),
        (8, &[255; 4], "library.count", 0, 4294967295.0),
        (8, &[99, 0, 0, 0], "library.index_len", 0, first.into()),
        (12, &[0; 4], "library.index_len", 0, 0.0),
        (12, &[255; 4], "library.index_len", 0, 4294967295.0),
        (
            16,
            &[255; 8],
            "library.total_len",
            0,
            18446744073709551615.0,
        ),
        (
            at(1, 0),
            &[255; 8],
            "library.entry.offset",
            1,
            18446744073709551615.0,
        ),
        (at(2, 0), &[0; 8], "library.entry.offset", 2, 0.0),
        (
            at(1, 12),
            &[255; 4],
            "library.entry.haptic_len",
            1,
            4294967295.0,
        ),
        (at(2, 16), &[0; 4], "library.entry.name_offset", 2, 0.0),
        (at(0, 22), &[1, 0], "library.entry.reserved", 0, 1.0),
        (at(1, 8), &[255; 4], "library.entry.offset", 2, 0.0),
    ];
    for (offset, piece, field, index, value) in cases {
        let mut bytes = original.clone();
        put(&mut bytes, offset, piece);
        if !matches!(offset, 8 | 12) {
            seal(&mut bytes);
        }
        let error = Library::parse(&bytes).map(drop).unwrap_err();
        let FormatError::Invalid {
            field: f,
            index: i,
            value: v,
            ..
        } = error
        else {
            panic!("byte {offset} = {piece:02x?}: {error:?}");
        };
        // A wrong length shifts the offset of the entry behind it.
        let value = if offset == at(1, 8) { v } else { value };
        assert_eq!(
            (f, i, v),
            (field, index, value),
            "byte {offset} = {piece:02x?}"
        );
    }
    for (offset, piece, index, reason) in [
        (at(0, 20), [0, 0], 0, "empty"),
        (at(0, 20), [6, 0], 0, ""),
        (at(2, 20), [65, 0], 2, "empty"),
        (at(2, 20), [255, 255], 2, "empty"),
    ] {
        let mut bytes = original.clone();
        put(&mut bytes, offset, &piece);
        seal(&mut bytes);
        let error = Library::parse(&bytes).map(drop).unwrap_err();
        match error {
            FormatError::Text {
                field: "library.entry.name",
                index: i,
                reason: r,
            } => {
                assert_eq!((i, r), (index, reason));
            }
            // A name that takes the first byte of its neighbour shifts the next one.
            FormatError::Invalid {
                field: "library.entry.name_offset",
                index: 1,
                ..
            } => {
                assert_eq!(reason, "");
            }
            _ => panic!("byte {offset} = {piece:02x?}: {error:?}"),
        }
    }
    for version in [0_u16, 3, 256] {
        let mut bytes = original.clone();
        put(&mut bytes, 4, &version.to_le_bytes());
        assert_eq!(
            Library::parse(&bytes).map(drop),
            Err(FormatError::Version {
                found: version,
                supported: 2
            })
        );
    }
    assert_eq!(
        Library::parse(&small().encode()).map(drop),
        Err(FormatError::Magic {
            found: *b"ASPT",
            expected: *b"ASPL"
        })
    );
}

/// The index cannot show this damage, but the asset can.
#[test]
fn a_haptic_length_that_is_not_the_assets_is_found_when_it_is_read() {
    let mut bytes = three();
    let at = HEADER_LEN + ENTRY + 12;
    let stated = common::u32_at(&bytes, at) - 1;
    put(&mut bytes, at, &stated.to_le_bytes());
    seal(&mut bytes);
    let library = Library::parse(&bytes).unwrap();
    assert!(library.asset(0).is_ok() && library.asset(2).is_ok());
    // However it is read: whole, as bytes, or by the index alone.
    let entry = library.index().get(1).unwrap();
    let end = entry.offset as usize + entry.len as usize;
    for refused in [
        library.asset(1).map(drop),
        library.bytes(1).map(drop),
        entry.check(1, &bytes[entry.offset as usize..end]),
    ] {
        let error = refused.unwrap_err();
        assert!(
            matches!(error, FormatError::Invalid { field: "library.entry.haptic_len", index: 1, value, .. }
                if value == f64::from(stated)),
            "{error}"
        );
    }
    // An asset that is damaged itself is named as such.
    let start = entry.offset as usize;
    bytes[start + 8] ^= 1;
    let damaged = Library::parse(&bytes).unwrap().asset(1).map(drop);
    let header = FormatError::Checksum {
        section: "header",
        stated: 0,
        computed: 0,
    };
    assert_eq!(
        damaged.map_err(|e| std::mem::discriminant(&e)),
        Err(std::mem::discriminant(&header))
    );
}
