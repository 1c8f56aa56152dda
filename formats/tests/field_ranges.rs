//! Any field out of its range is rejected with its name, its index and its value,
//! even where every CRC is right.

mod common;

use asperity_formats::{Asset, FormatError};
use common::{
    put, replace_section, seal, seal_header,
    section::{FRICTION, GRID, NAME, PREVIEW, PROVENANCE, SURFACE, TAPS},
    small, span,
};

/// Offsets in the sections of [`small`].
const MODEL: usize = 12;
const VERTEX: usize = MODEL + 2 * 8;
const TRIANGLE: usize = VERTEX + 5 * 12;
const TRACE: usize = 8;
const ANCHOR: usize = 5;

/// What must be said of a patched field.
enum Expect {
    Invalid(&'static str, u32, f64),
    Text(&'static str, u32, &'static str),
    Short(&'static str, u64, u64),
    Long(&'static str, u64, u64),
}

use Expect::{Invalid, Long, Short, Text};

fn check(error: FormatError, expect: &Expect, case: &str) {
    let fits = match (&error, expect) {
        (
            FormatError::Invalid {
                field,
                index,
                value,
                ..
            },
            Invalid(want_field, want_index, want_value),
        ) => field == want_field && index == want_index && value.to_bits() == want_value.to_bits(),
        (
            FormatError::Text {
                field,
                index,
                reason,
            },
            Text(want_field, want_index, want_reason),
        ) => (field, index, reason) == (want_field, want_index, want_reason),
        (
            FormatError::TooShort {
                field,
                needed,
                found,
            },
            Short(want_field, want_needed, want_found),
        ) => (field, needed, found) == (want_field, want_needed, want_found),
        (
            FormatError::TooLong {
                field,
                stated,
                found,
            },
            Long(want_field, want_stated, want_found),
        ) => (field, stated, found) == (want_field, want_stated, want_found),
        _ => false,
    };
    assert!(fits, "{case}: {error:?}");
}

/// Patches a section of the small asset, seals it, and checks both readers.
fn rejected(section: usize, at: usize, piece: &[u8], expect: &Expect) {
    let mut bytes = small().encode();
    let (start, len) = span(&bytes, section);
    assert!(at + piece.len() <= len, "the patch leaves its section");
    put(&mut bytes, start + at, piece);
    seal(&mut bytes);
    let case = format!("section {section}, byte {at} = {piece:02x?}");
    check(Asset::parse(&bytes).expect_err(&case), expect, &case);
    if section <= SURFACE {
        check(Asset::parse_haptic(&bytes).expect_err(&case), expect, &case);
    }
}

/// Values just outside `min..=max`, and those that are no numbers.
fn rejected_f32(section: usize, at: usize, field: &'static str, index: u32, min: f32, max: f32) {
    let below = if min > f32::MIN_POSITIVE {
        min.next_down()
    } else {
        min - min.next_up()
    };
    for value in [
        below,
        max.next_up(),
        f32::NAN,
        -f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MIN,
        f32::MAX,
    ] {
        rejected(
            section,
            at,
            &value.to_le_bytes(),
            &Invalid(field, index, value.into()),
        );
    }
}

fn accepted(section: usize, at: usize, piece: &[u8]) {
    let mut bytes = small().encode();
    let (start, _) = span(&bytes, section);
    put(&mut bytes, start + at, piece);
    seal(&mut bytes);
    assert_eq!(
        Asset::parse(&bytes).map(drop),
        Ok(()),
        "section {section}, byte {at}: {piece:02x?}"
    );
}

#[test]
fn numbers_of_the_grid() {
    rejected_f32(GRID, 0, "grid.sample_rate_hz", 0, 100.0, 200_000.0);
    for vertex in 0..5 {
        let at = VERTEX + 12 * vertex;
        let index = vertex as u32;
        rejected_f32(GRID, at, "grid.vertex.speed_mm_s", index, 0.0, 10_000.0);
        rejected_f32(GRID, at + 4, "grid.vertex.force_n", index, 0.0, 1000.0);
    }
}

#[test]
fn half_precision_numbers_of_the_grid() {
    let nan = f32::from_bits(0x7fc0_0000);
    // The next binary16 above 10,000 is 10,008; −2⁻²⁴ is the smallest below 0.
    let cases = [
        (0x70e3_u16, 10_008.0),
        (0x8001, -(2.0_f64.powi(-24))),
        (0x7c00, f64::INFINITY),
        (0xfc00, f64::NEG_INFINITY),
        (0x7e00, f64::from(nan)),
    ];
    for (bits, value) in cases {
        let piece = bits.to_le_bytes();
        rejected(
            GRID,
            VERTEX + 12 * 3 + 8,
            &piece,
            &Invalid("grid.vertex.sigma_m_s2", 3, value),
        );
        rejected(
            GRID,
            MODEL + 8 + 6,
            &piece,
            &Invalid("grid.model.gain", 1, value),
        );
    }
    accepted(GRID, VERTEX + 8, &0x70e2_u16.to_le_bytes());
}

#[test]
fn counts_of_the_grid() {
    let counts: [(usize, &str, &[u8]); 7] = [
        (4, "grid.numerator", &[3, 255]),
        (5, "grid.ar_order", &[0, 25, 255]),
        (6, "grid.ma_order", &[0, 25, 255]),
        (7, "grid.model_count", &[0, 65, 255]),
        (8, "grid.vertex_count", &[0, 1, 2, 65, 255]),
        (9, "grid.triangle_count", &[0, 129, 255]),
        (10, "grid.reserved", &[1, 255]),
    ];
    for (at, field, values) in counts {
        for &value in values {
            rejected(GRID, at, &[value], &Invalid(field, 0, value.into()));
        }
    }
    rejected(GRID, 11, &[7], &Invalid("grid.reserved", 0, 7.0));
    // Without MA LSFs there is no MA order.
    rejected(GRID, 4, &[0], &Invalid("grid.ma_order", 0, 1.0));
    rejected(GRID, 4, &[1], &Invalid("grid.ma_order", 0, 1.0));
}

#[test]
fn counts_that_the_section_does_not_hold() {
    // 88 bytes lie behind the twelve of the section's head.
    rejected(GRID, 7, &[64], &Short("grid.models", 64 * 8, 88));
    rejected(GRID, 8, &[64], &Short("grid.vertices", 64 * 12, 72));
    rejected(GRID, 9, &[128], &Short("grid.triangles", 128 * 3, 12));
    rejected(GRID, 9, &[3], &Long("grid", 97, 100));
    rejected(TAPS, 4, &[1], &Long("taps", 21, 34));
    rejected(
        TAPS,
        6,
        &1024_u16.to_le_bytes(),
        &Short("taps.trace.codes", 1536, 18),
    );
    rejected(FRICTION, 4, &[0], &Long("friction", 5, 20));
    rejected(FRICTION, 4, &[2], &Short("friction.anchor.mu", 4, 0));
    rejected(
        FRICTION,
        ANCHOR + 8,
        &[255],
        &Short("friction.anchor.name", 255, 6),
    );
    rejected(FRICTION, ANCHOR + 8, &[5], &Long("friction", 19, 20));
}

#[test]
fn line_spectral_frequencies() {
    let lsf = |model: usize, k: usize, code: u16| {
        (
            MODEL + 8 * model + 2 * k,
            code.to_le_bytes(),
            model as u32,
            f64::from(code),
        )
    };
    // Model 0 holds 16384 and 32768.
    for (at, piece, index, value) in [
        lsf(0, 0, 0),
        lsf(0, 0, 99),
        lsf(0, 1, 16384),
        lsf(0, 1, 16483),
        lsf(0, 1, 100),
        lsf(0, 1, 65437),
        lsf(0, 1, 65535),
        lsf(1, 0, 0),
    ] {
        rejected(GRID, at, &piece, &Invalid("grid.model.lsf", index, value));
    }
    // The first one too high is noticed at the second.
    rejected(
        GRID,
        MODEL,
        &32669_u16.to_le_bytes(),
        &Invalid("grid.model.lsf", 0, 32768.0),
    );
    for (at, code) in [
        (MODEL, 100_u16),
        (MODEL, 32668),
        (MODEL + 2, 16484),
        (MODEL + 2, 65436),
    ] {
        accepted(GRID, at, &code.to_le_bytes());
    }
    rejected(
        GRID,
        MODEL + 4,
        &[0, 0],
        &Invalid("grid.model.ma_lsf", 0, 0.0),
    );
    for code in [1_u16, 65535] {
        accepted(GRID, MODEL + 4, &code.to_le_bytes());
    }
    // MA LSFs may touch each other, but not descend.
    for (second, valid) in [(20000_u16, true), (20001, true), (19999, false)] {
        let mut parts = small();
        for model in &mut parts.models {
            model.1 = vec![20000, second];
        }
        let done = parts.encode_into(4096).map(drop);
        assert_eq!(done.is_ok(), valid, "{second}: {done:?}");
    }
}

#[test]
fn references_of_vertices_and_triangles() {
    for vertex in 0..5 {
        let (at, index) = (VERTEX + 12 * vertex, vertex as u32);
        for model in [2, 255] {
            rejected(
                GRID,
                at + 10,
                &[model],
                &Invalid("grid.vertex.model", index, model.into()),
            );
        }
        for kind in [2, 255] {
            rejected(
                GRID,
                at + 11,
                &[kind],
                &Invalid("grid.vertex.kind", index, kind.into()),
            );
        }
    }
    for triangle in 0..4 {
        for corner in 0..3 {
            let (at, index) = (TRIANGLE + 3 * triangle + corner, triangle as u32);
            for vertex in [5, 255] {
                rejected(
                    GRID,
                    at,
                    &[vertex],
                    &Invalid("grid.triangle", index, vertex.into()),
                );
            }
        }
    }
    rejected(GRID, TRIANGLE, &[1], &Invalid("grid.triangle", 0, 1.0));
    rejected(GRID, TRIANGLE + 9, &[4], &Invalid("grid.triangle", 3, 4.0));
}

#[test]
fn triangles_that_do_not_tile_the_rectangle() {
    // Triangle 0, of 100 mm²·N/s, twice and triangle 1 never: too little or too much.
    let area = "grid.triangle.area";
    rejected(GRID, TRIANGLE + 3, &[0, 2, 4], &Invalid(area, 0, 300.0));
    rejected(GRID, TRIANGLE, &[0, 1, 2], &Invalid(area, 0, 500.0));
}

#[test]
fn grids_of_too_little_extent() {
    for (offset, field) in [(0, "grid.max_speed_mm_s"), (4, "grid.max_force_n")] {
        for extent in [0.0, 0.001_f32.next_down()] {
            let mut bytes = small().encode();
            let (start, _) = span(&bytes, GRID);
            for vertex in 0..5 {
                let at = start + VERTEX + 12 * vertex + offset;
                put(&mut bytes, at, &extent.to_le_bytes());
            }
            seal(&mut bytes);
            let error = Asset::parse(&bytes).unwrap_err();
            check(error, &Invalid(field, 0, extent.into()), field);
        }
    }
}

#[test]
fn numbers_of_the_tap_bank() {
    rejected_f32(TAPS, 0, "taps.sample_rate_hz", 0, 100.0, 200_000.0);
    for count in [17, 255] {
        rejected(
            TAPS,
            4,
            &[count],
            &Invalid("taps.trace_count", 0, count.into()),
        );
    }
    rejected(TAPS, 5, &[1], &Invalid("taps.reserved", 0, 1.0));
    for samples in [0_u16, 1025, 65535] {
        rejected(
            TAPS,
            6,
            &samples.to_le_bytes(),
            &Invalid("taps.samples", 0, samples.into()),
        );
    }
    rejected(TAPS, 4, &[0], &Invalid("taps.samples", 0, 3.0));
    let stride = 8 + 5;
    for trace in 0..2 {
        let (at, index) = (TRACE + stride * trace, trace as u32);
        rejected_f32(
            TAPS,
            at,
            "taps.trace.speed_m_s",
            index,
            f32::MIN_POSITIVE,
            100.0,
        );
        rejected_f32(TAPS, at + 4, "taps.trace.peak_m_s2", index, 0.0, 1.0e6);
    }
    // Speeds ascend strictly.
    let first = 0.1_f32.to_le_bytes();
    let field = "taps.trace.speed_m_s";
    rejected(
        TAPS,
        TRACE + stride,
        &first,
        &Invalid(field, 1, 0.1_f32.into()),
    );
}

#[test]
fn codes_of_the_tap_bank() {
    // −2048, the code 0x800, as the first, second and third sample of trace 1.
    let codes = TRACE + 13 + 8;
    for (at, piece, index) in [
        (0, [0x00, 0x08, 0x00, 0x00, 0x00], 3),
        (0, [0x00, 0x00, 0x80, 0x00, 0x00], 4),
        (0, [0x00, 0x00, 0x00, 0x00, 0x08], 5),
    ] {
        rejected(
            TAPS,
            codes + at,
            &piece,
            &Invalid("taps.trace.codes", index, -2048.0),
        );
    }
    accepted(TAPS, codes, &[0x01, 0x18, 0x80, 0x01, 0x08]);
}

#[test]
fn numbers_of_friction_and_surface() {
    rejected_f32(FRICTION, 0, "friction.mu", 0, 0.0, 10.0);
    for count in [17, 255] {
        rejected(
            FRICTION,
            4,
            &[count],
            &Invalid("friction.anchor_count", 0, count.into()),
        );
    }
    rejected_f32(FRICTION, ANCHOR, "friction.anchor.mu", 0, 0.0, 10.0);
    rejected_f32(FRICTION, ANCHOR + 4, "friction.anchor.weight", 0, 0.0, 1.0);
    let tiny = f32::MIN_POSITIVE;
    rejected_f32(SURFACE, 0, "surface.stiffness_n_m", 0, tiny, 1.0e5);
    rejected_f32(SURFACE, 4, "surface.damping_n_s_m", 0, 0.0, 1000.0);
    rejected_f32(SURFACE, 8, "surface.vib_s2_m", 0, 0.0, 1000.0);
    rejected_f32(SURFACE, 12, "surface.effective_mass_kg", 0, 0.0, 100.0);
    rejected_f32(SURFACE, 16, "surface.f_max_n", 0, tiny, 10_000.0);
}

#[test]
fn texts() {
    for (section, at, field) in [
        (NAME, 0, "name"),
        (FRICTION, ANCHOR + 9, "friction.anchor.name"),
    ] {
        rejected(section, at, &[0xff], &Text(field, 0, "not UTF-8"));
        rejected(
            section,
            at,
            b"\n",
            &Text(field, 0, "holds a control character"),
        );
        // U+0085, a control character of two bytes.
        rejected(
            section,
            at,
            &[0xc2, 0x85],
            &Text(field, 0, "holds a control character"),
        );
    }
    rejected(
        FRICTION,
        ANCHOR + 8,
        &[0],
        &Text("friction.anchor.name", 0, "empty"),
    );
    for (name, reason) in [(vec![], "empty"), (vec![b'a'; 65], "longer than 64 bytes")] {
        let mut bytes = small().encode();
        replace_section(&mut bytes, NAME, &name);
        check(
            Asset::parse(&bytes).unwrap_err(),
            &Text("name", 0, reason),
            reason,
        );
    }
    let mut bytes = small().encode();
    replace_section(&mut bytes, NAME, &[b'a'; 64]);
    assert_eq!(Asset::parse(&bytes).unwrap().name().len(), 64);
}

#[test]
fn sections_of_another_length() {
    for section in [GRID, TAPS, FRICTION, SURFACE] {
        let original = small().encode();
        let (start, len) = span(&original, section);
        let body = original[start..start + len].to_vec();
        for shorter in 0..len {
            let mut bytes = original.clone();
            replace_section(&mut bytes, section, &body[..shorter]);
            let error = Asset::parse(&bytes).unwrap_err();
            assert!(
                matches!(error, FormatError::TooShort { .. }),
                "section {section} of {shorter} bytes: {error:?}"
            );
        }
        let mut bytes = original.clone();
        replace_section(&mut bytes, section, &[body, vec![0]].concat());
        let error = Asset::parse(&bytes).unwrap_err();
        assert!(
            matches!(error, FormatError::TooLong { stated, found, .. }
                if (stated, found) == (len as u64, len as u64 + 1)),
            "section {section} with one byte more: {error:?}"
        );
    }
}

#[test]
fn provenance_that_does_not_decode() {
    let reject = Err(FormatError::Metadata {
        section: "provenance",
    });
    let original = small().encode();
    let (start, len) = span(&original, PROVENANCE);
    let body = original[start..start + len].to_vec();
    for shorter in 0..len {
        let mut bytes = original.clone();
        replace_section(&mut bytes, PROVENANCE, &body[..shorter]);
        assert_eq!(Asset::parse(&bytes).map(drop), reject, "{shorter} bytes");
        // A runtime does not read it.
        assert_eq!(Asset::parse_haptic(&bytes).map(drop), Ok(()));
    }
    let error_db = body
        .windows(4)
        .position(|w| w == 0.015625_f32.to_le_bytes())
        .unwrap();
    for value in [f32::NAN, f32::INFINITY] {
        let mut body = body.clone();
        put(&mut body, error_db, &value.to_le_bytes());
        let mut bytes = original.clone();
        replace_section(&mut bytes, PROVENANCE, &body);
        assert_eq!(
            Asset::parse(&bytes).map(drop),
            reject,
            "lsf_error_db = {value}"
        );
    }
}

#[test]
fn provenance_is_at_most_16_kib() {
    let original = small().encode();
    let (start, len) = span(&original, PROVENANCE);
    for (room, fits) in [(16_384, true), (16_385, false)] {
        let mut body = original[start..start + len].to_vec();
        body.resize(room, 0);
        let mut bytes = original.clone();
        replace_section(&mut bytes, PROVENANCE, &body);
        match Asset::parse(&bytes) {
            Ok(_) => assert!(fits),
            Err(error) => check(
                error,
                &Invalid("provenance.len", 0, 16_385.0),
                "one too many",
            ),
        }
    }
}

#[test]
fn a_preview_that_is_no_png() {
    for body in [
        &b""[..],
        b"\x89PNG\r\n\x1a",
        b"GIF89a..",
        b"\x89PNG\r\n\x1a\r",
    ] {
        let mut bytes = small().encode();
        replace_section(&mut bytes, PREVIEW, body);
        assert_eq!(
            Asset::parse(&bytes).map(drop),
            Err(FormatError::Section {
                tag: *b"prev",
                reason: "is not a PNG"
            })
        );
    }
}

#[test]
fn fields_of_the_header() {
    let original = small().encode();
    let (total, haptic) = (original.len() as f64, common::u32_at(&original, 12));
    let patched = |at: usize, piece: &[u8]| {
        let mut bytes = original.clone();
        put(&mut bytes, at, piece);
        seal_header(&mut bytes);
        Asset::parse(&bytes).expect_err("a patched header")
    };
    assert_eq!(
        patched(0, b"ASPL"),
        FormatError::Magic {
            found: *b"ASPL",
            expected: *b"ASPT"
        }
    );
    for version in [0_u16, 2, 65535] {
        assert_eq!(
            patched(4, &version.to_le_bytes()),
            FormatError::Version {
                found: version,
                supported: 1
            }
        );
    }
    check(
        patched(7, &[9]),
        &Invalid("header.reserved", 0, 9.0),
        "reserved",
    );
    for other in [total - 1.0, total + 1.0, 0.0, 4294967295.0] {
        let error = patched(8, &(other as u32).to_le_bytes());
        check(error, &Invalid("header.total_len", 0, other), "total");
    }
    for other in [haptic - 1, haptic + 1, 0, u32::MAX] {
        let error = patched(12, &other.to_le_bytes());
        check(
            error,
            &Invalid("header.haptic_len", 0, other.into()),
            "haptic",
        );
    }
    for (entry, tag) in [b"NAME", b"GRID", b"TAPS", b"FRIC", b"SURF"]
        .into_iter()
        .enumerate()
    {
        assert_eq!(
            patched(20 + 12 * entry, b"none"),
            FormatError::Section {
                tag: *tag,
                reason: "missing or out of order"
            }
        );
    }
    assert_eq!(
        patched(20 + 12 * 5, b"XTRA"),
        FormatError::Section {
            tag: *b"XTRA",
            reason: "unknown haptic section"
        }
    );
    assert_eq!(
        patched(20 + 12 * 5, b"prev"),
        FormatError::Section {
            tag: *b"prev",
            reason: "appears twice"
        }
    );
}
