//! A library of version 2 says which surfaces wear which textures.

use crate::common;
use crate::common::{put, small};
use asperity_formats::{
    EncodeError, FormatError, Library, SceneSurface, Solid,
    library::{encode_library, encode_scene, encoded_len},
    scene,
};

const EVERYWHERE: ([f32; 3], [f32; 3]) = ([-1.0; 3], [1.0; 3]);

fn surface(solid: Solid, texture: u16) -> SceneSurface {
    SceneSurface {
        solid,
        from_m: EVERYWHERE.0,
        to_m: EVERYWHERE.1,
        texture,
    }
}

fn surfaces() -> [SceneSurface; 3] {
    [
        SceneSurface {
            to_m: [0.0, 0.5, 0.25],
            ..surface(
                Solid::Plane {
                    point_m: [0.0, 0.0, 0.125],
                    normal: [0.0, 0.0, 2.0],
                },
                1,
            )
        },
        surface(
            Solid::Sphere {
                center_m: [0.5, 0.25, 0.0],
                radius_m: 0.0625,
            },
            0,
        ),
        surface(
            Solid::Box {
                center_m: [-0.5, 0.25, 0.0],
                half_extents_m: [0.25, 0.5, 0.125],
            },
            1,
        ),
    ]
}

fn scene_library() -> Vec<u8> {
    let asset = small().encode();
    let textures = [("Cork", &asset[..]), ("Felt", &asset[..])];
    let surfaces = surfaces();
    let mut bytes = vec![0; encoded_len(&textures) + scene::encoded_len(surfaces.len())];
    let len = encode_scene(&textures, &surfaces, &mut bytes).expect("a valid scene");
    assert_eq!(len, bytes.len());
    bytes
}

fn start(bytes: &[u8]) -> usize {
    let library = Library::parse(bytes).expect("a valid library");
    library.index().scene_range().expect("a scene").start as usize
}

fn seal(bytes: &mut [u8], start: usize) {
    let crc = common::crc32(bytes[start + 12..].iter().copied());
    put(bytes, start + 8, &crc.to_le_bytes());
}

#[test]
fn what_is_written_is_read() {
    let bytes = scene_library();
    let library = Library::parse(&bytes).unwrap();
    assert_eq!(library.index().version(), 2);
    let read: Vec<SceneSurface> = library.scene().unwrap().surfaces().collect();
    assert_eq!(read, surfaces());
    assert!(library.asset(1).is_ok());
}

/// Reads at the offsets that `SPEC.md` states, without the crate.
#[test]
fn bytes_lie_where_the_specification_says() {
    let bytes = scene_library();
    let scene = &bytes[start(&bytes)..];
    assert_eq!(&scene[..8], b"SCEN\xa0\0\0\0");
    assert_eq!(&scene[12..16], &[3, 0, 0, 0]);
    let second = &scene[16 + 52..][..52];
    assert_eq!(&second[..4], &[1, 0, 0, 0]);
    let number = |at: usize| f32::from_le_bytes(second[at..at + 4].try_into().unwrap());
    let numbers: Vec<f32> = (4..52).step_by(4).map(number).collect();
    assert_eq!(
        numbers,
        [
            0.5, 0.25, 0.0, 0.0625, 0.0, 0.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0
        ]
    );
}

#[test]
fn a_library_without_a_scene_is_of_version_1() {
    let asset = small().encode();
    let textures = [("Cork", &asset[..])];
    let mut bytes = vec![0; encoded_len(&textures)];
    encode_library(&textures, &mut bytes).unwrap();
    let library = Library::parse(&bytes).unwrap();
    assert_eq!(library.index().version(), 1);
    assert!(library.scene().is_none() && library.index().scene_range().is_none());
}

#[test]
fn every_flipped_bit_of_a_scene_is_found() {
    let bytes = scene_library();
    for at in start(&bytes)..bytes.len() {
        for bit in 0..8 {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            assert!(Library::parse(&damaged).is_err(), "byte {at}, bit {bit}");
        }
    }
    for len in 0..bytes.len() {
        assert!(Library::parse(&bytes[..len]).is_err(), "{len} bytes");
    }
}

#[test]
fn every_field_of_a_scene_is_checked() {
    let original = scene_library();
    let start = start(&original);
    let at = |surface: usize, offset: usize| start + 16 + 52 * surface + offset;
    let nan = &f32::NAN.to_le_bytes();
    let zero = &[0; 4];
    let cases: [(usize, &[u8], &str, u32); 12] = [
        (start + 12, &[0], "scene.count", 0),
        (start + 12, &[65], "scene.count", 0),
        (start + 14, &[1], "scene.reserved", 0),
        (at(1, 0), &[3], "scene.surface.kind", 1),
        (at(2, 1), &[1], "scene.surface.reserved", 2),
        (at(0, 2), &[2], "scene.surface.texture", 0),
        (at(0, 4), nan, "scene.surface.point_m", 0),
        (at(0, 24), zero, "scene.surface.normal length", 0),
        (at(1, 16), zero, "scene.surface.radius_m", 1),
        (at(2, 20), nan, "scene.surface.half_extents_m", 2),
        (at(1, 28), nan, "scene.surface.from_m", 1),
        (at(0, 40), &(-1.0f32).to_le_bytes(), "scene.surface.to_m", 0),
    ];
    for (offset, piece, expected, expected_index) in cases {
        let mut bytes = original.clone();
        put(&mut bytes, offset, piece);
        seal(&mut bytes, start);
        let error = Library::parse(&bytes).map(drop).unwrap_err();
        assert!(
            matches!(error, FormatError::Invalid { field, index, .. }
                if field == expected && index == expected_index),
            "{expected}: {error:?}"
        );
    }
    let mut tag = original;
    put(&mut tag, start, b"SCEM");
    assert!(matches!(
        Library::parse(&tag).map(drop),
        Err(FormatError::Section { .. })
    ));
}

#[test]
fn a_writer_refuses_what_a_reader_would() {
    let asset = small().encode();
    let textures = [("Cork", &asset[..])];
    let mut bytes = vec![0; encoded_len(&textures) + scene::encoded_len(65)];
    let mut wrong = surfaces()[1];
    wrong.texture = 1;
    for surfaces in [&[][..], &[surfaces()[1]; 65], &[wrong]] {
        assert!(matches!(
            encode_scene(&textures, surfaces, &mut bytes),
            Err(EncodeError::Rejected(_))
        ));
    }
    let room = encoded_len(&textures) + scene::encoded_len(1);
    for room in 0..room {
        assert!(encode_scene(&textures, &[surfaces()[1]], &mut bytes[..room]).is_err());
    }
}

#[test]
fn the_committed_scene_is_what_is_written_today() {
    let bytes = scene_library();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/scene-v2.aspl");
    if std::env::var_os("ASPERITY_BLESS").is_some() {
        std::fs::write(path, &bytes).unwrap();
    }
    let committed = std::fs::read(path).unwrap();
    assert!(
        committed == bytes,
        "the writer changed its bytes; if version 2 was never released, run\n\
         ASPERITY_BLESS=1 cargo test -p asperity-formats --test it scene::"
    );
}
