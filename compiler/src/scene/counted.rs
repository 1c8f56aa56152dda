//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) static COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1765.0,
        pole: 6.1,
        zero: 11.3,
        triangle: 0.0,
        surfaces: [76.0, 98.0, 160.0],
        above_percent: 9.0,
    },
    Cost {
        processor: "x86-64",
        base: 1288.0,
        pole: 1.4,
        zero: 0.0,
        triangle: 0.0,
        surfaces: [45.0, 74.0, 109.0],
        above_percent: 18.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 1791),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 1842),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 1888),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 1872),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2068),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2091),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 1812),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 1859),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 1944),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2047),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 1842),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 1842),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2450),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 2626),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 3122),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 2510),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1304),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1310),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1326),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1177),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1326),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1301),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1307),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1313),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1286),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1399),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1319),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1310),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1670),
    ("x86-64", [10, 0, 56, 2, 8, 0], 1902),
    ("x86-64", [10, 0, 56, 2, 0, 8], 2182),
    ("x86-64", [10, 0, 56, 4, 2, 2], 1766),
];
