//! Offsets, lengths and indices, exhaustively. Every byte of a small asset, and of the index
//! of a small library, takes every value. The checksums are recomputed, so that only the
//! arithmetic prevents a read out of bounds. Under Miri each byte takes a few values.

use crate::common::{crc32, falling, put, seal, seal_header, section, small, span};
use asperity_formats::{
    Asset, Library, library,
    taps::{BLOCK, side_by_side},
};

/// Bytes to try: all of them, or those next to a carry or a change of sign.
fn values() -> impl Iterator<Item = u8> {
    (0..=u8::MAX).filter(|value| !cfg!(miri) || [0, 1, 127, 255].contains(value))
}

/// Offsets to try: all of them, or every fifth.
fn places(count: usize) -> impl Iterator<Item = usize> {
    (0..count).filter(|place| !cfg!(miri) || place % 5 == 0)
}

/// Reads everything that holds an index, and checks the index.
fn walk(bytes: &[u8], asset: &Asset<'_>) {
    let grid = asset.grid();
    let (models, vertices) = (grid.models().len(), grid.vertices().len());
    assert!(grid.vertices().all(|v| usize::from(v.model) < models));
    assert!(
        grid.triangles()
            .flatten()
            .all(|v| usize::from(v) < vertices)
    );
    let orders = (grid.ar_order(), grid.ma_order());
    for model in grid.models() {
        assert_eq!((model.lsf().len(), model.ma_lsf().len()), orders);
    }
    for trace in asset.taps().traces() {
        let all: Vec<f32> = trace.accel_m_s2().collect();
        assert_eq!(all.len(), asset.taps().samples());
        for first in (0..all.len() + 3).step_by(2) {
            let expected = all.iter().copied().chain([0.0; BLOCK + 4]).skip(first);
            let mut read = [[f32::NAN; 4]; BLOCK];
            side_by_side(&[trace; 4], first, &mut read);
            assert!(
                expected.zip(read).all(|(a, four)| four == [a; 4]),
                "from {first}"
            );
        }
    }
    assert!(asset.friction().anchors().all(|a| !a.name.is_empty()));
    if let Some(law) = asset.friction().law() {
        let speeds: Vec<f32> = law.points().map(|p| p.speed_mm_s()).collect();
        assert!((2..=8).contains(&speeds.len()) && speeds.is_sorted());
    }
    let mut end = None;
    for section in asset.sections() {
        assert!(end.is_none_or(|end| end == section.offset), "a gap");
        end = Some(section.offset + section.len);
    }
    assert_eq!(end, Some(bytes.len()), "sections end with the bytes");
}

#[test]
fn header_and_table_lead_nowhere_outside() {
    let original = small().encode();
    let table_end = 20 + 12 * usize::from(original[6]);
    let mut accepted = 0;
    for at in places(table_end) {
        for value in values() {
            let mut bytes = original.clone();
            bytes[at] = value;
            if 20 + 12 * usize::from(bytes[6]) > bytes.len() {
                assert!(Asset::parse(&bytes).is_err());
                continue;
            }
            seal_header(&mut bytes);
            for len in [bytes.len(), bytes.len() - 1, table_end, 20, 19] {
                if let Ok(asset) = Asset::parse(&bytes[..len]) {
                    walk(&bytes[..len], &asset);
                    accepted += 1;
                }
                let _ = Asset::parse_haptic(&bytes[..len]);
            }
        }
    }
    assert!(accepted > 0, "the undamaged values are among them");
}

#[test]
fn bodies_lead_nowhere_outside() {
    let original = falling().encode();
    let (mut accepted, mut refused) = (0_u32, 0_u32);
    for section in [
        section::NAME,
        section::GRID,
        section::TAPS,
        section::FRICTION,
    ] {
        let (start, len) = span(&original, section);
        for at in places(len) {
            for value in values() {
                let mut bytes = original.clone();
                bytes[start + at] = value;
                seal(&mut bytes);
                match Asset::parse(&bytes) {
                    Ok(asset) => {
                        walk(&bytes, &asset);
                        accepted += 1;
                    }
                    Err(_) => refused += 1,
                }
            }
        }
    }
    assert!(
        accepted > 100 && refused > 100,
        "{accepted} accepted, {refused} refused"
    );
}

#[test]
fn triangles_name_vertices_that_are_there() {
    let original = small().encode();
    let (start, len) = span(&original, section::GRID);
    // Four triangles of three indices end the section.
    let triangles = start + len - 12;
    for value in 0..=u8::MAX {
        for at in 0..12 {
            let mut bytes = original.clone();
            bytes[triangles + at] = value;
            seal(&mut bytes);
            match Asset::parse(&bytes) {
                Ok(asset) => walk(&bytes, &asset),
                Err(_) => assert_ne!(value, original[triangles + at]),
            }
        }
        if cfg!(miri) && value > 8 {
            break;
        }
    }
}

#[test]
fn entries_of_a_library_lead_nowhere_outside() {
    let asset = small().encode();
    let textures = [("a", asset.as_slice()), ("bc", asset.as_slice())];
    let mut original = vec![0; library::encoded_len(&textures)];
    library::encode_library(&textures, &mut original).unwrap();
    let index_len = library::index_len(&original).unwrap();
    let mut accepted = 0;
    for at in places(index_len) {
        for value in values() {
            let mut bytes = original.clone();
            bytes[at] = value;
            let Ok(stated) = library::index_len(&bytes) else {
                continue;
            };
            if let Some(rest) = bytes.get(library::HEADER_LEN..stated) {
                let crc = crc32(bytes[..24].iter().chain(rest).copied());
                put(&mut bytes, 24, &crc.to_le_bytes());
            }
            let Ok(found) = Library::parse(&bytes) else {
                continue;
            };
            accepted += 1;
            for (index, entry) in found.index().entries().enumerate() {
                match found.bytes(index) {
                    Ok(bytes) => assert_eq!(bytes.len(), entry.len as usize),
                    Err(error) => assert!(error.to_string().contains("haptic_len"), "{error}"),
                }
                assert_eq!(found.index().find(entry.name), Some(index));
                let _ = found.asset(index);
            }
            for none in [found.index().len(), usize::MAX, usize::MAX / 24] {
                assert!(found.bytes(none).is_err() && found.index().get(none).is_none());
            }
        }
    }
    assert!(accepted > 0, "the undamaged values are among them");
}
