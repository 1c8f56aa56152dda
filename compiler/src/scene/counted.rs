//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1794.0,
        pole: 18.6,
        zero: 26.3,
        triangle: 0.0,
        surfaces: [76.0, 98.0, 160.0],
        above_percent: 18.0,
    },
    Cost {
        processor: "x86-64",
        base: 1213.0,
        pole: 3.8,
        zero: 8.9,
        triangle: 0.0,
        surfaces: [45.0, 74.0, 109.0],
        above_percent: 15.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 1724),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 2012),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 2021),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 2073),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2168),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2493),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 1955),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 1914),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 2056),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2512),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 2012),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 2012),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2620),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 2796),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 3292),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 2680),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1188),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1175),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1248),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1336),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1275),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1407),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1172),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1274),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1232),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1398),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1201),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1172),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1535),
    ("x86-64", [10, 0, 56, 2, 8, 0], 1767),
    ("x86-64", [10, 0, 56, 2, 0, 8], 2047),
    ("x86-64", [10, 0, 56, 4, 2, 2], 1631),
];
