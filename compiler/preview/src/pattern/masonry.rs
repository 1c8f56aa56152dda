//! Stonework: walls, floors, roads.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{cell, dome, floor, fract, gradient, hash, nth, octaves, step, unit, wave},
    surface::{Surface, Texel},
};

/// Setts or cobbles in courses.
pub(super) fn cobbles(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(6.0);
    Surface::of(size, |u, v| {
        let s = 0.03 * gradient(u, v, n * 2, n * 2, appearance.seed);
        let (row, column) = ((v + s) * n as f32, (u + s) * n as f32 * 0.999_999);
        let y = floor(row);
        let x = column + 0.5 * (y & 1) as f32;
        let id = hash(floor(x).rem_euclid(n), y.rem_euclid(n), appearance.seed);
        let (a, b) = (2.0 * fract(x) - 1.0, 2.0 * fract(row) - 1.0);
        let d = (a * a * a * a + b * b * b * b).sqrt().sqrt();
        let top = step(0.98, 0.55, d);
        let rough = octaves(u, v, n * 5, n * 5, 3, appearance.seed + 3);
        let stone = lit(
            appearance.any(unit(id)),
            0.75 + 0.45 * nth(id, 1) + 0.25 * rough,
        );
        Texel {
            height: (0.30 * top + 0.03 * rough) / n as f32,
            color: mix(lit(appearance.color(9), 0.35), stone, step(1.0, 0.86, d)),
            gloss: appearance.shine(0.1) * top,
            glow: 0.0,
        }
    })
}

/// Grey cast stone with pits, stains and a hair crack.
pub(super) fn concrete(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(20.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let stain = octaves(u, v, 3, 3, 3, seed);
        let grain = octaves(u, v, 60, 60, 2, seed + 1);
        let pit = cell(u, v, n, n, 1.0, seed + 2);
        let radius = 0.02 + 0.20 * nth(pit.id, 1) * nth(pit.id, 2) * nth(pit.id, 5);
        let hole = if nth(pit.id, 3) < 0.75 {
            step(radius * 1.3, radius * 0.7, pit.near)
        } else {
            0.0
        };
        let w = 0.05 * octaves(u, v, 6, 6, 3, seed + 3);
        let crack = cell(u + w, v + w, 2, 2, 0.9, seed + 4);
        let line =
            step(0.007, 0.002, crack.edge) * step(-0.1, 0.15, gradient(u, v, 2, 2, seed + 5));
        let sand = step(
            0.9,
            0.97,
            nth(cell(u, v, n * 5, n * 5, 1.0, seed + 6).id, 1),
        );
        let tone = 1.0 + 0.20 * stain + 0.16 * grain - 0.25 * sand;
        Texel {
            height: 0.002 * grain + 0.004 * stain - 0.014 * hole - 0.008 * line,
            color: mix(
                lit(appearance.color(0), tone),
                lit(appearance.color(1), 0.5),
                0.75 * hole.max(0.9 * line),
            ),
            gloss: appearance.shine(0.0),
            glow: 0.0,
        }
    })
}

/// A wall coat: trowelled or combed, matt.
pub(super) fn plaster(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let n = appearance.count(5.0);
    Surface::of(size, |u, v| {
        let w = 0.10 * octaves(u, v, 3, 3, 2, seed);
        let sweep = cell(u + w, v - w, n, n, 1.0, seed + 1);
        let turn = nth(sweep.id, 1);
        let along = sweep.way.0 * wave(turn) + sweep.way.1 * wave(turn + 0.25);
        let ridge = octaves(along * 0.9 + nth(sweep.id, 2), 0.3, 16, 3, 2, seed + 2);
        let fine = octaves(u, v, 40, 40, 3, seed + 3);
        let lip = step(0.06, 0.0, sweep.edge);
        Texel {
            height: (0.006 * ridge + 0.010 * along * nth(sweep.id, 3) + 0.003 * fine + 0.006 * lip)
                * 0.9,
            color: lit(appearance.color(0), 0.97 + 0.05 * fine + 0.03 * ridge),
            gloss: appearance.shine(0.0),
            glow: 0.0,
        }
    })
}

/// Courses of bricks in mortar.
pub(super) fn brick(appearance: &Appearance, size: usize) -> Surface {
    let rows = appearance.even(8.0);
    let columns = (rows / 2).max(1);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let s = 0.006 * octaves(u, v, 20, 20, 3, seed);
        let y = (v + s) * rows as f32;
        let row = floor(y);
        let x = (u + s) * columns as f32 + 0.5 * (row & 1) as f32;
        let id = hash(floor(x).rem_euclid(columns), row.rem_euclid(rows), seed);
        let (a, b) = (fract(x), fract(y));
        // Distance to the mortar's middle, rows.
        let d = (2.0 * a.min(1.0 - a)).min(b.min(1.0 - b));
        let face = step(0.07, 0.16, d);
        let rough = octaves(u, v, 40, 40, 3, seed + 1 + (id & 15));
        let pit = cell(u, v, 40, 40, 1.0, seed + 2);
        let hole = if nth(pit.id, 1) < 0.3 {
            step(0.35, 0.2, pit.near)
        } else {
            0.0
        };
        let burnt = step(0.72, 1.0, nth(id, 2));
        let body = mix(appearance.color(0), appearance.color(1), nth(id, 1));
        let body = lit(
            body,
            (0.82 + 0.35 * nth(id, 3)) * (1.0 + 0.25 * rough) * (1.0 - 0.35 * burnt - 0.3 * hole),
        );
        let joint = lit(appearance.color(2), 0.9 + 0.25 * rough);
        Texel {
            height: 0.016 * face + 0.004 * rough - 0.005 * hole * face,
            color: mix(joint, body, step(0.3, 0.7, face)),
            gloss: appearance.shine(0.0),
            glow: 0.0,
        }
    })
}

/// Square tiles in grout; glazed, they mirror a window.
pub(super) fn tile(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(4.0);
    let seed = appearance.seed;
    let glaze = appearance.shine(0.8);
    Surface::of(size, |u, v| {
        let (x, y) = (u * n as f32, v * n as f32);
        let id = hash(floor(x).rem_euclid(n), floor(y).rem_euclid(n), seed);
        let (a, b) = (fract(x), fract(y));
        let d = a.min(1.0 - a).min(b.min(1.0 - b));
        let face = step(0.022, 0.034, d);
        let bevel = step(0.03, 0.10, d);
        let t = a + b + 0.1 * (nth(id, 4) - 0.5) + 0.05 * gradient(u, v, n * 2, n * 2, seed);
        let window = step(0.62, 0.66, t) * step(0.92, 0.88, t)
            + 0.6 * step(0.97, 1.0, t) * step(1.10, 1.06, t);
        let rough = octaves(u, v, 40, 40, 2, seed + 1);
        let body = lit(
            mix(appearance.color(0), appearance.color(1), nth(id, 1) * 0.7),
            0.93 + 0.14 * nth(id, 2) + 0.10 * (1.0 - glaze) * rough,
        );
        let joint = lit(appearance.color(2), 0.85 + 0.15 * rough);
        Texel {
            height: 0.012 * face + 0.010 * bevel * face + 0.003 * (1.0 - glaze) * rough,
            color: mix(joint, body, face),
            gloss: glaze * face,
            glow: 0.30 * glaze * window * bevel,
        }
    })
}

/// Coarse stones in a ground: render, aggregate, asphalt.
pub(super) fn aggregate(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(30.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 0.9, seed);
        let radius = 0.30 + 0.25 * nth(c.id, 1);
        let warped = c.near * (1.0 + 0.35 * gradient(u, v, n * 2, n * 2, seed + 1));
        let stone = if nth(c.id, 2) < 0.8 {
            step(radius, radius * 0.75, warped)
        } else {
            0.0
        };
        let rough = octaves(u, v, n * 3, n * 3, 2, seed + 2);
        let body = lit(appearance.any(nth(c.id, 3)), 0.75 + 0.45 * nth(c.id, 4));
        Texel {
            height: (0.45 * stone * dome((warped / radius).min(1.0)) + 0.08 * rough) / n as f32,
            color: mix(lit(appearance.color(0), 0.8 + 0.3 * rough), body, stone),
            gloss: appearance.shine(0.05),
            glow: 0.4 * step(0.96, 1.0, nth(c.id, 5)) * stone,
        }
    })
}
