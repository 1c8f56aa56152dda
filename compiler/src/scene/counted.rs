//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1610.0,
        pole: 1.9,
        zero: 23.6,
        triangle: 1.7,
        surfaces: [76.0, 86.0, 148.0],
        above_percent: 14.0,
    },
    Cost {
        processor: "x86-64",
        base: 1168.0,
        pole: 2.2,
        zero: 0.0,
        triangle: 0.0,
        surfaces: [45.0, 48.0, 81.0],
        above_percent: 13.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 1652),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 1652),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 1681),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 1790),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2065),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2105),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 1652),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 1658),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 1808),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2067),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 1680),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 1823),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2260),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 2340),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 2836),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 2272),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1239),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1250),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1273),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1129),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1280),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1265),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1244),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1255),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1250),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1283),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1269),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1250),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1610),
    ("x86-64", [10, 0, 56, 2, 8, 0], 1634),
    ("x86-64", [10, 0, 56, 2, 0, 8], 1898),
    ("x86-64", [10, 0, 56, 4, 2, 2], 1598),
];
