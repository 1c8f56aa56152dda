//! Queries that cross a grid, for what is measured without a hand.

use asperity_formats::Asset;

/// Speeds, mm/s, and forces, N, that cross the grid.
#[must_use]
pub fn queries(asset: &Asset<'_>) -> Vec<(f32, f32)> {
    let grid = asset.grid();
    let (speed_mm_s, force_n) = (grid.max_speed_mm_s(), grid.max_force_n());
    let query = |n: usize| {
        let t = n as f32 * 1e-3;
        let across = |x: f32| 0.5 + 0.48 * x;
        (
            speed_mm_s * across((9.0 * t).sin()),
            force_n * across((14.0 * t).cos()),
        )
    };
    (0..2000).map(query).collect()
}
