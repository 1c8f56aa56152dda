//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model. Since the counts a tick
/// takes some 36 instructions more on a Cortex-M4F, and 16 on x86-64 (`docs/floating-point.md`), which the bases include.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1820.0,
        pole: 11.4,
        zero: 6.2,
        triangle: 0.0,
        surfaces: [76.0, 88.0, 150.0],
        above_percent: 22.0,
    },
    Cost {
        processor: "x86-64",
        base: 1316.0,
        pole: 3.0,
        zero: 4.1,
        triangle: 0.0,
        surfaces: [45.0, 49.0, 82.0],
        above_percent: 28.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 1734),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 1734),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 1916),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 1909),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2099),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2026),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 1734),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 1864),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 1906),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2147),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 1734),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 1734),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2342),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 2438),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 2934),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 2362),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1250),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1265),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1297),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1122),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1273),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1370),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1253),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1232),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1350),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1488),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1265),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1265),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1625),
    ("x86-64", [10, 0, 56, 2, 8, 0], 1657),
    ("x86-64", [10, 0, 56, 2, 0, 8], 1921),
    ("x86-64", [10, 0, 56, 4, 2, 2], 1617),
];
