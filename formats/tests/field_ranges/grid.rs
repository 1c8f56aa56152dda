//! Fields of the grid: numbers, counts, LSFs, references, tiling.

use super::*;

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
    // 88 bytes follow the twelve of the section's head.
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
    // A first LSF that is too high shows at the second one.
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
    // Triangle 0, of 100 mm·N/s, twice and triangle 1 never: too little or too much area.
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
