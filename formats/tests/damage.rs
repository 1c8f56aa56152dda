//! A file that is truncated at any byte, or that has any bit flipped, gives a typed error.

use crate::common::{falling, full, small};
use asperity_formats::{Asset, FormatError, Library, library};

/// Parses the whole asset, and the part that a runtime reads.
fn read(bytes: &[u8]) -> (Result<(), FormatError>, Result<(), FormatError>) {
    (
        Asset::parse(bytes).map(drop),
        Asset::parse_haptic(bytes).map(drop),
    )
}

#[test]
fn an_asset_truncated_at_any_byte_is_too_short() {
    for parts in [small(), full(), falling()] {
        let bytes = parts.encode();
        let haptic_len = Asset::parse(&bytes).unwrap().haptic_len();
        for len in 0..bytes.len() {
            let (whole, haptic) = read(&bytes[..len]);
            assert!(
                matches!(whole, Err(FormatError::TooShort { found, .. }) if found == len as u64),
                "{len} bytes: {whole:?}"
            );
            if len < haptic_len {
                assert!(
                    matches!(haptic, Err(FormatError::TooShort { .. })),
                    "{len}: {haptic:?}"
                );
            } else {
                assert_eq!(haptic, Ok(()), "{len} bytes hold every haptic section");
            }
        }
    }
}

#[test]
fn any_flipped_bit_of_an_asset_is_found() {
    for parts in [small(), full(), falling()] {
        let mut bytes = parts.encode();
        let haptic_len = Asset::parse(&bytes).unwrap().haptic_len();
        for bit in 0..bytes.len() * 8 {
            bytes[bit / 8] ^= 1 << (bit % 8);
            let (whole, haptic) = read(&bytes);
            assert!(whole.is_err(), "bit {bit} passed");
            assert_eq!(
                haptic.is_err(),
                bit / 8 < haptic_len,
                "bit {bit}: {haptic:?}"
            );
            bytes[bit / 8] ^= 1 << (bit % 8);
        }
        assert_eq!(read(&bytes), (Ok(()), Ok(())));
    }
}

#[test]
fn any_byte_of_any_value_is_an_error_or_the_original() {
    for parts in [small(), falling()] {
        let original = parts.encode();
        let mut bytes = original.clone();
        for at in 0..bytes.len() {
            for value in 0..=255 {
                bytes[at] = value;
                assert_eq!(
                    read(&bytes).0.is_ok(),
                    value == original[at],
                    "byte {at} = {value}"
                );
            }
            bytes[at] = original[at];
        }
    }
}

fn shelf() -> Vec<u8> {
    let (cork, brick) = (small().encode(), full().encode());
    let textures: [(&str, &[u8]); 3] = [("Brick", &brick), ("Cork", &cork), ("Cork 2", &cork)];
    let mut bytes = vec![0; library::encoded_len(&textures)];
    let len = library::encode_library(&textures, &mut bytes).expect("a valid library");
    assert_eq!(len, bytes.len());
    bytes
}

#[test]
fn a_library_truncated_at_any_byte_is_too_short() {
    let bytes = shelf();
    for len in 0..bytes.len() {
        assert!(
            matches!(
                Library::parse(&bytes[..len]),
                Err(FormatError::TooShort { .. })
            ),
            "{len} bytes"
        );
    }
}

#[test]
fn any_flipped_bit_of_a_library_is_found_by_who_reads_it() {
    let mut bytes = shelf();
    let index_len = library::index_len(&bytes).unwrap();
    let entries: Vec<_> = {
        let library = Library::parse(&bytes).unwrap();
        library
            .index()
            .entries()
            .map(|e| e.offset as usize..(e.offset + u64::from(e.len)) as usize)
            .collect()
    };
    for bit in 0..bytes.len() * 8 {
        bytes[bit / 8] ^= 1 << (bit % 8);
        match Library::parse(&bytes) {
            Err(_) => assert!(bit / 8 < index_len, "bit {bit} is not of the index"),
            Ok(library) => {
                assert!(bit / 8 >= index_len, "bit {bit} of the index passed");
                for (index, entry) in entries.iter().enumerate() {
                    let hit = entry.contains(&(bit / 8));
                    assert_eq!(
                        library.asset(index).is_err(),
                        hit,
                        "bit {bit}, texture {index}"
                    );
                }
            }
        }
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
}

#[test]
fn trailing_bytes_are_an_error() {
    let mut bytes = small().encode();
    let stated = bytes.len() as u64;
    bytes.push(0);
    assert_eq!(
        Asset::parse(&bytes).map(drop),
        Err(FormatError::TooLong {
            field: "asset",
            stated,
            found: stated + 1
        })
    );
    let mut bytes = shelf();
    let stated = bytes.len() as u64;
    bytes.extend([0; 7]);
    assert_eq!(
        Library::parse(&bytes).map(drop),
        Err(FormatError::TooLong {
            field: "library",
            stated,
            found: stated + 7
        })
    );
}
