//! A field out of its range is rejected with its name, its index and its value, even if every
//! CRC is right.

mod grid;
mod others;

use crate::common::{
    falling, put, replace_section, seal, seal_header,
    section::{AXIS, CONTACT, FRICTION, GRID, NAME, PREVIEW, PROVENANCE, SURFACE, TAPS},
    small, span, yielding,
};
use asperity_formats::{Asset, FormatError};

/// Offsets in the sections of [`small`].
const MODEL: usize = 12;
const VERTEX: usize = MODEL + 2 * 8;
const TRIANGLE: usize = VERTEX + 5 * 12;
const TRACE: usize = 8;
const ANCHOR: usize = 5;
/// Behind the only anchor.
const LAW: usize = ANCHOR + 15;

/// Expected error for a patched field.
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

/// Patches a section of the small asset, recomputes the CRCs and checks both readers.
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

/// Values just outside `min..=max`, NaN and the infinities.
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
