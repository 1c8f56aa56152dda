//! A reader accepts what later files may add, and each version has its own friction.

use crate::common;
use crate::common::{
    Parts, append_section, falling, put, replace_section, ribbed, seal_header, section::PROVENANCE,
    small, span, yielding,
};
use asperity_formats::{Asset, FormatError, VERSION, assemble, assembled_len};

#[test]
fn unknown_ancillary_sections_are_carried_and_skipped() {
    let mut bytes = small().encode();
    append_section(&mut bytes, b"ltnt", &[1, 2, 3]);
    append_section(&mut bytes, b"hist", b"");
    let asset = Asset::parse(&bytes).expect("unknown ancillary sections");
    let tags: Vec<_> = asset.sections().map(|s| s.tag).collect();
    assert_eq!(&tags[5..], [*b"prov", *b"prev", *b"ltnt", *b"hist"]);
    assert!(
        asset
            .sections()
            .all(|s| s.is_haptic() == (s.offset < asset.haptic_len()))
    );
    assert_eq!(asset.preview_png(), Some(&common::PNG_MAGIC[..]));
    assert_eq!(asset.name(), "Cork");
    assert_eq!(asset.total_len(), bytes.len());
}

#[test]
fn unknown_ancillary_sections_are_still_under_their_crc() {
    let mut bytes = small().encode();
    append_section(&mut bytes, b"ltnt", &[1, 2, 3]);
    *bytes.last_mut().unwrap() ^= 1;
    assert!(Asset::parse(&bytes).is_err());
    assert!(Asset::parse_haptic(&bytes).is_ok());
}

#[test]
fn ancillary_sections_stand_in_any_order_or_are_absent() {
    let mut parts = small();
    (parts.provenance, parts.preview_png) = (None, None);
    let mut bytes = parts.encode();
    let asset = Asset::parse(&bytes).expect("haptic sections alone");
    assert_eq!(asset.haptic_len(), asset.total_len());
    assert!(asset.provenance().is_none() && asset.preview_png().is_none());

    let original = small().encode();
    let (start, len) = span(&original, PROVENANCE);
    append_section(&mut bytes, b"prev", common::PNG_MAGIC);
    append_section(&mut bytes, b"prov", &original[start..start + len]);
    let asset = Asset::parse(&bytes).expect("preview before provenance");
    assert_eq!(
        asset.provenance(),
        Asset::parse(&original).unwrap().provenance()
    );
    assert_eq!(asset.preview_png(), Some(&common::PNG_MAGIC[..]));
}

#[test]
fn later_provenance_may_append_fields() {
    let mut bytes = small().encode();
    let (start, len) = span(&bytes, PROVENANCE);
    let longer = [&bytes[start..start + len], b"\x05later"].concat();
    replace_section(&mut bytes, PROVENANCE, &longer);
    let asset = Asset::parse(&bytes).expect("appended fields");
    assert_eq!(asset.provenance().map(|p| p.notes), Some("µ"));
}

#[test]
fn a_prefix_of_haptic_len_bytes_is_enough_for_a_runtime() {
    let bytes = small().encode();
    let whole = Asset::parse(&bytes).unwrap();
    let haptic = Asset::parse_haptic(&bytes[..whole.haptic_len()]).expect("haptic prefix");
    assert_eq!(haptic.name(), whole.name());
    assert_eq!(haptic.coupling(), whole.coupling());
    assert_eq!(haptic.friction().mu(), whole.friction().mu());
    assert!(haptic.grid().vertices().eq(whole.grid().vertices()));
    assert!(haptic.grid().triangles().eq(whole.grid().triangles()));
    assert!(haptic.provenance().is_none(), "not read");
    assert!(haptic.preview_png().is_none(), "not read");
    assert_eq!(haptic.version(), 1);
    // With the whole file at hand, the haptic reader still reads only its part.
    assert!(Asset::parse_haptic(&bytes).unwrap().preview_png().is_none());
}

#[test]
fn an_asset_is_of_the_lowest_version_that_can_hold_it() {
    assert_eq!(VERSION, 3);
    assert_eq!(small().encode()[4..6], [1, 0]);
    assert_eq!(falling().encode()[4..6], [2, 0]);
    assert_eq!(yielding().encode()[4..6], [3, 0]);
}

/// A reader of version 1 rejects a later version before it reads any further, so it never takes the
/// law for something else. Nor does today's reader, if the version is forged.
#[test]
fn a_law_is_never_read_as_part_of_another_version() {
    let mut bytes = falling().encode();
    put(&mut bytes, 4, &[1, 0]);
    seal_header(&mut bytes);
    let error = Asset::parse(&bytes).unwrap_err();
    assert!(
        matches!(
            error,
            FormatError::TooLong {
                field: "friction",
                ..
            }
        ),
        "{error:?}"
    );
    let mut bytes = small().encode();
    put(&mut bytes, 4, &[2, 0]);
    seal_header(&mut bytes);
    let error = Asset::parse(&bytes).unwrap_err();
    assert!(
        matches!(
            error,
            FormatError::TooShort {
                field: "friction.law.count",
                ..
            }
        ),
        "{error:?}"
    );
    put(&mut bytes, 4, &[4, 0]);
    seal_header(&mut bytes);
    assert_eq!(
        Asset::parse(&bytes).map(drop),
        Err(FormatError::Version {
            found: 4,
            supported: 3
        })
    );
}

/// The sections of a contact law and of a direction belong to version 3 and to no other, and stand behind `SURF` in
/// this order.
#[test]
fn a_contact_law_or_a_direction_is_never_skipped() {
    let forged = |mut bytes: Vec<u8>, version: u8| {
        put(&mut bytes, 4, &[version, 0]);
        seal_header(&mut bytes);
        Asset::parse(&bytes).map(drop)
    };
    let misplaced = |tag: &[u8; 4]| FormatError::Section {
        tag: *tag,
        reason: "version 3 has CONT, AXIS or both, and no earlier one has either",
    };
    let hard = || Parts {
        contact: None,
        ..ribbed()
    };
    for (parts, version, tag) in [
        (yielding(), 1, b"CONT"),
        (yielding(), 2, b"CONT"),
        (ribbed(), 2, b"CONT"),
        (hard(), 1, b"AXIS"),
        (hard(), 2, b"AXIS"),
        (falling(), 3, b"CONT"),
        (small(), 3, b"CONT"),
    ] {
        assert_eq!(
            forged(parts.encode(), version),
            Err(misplaced(tag)),
            "{version}"
        );
    }
    // Twice, or in the wrong order.
    for (parts, tag, body) in [
        (yielding(), b"CONT", &[0; 45][..]),
        (ribbed(), b"CONT", &[0; 45]),
        (hard(), b"AXIS", &[0; 28]),
        (hard(), b"CONT", &[0; 45]),
    ] {
        let mut bytes = parts.encode();
        append_section(&mut bytes, tag, body);
        let twice = FormatError::Section {
            tag: *tag,
            reason: "unknown haptic section",
        };
        assert_eq!(Asset::parse(&bytes).map(drop), Err(twice));
    }
    for (parts, law, axis) in [
        (yielding(), true, false),
        (ribbed(), true, true),
        (hard(), false, true),
    ] {
        let bytes = parts.encode();
        let whole = Asset::parse(&bytes).unwrap();
        let haptic = Asset::parse_haptic(&bytes[..whole.haptic_len()]).unwrap();
        assert_eq!(haptic.contact(), whole.contact());
        assert_eq!(haptic.direction(), whole.direction());
        let there = (whole.contact().is_some(), whole.direction().is_some());
        assert_eq!((whole.version(), there), (3, (law, axis)));
    }
    let mut parts = yielding();
    parts.law.clear();
    let bytes = parts.encode();
    let without = Asset::parse(&bytes).unwrap();
    assert_eq!((without.version(), without.friction().law()), (3, None));
}

#[test]
fn an_asset_that_is_assembled_of_sections_keeps_its_law_and_its_version() {
    for parts in [small(), falling(), yielding(), ribbed()] {
        let bytes = parts.encode();
        let asset = Asset::parse(&bytes).unwrap();
        let sections: Vec<_> = (asset.sections())
            .map(|section| (section.tag, asset.section(&section).unwrap()))
            .collect();
        let mut again = vec![0; assembled_len(&sections)];
        assemble(&sections, &mut again).unwrap();
        assert_eq!(again, bytes);
    }
}

#[test]
fn the_committed_assets_are_what_is_written_today() {
    for (parts, file) in [
        (falling(), "law-v2.asp"),
        (yielding(), "contact-v3.asp"),
        (ribbed(), "direction-v3.asp"),
    ] {
        let bytes = parts.encode();
        let path = format!("{}/tests/data/{file}", env!("CARGO_MANIFEST_DIR"));
        if std::env::var_os("ASPERITY_BLESS").is_some() {
            std::fs::write(&path, &bytes).unwrap();
        }
        let committed = std::fs::read(&path).unwrap();
        assert!(
            committed == bytes,
            "{file}: the writer changed its bytes; if this version was never released, run\n\
             ASPERITY_BLESS=1 cargo test -p asperity-formats --test it compatibility::"
        );
    }
}
