//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1801.0,
        pole: 17.4,
        zero: 27.0,
        triangle: 0.0,
        surfaces: [62.0, 122.0, 186.0],
        above_percent: 18.0,
    },
    Cost {
        processor: "x86-64",
        base: 1172.0,
        pole: 4.9,
        zero: 8.4,
        triangle: 0.0,
        surfaces: [39.0, 113.0, 164.0],
        above_percent: 19.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 1701),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 2003),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 1978),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 2048),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2117),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2464),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 1947),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 1897),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 2040),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2496),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 2003),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 2003),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2499),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 2979),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 3491),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 2743),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1121),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1106),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1199),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1286),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1213),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1349),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1104),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1206),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1154),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1261),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1147),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1095),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1418),
    ("x86-64", [10, 0, 56, 2, 8, 0], 2010),
    ("x86-64", [10, 0, 56, 2, 0, 8], 2418),
    ("x86-64", [10, 0, 56, 4, 2, 2], 1738),
];
