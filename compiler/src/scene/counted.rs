//! Written by `cargo run --release -p asperity-cortex-m -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 2174.0,
        pole: 10.4,
        zero: 5.1,
        triangle: 0.0,
        law: 77.0,
        surfaces: [76.0, 84.0, 146.0],
        above_percent: 16.0,
    },
    Cost {
        processor: "x86-64",
        base: 1392.0,
        pole: 2.7,
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
    ("cortex-m4f", [4, 0, 56, 0, 2, 0, 0], 2121),
    ("cortex-m4f", [10, 0, 56, 0, 2, 0, 0], 2121),
    ("cortex-m4f", [20, 0, 56, 0, 2, 0, 0], 2287),
    ("cortex-m4f", [4, 2, 56, 0, 2, 0, 0], 2121),
    ("cortex-m4f", [10, 8, 56, 0, 2, 0, 0], 2470),
    ("cortex-m4f", [20, 18, 56, 0, 2, 0, 0], 2378),
    ("cortex-m4f", [7, 0, 56, 0, 2, 0, 0], 2121),
    ("cortex-m4f", [16, 0, 56, 0, 2, 0, 0], 2239),
    ("cortex-m4f", [24, 0, 56, 0, 2, 0, 0], 2232),
    ("cortex-m4f", [15, 13, 56, 0, 2, 0, 0], 2489),
    ("cortex-m4f", [10, 0, 12, 0, 2, 0, 0], 2121),
    ("cortex-m4f", [10, 0, 98, 0, 2, 0, 0], 2121),
    ("cortex-m4f", [10, 0, 56, 1, 2, 0, 0], 2198),
    ("cortex-m4f", [10, 0, 56, 0, 10, 0, 0], 2729),
    ("cortex-m4f", [10, 0, 56, 0, 2, 8, 0], 2793),
    ("cortex-m4f", [10, 0, 56, 0, 2, 0, 8], 3289),
    ("cortex-m4f", [10, 0, 56, 0, 4, 2, 2], 2733),
    ("x86-64", [4, 0, 56, 0, 2, 0, 0], 1332),
    ("x86-64", [10, 0, 56, 0, 2, 0, 0], 1342),
    ("x86-64", [20, 0, 56, 0, 2, 0, 0], 1374),
    ("x86-64", [4, 2, 56, 0, 2, 0, 0], 1201),
    ("x86-64", [10, 8, 56, 0, 2, 0, 0], 1348),
    ("x86-64", [20, 18, 56, 0, 2, 0, 0], 1442),
    ("x86-64", [7, 0, 56, 0, 2, 0, 0], 1335),
    ("x86-64", [16, 0, 56, 0, 2, 0, 0], 1309),
    ("x86-64", [24, 0, 56, 0, 2, 0, 0], 1431),
    ("x86-64", [15, 13, 56, 0, 2, 0, 0], 1575),
    ("x86-64", [10, 0, 12, 0, 2, 0, 0], 1342),
    ("x86-64", [10, 0, 98, 0, 2, 0, 0], 1342),
    ("x86-64", [10, 0, 56, 1, 2, 0, 0], 1459),
    ("x86-64", [10, 0, 56, 0, 10, 0, 0], 1718),
    ("x86-64", [10, 0, 56, 0, 2, 8, 0], 1742),
    ("x86-64", [10, 0, 56, 0, 2, 0, 8], 2006),
    ("x86-64", [10, 0, 56, 0, 4, 2, 2], 1702),
];
