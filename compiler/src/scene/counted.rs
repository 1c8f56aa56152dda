//! Written by `cargo run --release --manifest-path benches/cortex-m/Cargo.toml -- costs`.

use super::cost::Cost;

/// Slopes between the ends of what was counted; the base such that no count is above the model.
pub(super) const COSTS: [Cost; 2] = [
    Cost {
        processor: "cortex-m4f",
        base: 1787.0,
        pole: 25.2,
        zero: 14.9,
        triangle: 4.8,
        surfaces: [62.0, 120.0, 184.0],
        above_percent: 5.0,
    },
    Cost {
        processor: "x86-64",
        base: 1241.0,
        pole: 10.5,
        zero: 3.2,
        triangle: 0.5,
        surfaces: [43.0, 110.0, 161.0],
        above_percent: 8.0,
    },
];

/// The costliest tick of 12,000, in QEMU: poles, zeros that are mixed and converted, triangles, planes, spheres, boxes.
#[cfg(test)]
pub(super) const MEASURED: [(&str, [usize; 6], u64); 32] = [
    ("cortex-m4f", [4, 0, 56, 2, 0, 0], 2222),
    ("cortex-m4f", [10, 0, 56, 2, 0, 0], 2356),
    ("cortex-m4f", [20, 0, 56, 2, 0, 0], 2624),
    ("cortex-m4f", [4, 2, 56, 2, 0, 0], 2222),
    ("cortex-m4f", [10, 8, 56, 2, 0, 0], 2490),
    ("cortex-m4f", [20, 18, 56, 2, 0, 0], 2892),
    ("cortex-m4f", [7, 0, 56, 2, 0, 0], 2356),
    ("cortex-m4f", [16, 0, 56, 2, 0, 0], 2490),
    ("cortex-m4f", [24, 0, 56, 2, 0, 0], 2758),
    ("cortex-m4f", [15, 13, 56, 2, 0, 0], 2624),
    ("cortex-m4f", [10, 0, 12, 2, 0, 0], 2216),
    ("cortex-m4f", [10, 0, 98, 2, 0, 0], 2624),
    ("cortex-m4f", [10, 0, 56, 10, 0, 0], 2852),
    ("cortex-m4f", [10, 0, 56, 2, 8, 0], 3316),
    ("cortex-m4f", [10, 0, 56, 2, 0, 8], 3828),
    ("cortex-m4f", [10, 0, 56, 4, 2, 2], 3088),
    ("x86-64", [4, 0, 56, 2, 0, 0], 1311),
    ("x86-64", [10, 0, 56, 2, 0, 0], 1400),
    ("x86-64", [20, 0, 56, 2, 0, 0], 1479),
    ("x86-64", [4, 2, 56, 2, 0, 0], 1311),
    ("x86-64", [10, 8, 56, 2, 0, 0], 1406),
    ("x86-64", [20, 18, 56, 2, 0, 0], 1535),
    ("x86-64", [7, 0, 56, 2, 0, 0], 1355),
    ("x86-64", [16, 0, 56, 2, 0, 0], 1422),
    ("x86-64", [24, 0, 56, 2, 0, 0], 1497),
    ("x86-64", [15, 13, 56, 2, 0, 0], 1554),
    ("x86-64", [10, 0, 12, 2, 0, 0], 1380),
    ("x86-64", [10, 0, 98, 2, 0, 0], 1417),
    ("x86-64", [10, 0, 56, 10, 0, 0], 1744),
    ("x86-64", [10, 0, 56, 2, 8, 0], 2280),
    ("x86-64", [10, 0, 56, 2, 0, 8], 2688),
    ("x86-64", [10, 0, 56, 4, 2, 2], 2028),
];
