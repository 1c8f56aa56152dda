//! Access by index and in blocks, and error messages, agree with the bytes of an asset.

use crate::common::{falling, full, small, span};
use asperity_formats::{
    Asset, FormatError, Library, LsfCode, Vertex, assemble, assembled_len,
    library::{encode_library, encoded_len},
    taps::{BLOCK, side_by_side},
};

#[test]
fn the_version_is_that_of_the_bytes() {
    for (parts, version) in [(small(), 1), (falling(), 2)] {
        let bytes = parts.encode();
        assert_eq!(Asset::parse(&bytes).unwrap().version(), version);
        assert_eq!(bytes[4..6], version.to_le_bytes());
    }
}

#[test]
fn parts_by_index_are_those_in_order() {
    for parts in [small(), full()] {
        let bytes = parts.encode();
        let grid = *Asset::parse(&bytes).unwrap().grid();
        for (index, (lsf, ..)) in parts.models.iter().enumerate() {
            let model = grid.model(index).expect("a model");
            let codes: Vec<u16> = model.lsf().map(|code| code.to_bits()).collect();
            assert_eq!(codes, *lsf, "model {index}");
        }
        assert!(grid.model(parts.models.len()).is_none());
        assert!(grid.model(usize::MAX).is_none());
        for (index, vertex) in parts.vertices.iter().enumerate() {
            assert_eq!(grid.place(index), Some((vertex.speed_mm_s, vertex.force_n)));
        }
        let most = |of: fn(&Vertex) -> f32| parts.vertices.iter().map(of).fold(0.0, f32::max);
        assert_eq!(grid.max_speed_mm_s(), most(|vertex| vertex.speed_mm_s));
        assert_eq!(grid.max_force_n(), most(|vertex| vertex.force_n));
        assert!(grid.place(parts.vertices.len()).is_none());
        assert!(grid.place(usize::MAX).is_none());
    }
}

/// A full block reads its codes with a word of the byte before them; a trace that ends within the block is padded.
#[test]
fn a_block_of_two_traces_is_what_each_says_sample_by_sample() {
    for samples in [1, 2, 21, 22, 23, 24, 43, 45, 100] {
        let sample =
            |t: usize| (0..samples).map(move |n| (n * n * 7 + t * 31) as f32 % 61.0 - 30.0);
        let mut parts = small();
        parts.traces = (0..2)
            .map(|t| (0.1 * (t + 1) as f32, sample(t).collect()))
            .collect();
        let bytes = parts.encode();
        let taps = *Asset::parse(&bytes).unwrap().taps();
        let traces: Vec<_> = taps.traces().collect();
        let traces: [_; 2] = traces.try_into().unwrap();
        let expected = traces.map(|trace| trace.accel_m_s2().collect::<Vec<_>>());
        for first in (0..samples + 2).step_by(2) {
            let mut rows = [[f32::NAN; 2]; BLOCK];
            side_by_side(&traces, first, &mut rows);
            for (n, row) in rows.iter().enumerate() {
                let at = |of: &[f32]| of.get(first + n).copied().unwrap_or(0.0);
                let expected = [at(&expected[0]), at(&expected[1])];
                assert_eq!(*row, expected, "sample {n} from {first} of {samples}");
            }
        }
    }
}

/// The area of a triangle does not depend on its direction.
#[test]
fn triangles_tile_in_either_direction() {
    let mut parts = small();
    for turned in 0..16 {
        for (index, triangle) in parts.triangles.iter_mut().enumerate() {
            if turned >> index & 1 == 1 {
                triangle.swap(0, 1);
            }
        }
        assert!(Asset::parse(&parts.encode()).is_ok(), "{turned:b}");
    }
}

/// An overlap and a gap of a thousandth of the rectangle are the first that are refused. Every number here is exact.
#[test]
fn the_area_may_be_off_by_less_than_a_thousandth() {
    let refused = |corner: f32, triangles: &[[u8; 3]]| {
        let mut parts = small();
        for (vertex, place) in parts.vertices.iter_mut().zip([
            (0.0, 0.0),
            (1000.0, 0.0),
            (1000.0, 2.0),
            (0.0, 2.0),
            (corner, 2.0),
        ]) {
            (vertex.speed_mm_s, vertex.force_n) = place;
        }
        parts.triangles = triangles.to_vec();
        parts.encode_into(1 << 17).is_err()
    };
    for triangles in [
        &[[0, 1, 2], [0, 2, 3], [0, 3, 4]][..],
        &[[0, 1, 2], [0, 2, 4]],
    ] {
        assert!(refused(2.0, triangles) && !refused(1.875, triangles));
    }
}

#[test]
fn a_damaged_section_is_named() {
    let mut latent = 7_u32.to_le_bytes().to_vec();
    latent.extend([1, 0, 1, 0, 0, 0, 0, 0]);
    let bytes = small().encode();
    let asset = Asset::parse(&bytes).unwrap();
    let mut sections: Vec<_> = asset
        .sections()
        .map(|section| (section.tag, asset.section(&section).unwrap()))
        .collect();
    sections.extend([
        (*b"late", &latent[..]),
        (*b"hist", b"{}"),
        (*b"xtra", b".."),
    ]);
    let mut whole = vec![0; assembled_len(&sections)];
    let len = assemble(&sections, &mut whole).unwrap();
    whole.truncate(len);
    let names = [
        "name",
        "grid",
        "taps",
        "friction",
        "surface",
        "provenance",
        "preview",
        "latent",
        "history",
        "ancillary section",
    ];
    for (index, name) in names.into_iter().enumerate() {
        let mut damaged = whole.clone();
        damaged[span(&whole, index).0] ^= 1;
        let error = Asset::parse(&damaged).unwrap_err();
        let FormatError::Checksum { section, .. } = error else {
            panic!("{name}: {error}");
        };
        assert_eq!(section, name);
        assert!(error.to_string().contains(name), "{error}");
    }
}

/// Without provenance and preview the haptic bytes are the whole asset.
#[test]
fn a_library_holds_bare_assets() {
    let mut parts = small();
    (parts.provenance, parts.preview_png) = (None, None);
    let asset = parts.encode();
    let textures = [("Cork", &asset[..])];
    let mut bytes = vec![0; encoded_len(&textures)];
    encode_library(&textures, &mut bytes).unwrap();
    let library = Library::parse(&bytes).unwrap();
    let entry = library.index().get(0).unwrap();
    assert_eq!(
        (entry.haptic_len, entry.len),
        (asset.len() as u32, asset.len() as u32)
    );
    assert_eq!(library.bytes(0).unwrap(), asset);
}

#[test]
fn a_code_counts_halves_of_a_turn_from_0_to_1() {
    for bits in [0, 1, 0x4000, 0x8000, u16::MAX] {
        let code = LsfCode::from_bits(bits);
        assert_eq!(code.half_turns(), f32::from(bits) / 65536.0);
        assert_eq!(
            code.to_rad(),
            f64::from(bits) / 65536.0 * std::f64::consts::PI
        );
    }
}
