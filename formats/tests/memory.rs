//! Latents and history: optional, outside the haptic bytes, checked like every other section.

use crate::common::*;
use asperity_formats::{Asset, FormatError, SectionInfo, assemble, assembled_len};

fn sections<'a>(asset: &Asset<'a>) -> Vec<([u8; 4], &'a [u8])> {
    let body = |s: SectionInfo| (s.tag, asset.section(&s).unwrap());
    asset.sections().map(body).collect()
}

fn assembled(sections: &[([u8; 4], &[u8])]) -> Result<Vec<u8>, asperity_formats::EncodeError> {
    let mut out = vec![0; assembled_len(sections)];
    let len = assemble(sections, &mut out)?;
    assert_eq!(len, out.len());
    Ok(out)
}

fn latent(parts: u8, width: u16, numbers: &[f32]) -> Vec<u8> {
    let mut bytes = 0xdead_beef_u32.to_le_bytes().to_vec();
    bytes.extend([parts, 0]);
    bytes.extend(width.to_le_bytes());
    bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
    bytes
}

#[test]
fn an_asset_of_its_own_sections_is_itself() {
    let bytes = full().encode();
    let asset = Asset::parse(&bytes).unwrap();
    assert_eq!(assembled(&sections(&asset)).unwrap(), bytes);
}

#[test]
fn latents_and_history_are_read_back_and_leave_the_haptic_sections_alone() {
    let bytes = full().encode();
    let asset = Asset::parse(&bytes).unwrap();
    assert!(asset.latents().is_none() && asset.history().is_none());
    let body = latent(3, 2, &[1.0, 2.0, 3.0, 4.0, 5.0, -6.0]);
    let mut more = sections(&asset);
    more.push((*b"late", &body));
    more.push((*b"hist", "{\"steps\":[]}".as_bytes()));
    let remembered = assembled(&more).unwrap();
    let found = Asset::parse(&remembered).unwrap();
    let latents = found.latents().unwrap();
    assert_eq!(latents.model_crc32, 0xdead_beef);
    assert_eq!((latents.parts(), latents.width()), (3, 2));
    for (part, numbers) in [[1.0, 2.0], [3.0, 4.0], [5.0, -6.0]].iter().enumerate() {
        assert_eq!(latents.part(part).collect::<Vec<_>>(), numbers);
    }
    for absent in [3, usize::MAX] {
        assert_eq!(latents.part(absent).count(), 0);
    }
    assert_eq!(found.history(), Some("{\"steps\":[]}"));
    assert_eq!(sections(&found)[..5], sections(&asset)[..5]);
    let haptic = Asset::parse_haptic(&remembered[..found.haptic_len()]).unwrap();
    assert!(haptic.latents().is_none() && haptic.history().is_none());
}

#[test]
fn a_wrong_latent_is_named() {
    let bytes = full().encode();
    let asset = Asset::parse(&bytes).unwrap();
    let mut reserved = latent(1, 1, &[0.0]);
    reserved[5] = 1;
    let infinite = [0.0, 0.0, 0.0, 0.0, 0.0, f32::INFINITY];
    let cases: [(Vec<u8>, &str); 8] = [
        (latent(2, 1, &[0.0, 0.0]), "latent.parts"),
        (latent(1, 0, &[]), "latent.width"),
        (latent(1, 1025, &[0.0; 1025]), "latent.width"),
        (latent(1, 2, &[0.0]), "latent.numbers"),
        (latent(1, 1, &[f32::NAN]), "latent.numbers"),
        (latent(3, 2, &infinite), "latent.numbers"),
        (latent(1, 1, &[0.0, 0.0]), "latent"),
        (reserved, "latent.reserved"),
    ];
    for (body, field) in cases {
        let mut more = sections(&asset);
        more.push((*b"late", &body));
        let error = assembled(&more).unwrap_err().to_string();
        assert!(error.contains(field), "{field}: {error}");
    }
}

#[test]
fn a_history_is_text_of_bounded_length() {
    let bytes = full().encode();
    let asset = Asset::parse(&bytes).unwrap();
    let mut longest = sections(&asset);
    longest.push((*b"hist", &[b' '; 65_536]));
    assert!(assembled(&longest).is_ok());
    for body in [&b"\xff"[..], &[b' '; 65_537]] {
        let mut more = sections(&asset);
        more.push((*b"hist", body));
        let error = assembled(&more).unwrap_err();
        assert!(matches!(
            error,
            asperity_formats::EncodeError::Rejected(FormatError::Section { tag, .. }) if tag == *b"hist"
        ));
    }
}
