//! A reader of version 1 accepts what later files may add.

mod common;

use asperity_formats::{Asset, VERSION};
use common::{append_section, replace_section, section::PROVENANCE, small, span};

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
    assert_eq!(haptic.version(), VERSION);
    // With the whole file at hand, the haptic reader still reads only its part.
    assert!(Asset::parse_haptic(&bytes).unwrap().preview_png().is_none());
}
