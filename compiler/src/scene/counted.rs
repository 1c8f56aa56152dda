//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1720.0,
        pole: 5.9,
        zero: 12.3,
        triangle: 0.0,
        surfaces: [76.0, 86.0, 148.0],
        above_percent: 9.0,
    },
    Cost {
        processor: "x86-64",
        base: 1228.0,
        pole: 1.4,
        zero: 0.0,
        triangle: 0.0,
        surfaces: [55.0, 57.0, 89.0],
        above_percent: 19.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 1750),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 1803),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 1843),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 1826),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2029),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2064),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 1771),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 1812),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 1916),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2023),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 1803),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 1803),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2411),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 2491),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 2987),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 2423),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1269),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1275),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1291),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1137),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1292),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1269),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1272),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1278),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1251),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1359),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1284),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1275),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1715),
    ("x86-64", [10, 0, 56, 2, 8, 0], 1731),
    ("x86-64", [10, 0, 56, 2, 0, 8], 1987),
    ("x86-64", [10, 0, 56, 4, 2, 2], 1677),
];
