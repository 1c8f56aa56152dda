//! Lengths and counts that exceed the file are refused, and the checks run in their order.

use crate::common::{
    append_section, falling, full, put, seal, seal_header, section::GRID, small, span, yielding,
};
use asperity_formats::{Asset, FormatError, Library, library};
use proptest::{collection::vec, prelude::*};

#[test]
fn a_section_of_four_gigabytes_is_refused_by_the_sum() {
    let total = small().encode().len() as f64;
    for section in 0..7 {
        for len in [u32::MAX, u32::MAX - 1, 1 << 31, 1 << 16] {
            let mut bytes = small().encode();
            put(&mut bytes, 20 + 12 * section + 4, &len.to_le_bytes());
            seal_header(&mut bytes);
            let error = Asset::parse(&bytes).unwrap_err();
            assert!(
                matches!(error, FormatError::Invalid { field: "header.total_len", value, .. }
                    if value == total),
                "section {section} of {len} bytes: {error:?}"
            );
        }
    }
}

#[test]
fn lengths_whose_sum_wraps_are_refused() {
    // Two sections claim 2³² bytes too many: a sum in 32 bits would come out right.
    let mut bytes = small().encode();
    for section in [0, 1] {
        let (_, len) = span(&bytes, section);
        let len = (len as u32).wrapping_add(1 << 31);
        put(&mut bytes, 20 + 12 * section + 4, &len.to_le_bytes());
    }
    seal_header(&mut bytes);
    let error = Asset::parse(&bytes).unwrap_err();
    assert!(
        matches!(
            error,
            FormatError::Invalid {
                field: "header.total_len",
                ..
            }
        ),
        "{error:?}"
    );
}

#[test]
fn a_table_that_is_not_there_is_too_short() {
    let mut bytes = small().encode();
    bytes.truncate(200);
    bytes[6] = 255;
    assert_eq!(
        Asset::parse(&bytes).map(drop),
        Err(FormatError::TooShort {
            field: "section table",
            needed: 20 + 12 * 255,
            found: 200
        })
    );
}

#[test]
fn more_than_sixteen_sections_are_refused() {
    let mut bytes = small().encode();
    for extra in 0..9 {
        append_section(&mut bytes, &[b'x', b'x', b'x', b'0' + extra], b"later");
    }
    assert_eq!(Asset::parse(&bytes).map(|a| a.sections().count()), Ok(16));
    append_section(&mut bytes, b"xxxx", b"");
    let error = Asset::parse(&bytes).unwrap_err();
    assert!(
        matches!(
            error,
            FormatError::Invalid {
                field: "header.section_count",
                value: 17.0,
                ..
            }
        ),
        "{error:?}"
    );
}

/// Every step breaks one more thing, from the last check to the first. The error must
/// always be that of the first check that fails.
#[test]
fn the_first_check_that_fails_is_the_one_that_speaks() {
    let mut bytes = full().encode();
    let (grid, _) = span(&bytes, GRID);
    let (_, surface) = span(&bytes, 4);
    let says = |bytes: &[u8]| format!("{:?}", Asset::parse(bytes).unwrap_err());

    let (surf, _) = span(&bytes, 4);
    put(&mut bytes, surf, &f32::NAN.to_le_bytes());
    seal(&mut bytes);
    assert!(
        says(&bytes).contains("surface.stiffness_n_m"),
        "meaning, last section"
    );
    put(&mut bytes, grid + 12, &[0, 0]);
    seal(&mut bytes);
    assert!(
        says(&bytes).contains("grid.model.lsf"),
        "meaning, an earlier section"
    );
    put(&mut bytes, grid + 9, &[128]);
    seal(&mut bytes);
    assert!(
        says(&bytes).contains("grid.triangles"),
        "structure before meaning"
    );
    bytes[surf + surface - 1] ^= 1;
    assert!(
        says(&bytes).contains("section: \"surface\""),
        "every CRC before any decoding"
    );
    bytes.push(0);
    assert!(
        says(&bytes).contains("TooLong"),
        "length before section CRCs"
    );
    put(&mut bytes, 8, &1_u32.to_le_bytes());
    seal_header(&mut bytes);
    assert!(
        says(&bytes).contains("header.total_len"),
        "the table before the actual length"
    );
    bytes[20] ^= 1;
    assert!(
        says(&bytes).contains("section: \"header\""),
        "header CRC before the table"
    );
    put(&mut bytes, 4, &[9, 9]);
    assert!(says(&bytes).contains("Version"), "version before CRC");
    bytes[0] = b'R';
    assert!(says(&bytes).contains("Magic"), "magic before version");
    bytes.truncate(19);
    assert!(says(&bytes).contains("TooShort"), "length before magic");
}

#[test]
fn other_kinds_of_file_are_told_apart() {
    let other = Err(FormatError::Magic {
        found: *b"RIFF",
        expected: *b"ASPT",
    });
    assert_eq!(
        Asset::parse(b"RIFF\x24\0\0\0WAVEfmt \x10\0\0\0").map(drop),
        other
    );
    let mut shelf = vec![0; 4096];
    let bytes = small().encode();
    library::encode_library(&[("Cork", &bytes)], &mut shelf).unwrap();
    assert!(matches!(
        Asset::parse(&shelf).map(drop),
        Err(FormatError::Magic {
            found: [b'A', b'S', b'P', b'L'],
            ..
        })
    ));
}

#[test]
fn errors_read_as_sentences() {
    let mut bytes = small().encode();
    let (grid, _) = span(&bytes, GRID);
    put(&mut bytes, grid, &0.0_f32.to_le_bytes());
    seal(&mut bytes);
    assert_eq!(
        Asset::parse(&bytes).unwrap_err().to_string(),
        "grid.sample_rate_hz[0] = 0: 100 Hz to 200 kHz"
    );
    let mut bytes = small().encode();
    put(&mut bytes, 20, b"none");
    seal_header(&mut bytes);
    assert_eq!(
        Asset::parse(&bytes).unwrap_err().to_string(),
        "section NAME: missing or out of order"
    );
}

/// Reads everything an asset offers.
fn read_all(asset: &Asset<'_>) -> f64 {
    let grid = asset.grid();
    let lsf = grid
        .models()
        .flat_map(|m| m.lsf().chain(m.ma_lsf()).map(|code| code.to_rad()));
    let taps = asset
        .taps()
        .traces()
        .flat_map(|t| t.accel_m_s2().map(f64::from));
    let anchors = asset
        .friction()
        .anchors()
        .map(|a| f64::from(a.mu + a.weight));
    let vertices = grid
        .vertices()
        .map(|v| f64::from(v.speed_mm_s + v.force_n + v.sigma_m_s2));
    let png = asset.preview_png().map_or(0, <[u8]>::len) as f64;
    let law = asset.friction().law();
    let law = law.into_iter().flat_map(|law| law.points());
    let law = law.map(|p| f64::from(p.speed_mm_s() + p.factor()));
    let contact = asset.contact().into_iter().flat_map(|law| {
        let numbers = law.damping_s_m + law.relaxation.time_s + law.imprint.yield_m;
        let points = law.points().map(|p| p.depth_m() + p.shape_m());
        points.chain([f64::from(numbers + law.adhesion.stiffness_n_m)])
    });
    let direction = asset.direction().into_iter().flat_map(|direction| {
        let numbers = [
            direction.power_ratio,
            direction.speed_ratio,
            direction.mu_forward,
        ];
        direction.axis.into_iter().chain(numbers).map(f64::from)
    });
    let numbers = lsf
        .chain(contact)
        .chain(direction)
        .chain(taps)
        .chain(anchors)
        .chain(law)
        .chain(vertices);
    numbers.sum::<f64>() + png
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// All CRCs are recomputed, so that the checks behind them are reached.
    #[test]
    fn sealed_damage_is_rejected_or_reads_as_finite_numbers(
        patches in vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        (table, kind) in (any::<bool>(), 0..3),
    ) {
        let mut bytes = match kind {
            0 => small(),
            1 => falling(),
            _ => yielding(),
        }
        .encode();
        for (at, value) in patches {
            let from = if table { 0 } else { 20 + 12 * 7 };
            let range = bytes.len() - from;
            bytes[from + at.index(range)] = value;
        }
        if 20 + 12 * usize::from(bytes[6]) <= bytes.len() {
            seal(&mut bytes);
        }
        if let Ok(asset) = Asset::parse(&bytes) {
            prop_assert!(read_all(&asset).is_finite());
        }
    }

    #[test]
    fn any_bytes_at_all_are_rejected(mut bytes in vec(any::<u8>(), 0..600), magic in 0..3) {
        match magic {
            0 if bytes.len() >= 6 => put(&mut bytes, 0, b"ASPT\x01\0"),
            1 if bytes.len() >= 6 => put(&mut bytes, 0, b"ASPL\x01\0"),
            _ => {}
        }
        prop_assert!(Asset::parse(&bytes).is_err());
        prop_assert!(Asset::parse_haptic(&bytes).is_err());
        prop_assert!(Library::parse(&bytes).is_err());
    }
}
