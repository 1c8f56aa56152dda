//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1773.0,
        pole: 25.2,
        zero: 14.9,
        triangle: 4.6,
        surfaces: [63.0, 121.0, 185.0],
        above_percent: 5.0,
    },
    Cost {
        processor: "x86-64",
        base: 1241.0,
        pole: 10.7,
        zero: 3.2,
        triangle: 0.5,
        surfaces: [43.0, 110.0, 161.0],
        above_percent: 8.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 2199),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 2333),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 2601),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 2199),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2467),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2869),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 2333),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 2467),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 2735),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2601),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 2206),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 2601),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2837),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 3301),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 3813),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 3071),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1312),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1402),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1483),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1312),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1411),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1540),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1356),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1426),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1502),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1557),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1382),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1419),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1746),
    ("x86-64", [10, 0, 56, 2, 8, 0], 2282),
    ("x86-64", [10, 0, 56, 2, 0, 8], 2690),
    ("x86-64", [10, 0, 56, 4, 2, 2], 2030),
];
