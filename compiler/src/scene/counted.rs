//! Written by `cargo run --release -p asperity-cortex-m -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 2168.0,
        pole: 10.5,
        zero: 5.0,
        triangle: 0.0,
        law: 76.0,
        surfaces: [76.0, 84.0, 146.0],
        above_percent: 16.0,
    },
    Cost {
        processor: "x86-64",
        base: 1390.0,
        pole: 2.5,
        zero: 3.8,
        triangle: 0.0,
        law: 117.0,
        surfaces: [47.0, 50.0, 83.0],
        above_percent: 26.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles,
/// laws of friction, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 7], u64); 34] = [
    ("cortex-m4f", [4, 0, 56, 0, 2, 0, 0], 2115),
    ("cortex-m4f", [10, 0, 56, 0, 2, 0, 0], 2115),
    ("cortex-m4f", [20, 0, 56, 0, 2, 0, 0], 2282),
    ("cortex-m4f", [4, 2, 56, 0, 2, 0, 0], 2115),
    ("cortex-m4f", [10, 8, 56, 0, 2, 0, 0], 2465),
    ("cortex-m4f", [20, 18, 56, 0, 2, 0, 0], 2372),
    ("cortex-m4f", [7, 0, 56, 0, 2, 0, 0], 2115),
    ("cortex-m4f", [16, 0, 56, 0, 2, 0, 0], 2233),
    ("cortex-m4f", [24, 0, 56, 0, 2, 0, 0], 2228),
    ("cortex-m4f", [15, 13, 56, 0, 2, 0, 0], 2484),
    ("cortex-m4f", [10, 0, 12, 0, 2, 0, 0], 2115),
    ("cortex-m4f", [10, 0, 98, 0, 2, 0, 0], 2115),
    ("cortex-m4f", [10, 0, 56, 1, 2, 0, 0], 2191),
    ("cortex-m4f", [10, 0, 56, 0, 10, 0, 0], 2723),
    ("cortex-m4f", [10, 0, 56, 0, 2, 8, 0], 2787),
    ("cortex-m4f", [10, 0, 56, 0, 2, 0, 8], 3283),
    ("cortex-m4f", [10, 0, 56, 0, 4, 2, 2], 2727),
    ("x86-64", [4, 0, 56, 0, 2, 0, 0], 1328),
    ("x86-64", [10, 0, 56, 0, 2, 0, 0], 1336),
    ("x86-64", [20, 0, 56, 0, 2, 0, 0], 1368),
    ("x86-64", [4, 2, 56, 0, 2, 0, 0], 1195),
    ("x86-64", [10, 8, 56, 0, 2, 0, 0], 1342),
    ("x86-64", [20, 18, 56, 0, 2, 0, 0], 1436),
    ("x86-64", [7, 0, 56, 0, 2, 0, 0], 1331),
    ("x86-64", [16, 0, 56, 0, 2, 0, 0], 1303),
    ("x86-64", [24, 0, 56, 0, 2, 0, 0], 1426),
    ("x86-64", [15, 13, 56, 0, 2, 0, 0], 1570),
    ("x86-64", [10, 0, 12, 0, 2, 0, 0], 1336),
    ("x86-64", [10, 0, 98, 0, 2, 0, 0], 1336),
    ("x86-64", [10, 0, 56, 1, 2, 0, 0], 1453),
    ("x86-64", [10, 0, 56, 0, 10, 0, 0], 1712),
    ("x86-64", [10, 0, 56, 0, 2, 8, 0], 1736),
    ("x86-64", [10, 0, 56, 0, 2, 0, 8], 2000),
    ("x86-64", [10, 0, 56, 0, 4, 2, 2], 1696),
];
