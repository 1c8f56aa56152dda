//! Fields outside the grid: taps, friction, wall and gains, texts, provenance, preview, header.

use super::*;
use crate::common::ribbed;
use asperity_formats::{Direction, EncodeError};

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

/// Patches the law of [`falling`], recomputes the CRCs and checks both readers.
fn rejected_law(at: usize, piece: &[u8], expect: &Expect) {
    let mut bytes = falling().encode();
    let (start, len) = span(&bytes, FRICTION);
    assert!(
        LAW + at + piece.len() <= len,
        "the patch leaves its section"
    );
    put(&mut bytes, start + LAW + at, piece);
    seal(&mut bytes);
    let case = format!("byte {at} of the law = {piece:02x?}");
    check(Asset::parse(&bytes).expect_err(&case), expect, &case);
    check(Asset::parse_haptic(&bytes).expect_err(&case), expect, &case);
}

#[test]
fn the_law_of_friction() {
    for count in [0, 1, 9, 255] {
        rejected_law(0, &[count], &Invalid("friction.law.count", 0, count.into()));
    }
    rejected_law(0, &[4], &Short("friction.law.points", 16, 12));
    rejected_law(0, &[2], &Long("friction", LAW as u64 + 9, LAW as u64 + 13));
    // Speeds ascend strictly: point 1 at 20 mm/s, then below it.
    for (code, speed_mm_s) in [(320_u16, 20.0), (319, 19.9375), (0, 0.0)] {
        let wrong = Invalid("friction.law.speed_mm_s", 1, speed_mm_s);
        rejected_law(5, &code.to_le_bytes(), &wrong);
    }
    // At point 2, what point 1 has.
    let wrong = Invalid("friction.law.speed_mm_s", 2, 60.0);
    rejected_law(9, &960_u16.to_le_bytes(), &wrong);
    // μ is 0.5: any factor is within 10. With μ = 2 those above 5 are not.
    let mut bytes = falling().encode();
    let (start, _) = span(&bytes, FRICTION);
    put(&mut bytes, start, &2.0_f32.to_le_bytes());
    put(&mut bytes, start + LAW + 3, &40_960_u16.to_le_bytes());
    seal(&mut bytes);
    assert!(Asset::parse(&bytes).is_ok(), "2·5 is 10");
    put(&mut bytes, start + LAW + 3, &40_961_u16.to_le_bytes());
    seal(&mut bytes);
    let wrong = Invalid("friction.law.factor", 0, 40_961.0 / 8192.0);
    check(
        Asset::parse(&bytes).unwrap_err(),
        &wrong,
        "2 times more than 5",
    );
}

#[test]
fn a_law_of_another_length() {
    let original = falling().encode();
    let (start, len) = span(&original, FRICTION);
    let body = original[start..start + len].to_vec();
    for shorter in 0..len {
        let mut bytes = original.clone();
        replace_section(&mut bytes, FRICTION, &body[..shorter]);
        let error = Asset::parse(&bytes).unwrap_err();
        assert!(
            matches!(error, FormatError::TooShort { .. }),
            "{shorter} bytes: {error:?}"
        );
    }
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
        // The runtime does not read this section.
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
    let (total, haptic) = (original.len() as f64, crate::common::u32_at(&original, 12));
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
    for version in [0_u16, 4, 65535] {
        assert_eq!(
            patched(4, &version.to_le_bytes()),
            FormatError::Version {
                found: version,
                supported: 3
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

/// Patches a section of [`ribbed`], recomputes the CRCs and checks both readers.
fn rejected_section(section: usize, at: usize, piece: &[u8], expect: &Expect) {
    let mut bytes = ribbed().encode();
    let (start, _) = span(&bytes, section);
    put(&mut bytes, start + at, piece);
    seal(&mut bytes);
    let case = format!("byte {at} of section {section} = {piece:02x?}");
    check(Asset::parse(&bytes).expect_err(&case), expect, &case);
    check(Asset::parse_haptic(&bytes).expect_err(&case), expect, &case);
}

fn rejected_contact(at: usize, piece: &[u8], expect: &Expect) {
    rejected_section(CONTACT, at, piece, expect);
}

#[test]
fn the_direction() {
    let rejected = |at: usize, value: f32, expect: &Expect| {
        rejected_section(AXIS, at, &value.to_le_bytes(), expect);
    };
    for (at, field, least, most) in [
        (12, "direction.power_ratio", 0.0_f32, 2.0_f32),
        (16, "direction.speed_ratio", 0.125, 2.0),
        (20, "direction.mu_forward", 0.0625, 4.0),
        (24, "direction.mu_backward", 0.0625, 4.0),
    ] {
        let below = if least > 0.0 {
            least.next_down()
        } else {
            -1e-30
        };
        for value in [below, most.next_up(), f32::NAN, f32::INFINITY] {
            rejected(at, value, &Invalid(field, 0, value.into()));
        }
    }
    for (part, at) in [0, 4, 8].into_iter().enumerate() {
        for value in [1.002, -1.002, f32::NAN, f32::NEG_INFINITY] {
            rejected(
                at,
                value,
                &Invalid("direction.axis", part as u32, value.into()),
            );
        }
    }
    // The axis is (0, 0.8, −0.6).
    for (at, value) in [(0, 0.011_f32), (4, 0.8001), (8, 0.0)] {
        let mut axis = [0.0, 0.8_f32, -0.6];
        axis[at / 4] = value;
        let square = axis.iter().fold(0.0, |sum, x| sum + x * x);
        rejected(at, value, &Invalid("direction.axis", 0, square.into()));
    }
    // The law goes up to 1.5 times μ.
    for (mu, most) in [(5.0, 10.0 / 7.5), (0.5, 4.0)] {
        let grips = |mu_backward| {
            let mut parts = ribbed();
            parts.mu = mu;
            parts.direction = parts.direction.map(|direction| Direction {
                mu_backward,
                ..direction
            });
            parts.encode_into(1 << 17)
        };
        assert!(grips(0.999 * most).is_ok());
        let beyond = 1.001 * most;
        let named = FormatError::Invalid {
            field: "direction.mu_backward",
            index: 0,
            value: f64::from(beyond),
            rule: if mu > 1.0 {
                "μ times the ratio must be 10 at most"
            } else {
                "0.0625 to 4"
            },
        };
        assert_eq!(grips(beyond), Err(EncodeError::Rejected(named)));
    }
}

#[test]
fn the_contact_law() {
    // Offset, field, largest value, offset of the number without which it must be 0.
    for (at, field, most, part) in [
        (0, "contact.damping_s_m", 100.0, None),
        (4, "contact.relaxation.stiffness_n_m", 1e5, None),
        (8, "contact.relaxation.time_s", 20.0, Some(4)),
        (12, "contact.imprint.yield_m", 0.05, Some(16)),
        (16, "contact.imprint.share", 1.0, None),
        (20, "contact.imprint.heal", 1.0, Some(16)),
        (24, "contact.imprint.recovery_s", 60.0, Some(16)),
        (28, "contact.drag.viscous_n_s_m2", 1e5, None),
        (32, "contact.drag.plough_n_m", 1e4, None),
        (36, "contact.adhesion.pull_n", 100.0, None),
        (40, "contact.adhesion.stiffness_n_m", 1e5, Some(36)),
    ] {
        let most: f32 = most;
        for value in [-1e-30, most.next_up(), f32::NAN, f32::INFINITY] {
            let wrong = Invalid(field, 0, value.into());
            rejected_contact(at, &value.to_le_bytes(), &wrong);
        }
        if let Some(part) = part {
            let mut bytes = yielding().encode();
            let (start, _) = span(&bytes, CONTACT);
            put(&mut bytes, start + part, &[0; 4]);
            seal(&mut bytes);
            let error = Asset::parse(&bytes).unwrap_err();
            let named = matches!(error, FormatError::Invalid { .. });
            assert!(named, "{field} without its part: {error:?}");
        }
    }
    for time_s in [0.0, 0.004_99] {
        let wrong = Invalid("contact.relaxation.time_s", 0, f64::from(time_s as f32));
        rejected_contact(8, &(time_s as f32).to_le_bytes(), &wrong);
    }
    for count in [7, 255] {
        rejected_contact(
            44,
            &[count],
            &Invalid("contact.spring.count", 0, count.into()),
        );
    }
    rejected_contact(44, &[4], &Short("contact.spring.points", 16, 12));
    rejected_contact(44, &[2], &Long("contact", 53, 57));
    // Point 0 is (10, 2.5) mm, point 1 (30, 5) mm.
    for code in [10_000_u16, 9_999, 0] {
        let wrong = Invalid("contact.spring.depth_m", 1, f64::from(code) / 1e6);
        rejected_contact(49, &code.to_le_bytes(), &wrong);
    }
    for code in [2_499_u16, 0, 22_501] {
        let wrong = Invalid("contact.spring.shape_m", 1, f64::from(code) / 1e6);
        rejected_contact(51, &code.to_le_bytes(), &wrong);
    }
}
