//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1807.0,
        pole: 17.0,
        zero: 26.7,
        triangle: 0.0,
        surfaces: [62.0, 118.0, 244.0],
        above_percent: 18.0,
    },
    Cost {
        processor: "x86-64",
        base: 1181.0,
        pole: 4.7,
        zero: 8.4,
        triangle: 0.0,
        surfaces: [39.0, 111.0, 181.0],
        above_percent: 18.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 1701),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 2001),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 1973),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 2052),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2132),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2452),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 1939),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 1884),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 2022),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2494),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 2001),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 2001),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2497),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 2945),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 3953),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 2849),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1126),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1116),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1201),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1294),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1218),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1352),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1113),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1202),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1172),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1330),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1156),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1108),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1428),
    ("x86-64", [10, 0, 56, 2, 8, 0], 2004),
    ("x86-64", [10, 0, 56, 2, 0, 8], 2564),
    ("x86-64", [10, 0, 56, 4, 2, 2], 1778),
];
