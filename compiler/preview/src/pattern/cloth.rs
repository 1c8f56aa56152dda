//! Threads over and under each other, and cloth that falls in folds.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{cell, dome, floor, fract, gradient, hash, lerp, octaves, step, unit, wave},
    surface::{Surface, Texel},
};

/// Which thread lies on top where thread `i` along and `j` across meet.
type Weave = fn(i32, i32) -> bool;

/// Plain weave: one over, one under.
pub(super) fn plain(appearance: &Appearance, size: usize) -> Surface {
    woven(appearance, size, appearance.even(44.0), 0.5, |i, j| {
        (i + j) & 1 == 0
    })
}

/// Coarse threads of uneven width, one over, one under.
pub(super) fn coarse(appearance: &Appearance, size: usize) -> Surface {
    woven(appearance, size, appearance.even(22.0), 1.0, |i, j| {
        (i + j) & 1 == 0
    })
}

/// Two over, two under, a thread further each time.
pub(super) fn twill(appearance: &Appearance, size: usize) -> Surface {
    woven(
        appearance,
        size,
        appearance.multiple(36.0, 4),
        0.6,
        |i, j| (i + j).rem_euclid(4) < 2,
    )
}

/// Two over, one under: the diagonal of denim, with light weft in dark warp, and a double seam.
pub(super) fn denim(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.multiple(63.0, 3);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let slack = 0.12 / n as f32;
        let (a, b) = (
            u + slack * gradient(u, v, n, 6, seed),
            v + slack * gradient(u, v, 6, n, seed + 1),
        );
        let (x, y) = (a * n as f32, b * n as f32);
        let i = floor(x);
        let across = 2.0 * fract(x) - 1.0;
        let slub = 0.30 * gradient(u, v, n, 3, seed + 2);
        let worn = octaves(u, v, 3, 3, 4, seed + 3);
        // Each warp thread goes under a weft further down than its neighbour.
        let phase = fract((y + i as f32 + 0.3 * across) / 3.0);
        let under = step(0.58, 0.70, phase) * step(1.0, 0.90, phase);
        let fibre = gradient(u, v, n * 3, n / 2, seed + 4);
        let id = unit(hash(i.rem_euclid(n), 5, seed));
        let fade = 1.0 + 0.30 * worn;
        let warp = lit(
            appearance.color(0),
            (0.78 + 0.45 * id + slub + 0.16 * fibre) * fade,
        );
        let pale = unit(hash(i.rem_euclid(n), floor(y / 3.0), seed + 6));
        let cloth = mix(
            warp,
            appearance.color(1),
            under * (0.22 + 0.42 * pale + 0.25 * worn).clamp(0.0, 0.8),
        );
        let round = dome(across * 0.95);
        let mut height = (0.34 * round * (1.0 - 0.6 * under) + 0.06 * fibre) / n as f32;
        let mut color = lit(cloth, 0.68 + 0.32 * round);
        // The seam: a lap of cloth, worn pale at its edge, and two rows of thread.
        let far = (u - 0.5).abs();
        let lap = step(0.115, 0.10, far);
        height += 0.010 * lap;
        color = lit(color, 1.0 + 0.30 * step(0.014, 0.0, (far - 0.102).abs()));
        let stitch = fract(v * 9.0);
        let row = dome(((far - 0.060) / 0.011).abs().min(1.0))
            * step(0.06, 0.14, stitch)
            * step(0.90, 0.82, stitch);
        if row > 0.0 {
            let twist = 0.85 + 0.15 * wave(v * 130.0 + u * 60.0);
            color = mix(
                color,
                lit(appearance.color(2), twist * (0.5 + 0.5 * row)),
                step(0.05, 0.4, row),
            );
            height += 0.010 * row;
        }
        Texel {
            height,
            color,
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

fn woven(appearance: &Appearance, size: usize, n: i32, uneven: f32, over: Weave) -> Surface {
    let seed = appearance.seed;
    let shine = appearance.shine(0.05);
    Surface::of(size, |u, v| {
        let slack = 0.28 * uneven / n as f32;
        let a = u + slack * gradient(u, v, n / 2, n, seed);
        let b = v + slack * gradient(u, v, n, n / 2, seed + 1);
        let (x, y) = (a * n as f32, b * n as f32);
        let (i, j) = (floor(x), floor(y));
        let (fx, fy) = (2.0 * fract(x) - 1.0, 2.0 * fract(y) - 1.0);
        let id = |k: i32, way: u32| unit(hash(k.rem_euclid(n), 4, seed + way));
        let warp_up = over(i.rem_euclid(n), j.rem_euclid(n));
        let (wide_x, wide_y) = (
            0.92 - 0.3 * uneven * id(i, 1),
            0.92 - 0.3 * uneven * id(j, 2),
        );
        let (across, along, width, thread, part) = if warp_up {
            (fx, fy, wide_x, id(i, 1), 0)
        } else {
            (fy, fx, wide_y, id(j, 2), 1)
        };
        let round = dome((across / width).abs().min(1.0));
        let bulge = 0.55 + 0.45 * dome(along * 0.9);
        let twist = if warp_up {
            gradient(u, v, n * 4, n, seed + 3)
        } else {
            gradient(u, v, n, n * 4, seed + 4)
        };
        let gap = step(0.0, 0.30, round);
        let tone = (0.82 + 0.32 * thread + 0.14 * twist) * lerp(0.30, 1.0, gap);
        Texel {
            height: (0.42 * round * bulge + 0.05 * twist) / n as f32,
            color: lit(appearance.color(part), tone),
            gloss: shine * gap,
            glow: 0.0,
        }
    })
}

/// Columns of V-shaped stitches.
pub(super) fn knit(appearance: &Appearance, size: usize) -> Surface {
    let columns = appearance.count(12.0);
    let rows = (columns * 5 + 2) / 4;
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let sway = 0.10 / columns as f32;
        let x = (u + sway * gradient(u, v, 4, rows, seed)) * columns as f32;
        let column = floor(x);
        let f = fract(x);
        let leg = 1.0 - 2.0 * (f - 0.5).abs();
        // Legs rise from the middle of a stitch to its sides.
        let y = v * rows as f32 - 0.85 * (1.0 - leg)
            + sway * 40.0 * gradient(u, v, columns, 4, seed + 1);
        let t = 2.0 * fract(y) - 1.0;
        let side = 2.0 * leg - 1.0;
        let round = dome(t * 0.92) * (0.25 + 0.75 * dome(side * 0.97));
        let ply = 0.5 + 0.5 * wave(1.5 * t + 2.5 * leg * if f < 0.5 { 1.0 } else { -1.0 });
        let fuzz = octaves(u, v, columns * 9, columns * 9, 2, seed + 2);
        let id = unit(hash(
            column.rem_euclid(columns),
            floor(y).rem_euclid(rows),
            seed,
        ));
        let tone =
            (0.92 + 0.12 * id + 0.12 * ply + 0.14 * fuzz) * lerp(0.35, 1.0, step(0.0, 0.55, round));
        Texel {
            height: (0.50 * round + 0.05 * ply * round + 0.04 * fuzz) / columns as f32,
            color: lit(appearance.color(0), tone),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// Raised cords with a pile.
pub(super) fn corduroy(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(13.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let x = (u + 0.05 / n as f32 * gradient(u, v, n, 5, seed)) * n as f32;
        let f = 2.0 * fract(x) - 1.0;
        let cord = dome((f / 0.86).abs().min(1.0));
        let pile = octaves(u, v, n * 6, n * 5, 2, seed + 1);
        let tuft = 0.5 + 0.5 * gradient(u, v, n, n * 5, seed + 3);
        let tone = 0.42 + 0.55 * cord + 0.16 * pile + 0.14 * tuft;
        Texel {
            height: (0.42 * cord + 0.05 * pile + 0.04 * tuft) / n as f32,
            color: lit(appearance.color(0), tone),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// Heights of folds, about −1..1.
fn fold(u: f32, v: f32, n: f32, seed: u32) -> f32 {
    let w = 0.34 * octaves(u, v, 2, 2, 2, seed);
    let main = wave(n * u + v + 1.4 * w);
    let other = wave((n - 1.0).max(1.0) * u - v + 2.2 * w + 0.3);
    0.62 * main + 0.38 * other
}

/// A lustrous cloth in soft folds.
pub(super) fn silk(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(3.0) as f32;
    let seed = appearance.seed;
    let shine = appearance.shine(0.75);
    Surface::of(size, |u, v| {
        let h = fold(u, v, n, seed);
        let ahead = fold(u + 0.012, v + 0.006, n, seed);
        let slope = (ahead - h) * 14.0;
        // Light along the folds' shoulders, as long floats of thread mirror it.
        let band = step(0.10, 0.75, slope) * step(1.9, 0.9, slope);
        let back = step(-0.2, -1.6, slope);
        let thread = gradient(u, v, 12, 180, seed + 3);
        Texel {
            height: 0.034 * h,
            color: lit(appearance.color(0), 0.86 + 0.03 * thread - 0.32 * back),
            gloss: 0.5 * shine,
            glow: 0.72 * shine * band * (0.9 + 0.1 * thread),
        }
    })
}

/// A short dense pile in folds: bright where it is seen from the side, dark from above.
pub(super) fn velvet(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let n = appearance.count(3.0) as f32;
    Surface::of(size, |u, v| {
        let crush = 0.5 * octaves(u, v, 5, 5, 3, seed + 5);
        let h = fold(u, v, n, seed) + 0.55 * crush;
        let right = fold(u + 0.01, v, n, seed);
        let down = fold(u, v + 0.01, n, seed);
        let base = fold(u, v, n, seed);
        let (dx, dy) = ((right - base) * 9.0, (down - base) * 9.0);
        let steep = (dx * dx + dy * dy).sqrt();
        let rim = step(0.55, 2.0, steep) * 0.75 + 0.45 * step(0.25, 0.7, crush.abs());
        let pile = octaves(u, v, 90, 90, 2, seed + 1);
        let color = mix(
            lit(appearance.color(0), 0.75),
            appearance.color(1),
            rim + 0.12 * pile,
        );
        Texel {
            height: 0.020 * h + 0.0012 * pile,
            color: lit(color, 1.0 + 0.28 * pile),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// A smooth thin cloth with a faint weave, lying flat with shallow creases.
pub(super) fn sheet(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(84.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let h = fold(u, v, 2.0, seed);
        let (x, y) = (wave(u * n as f32), wave(v * n as f32));
        let mesh = 0.5 * x * y + 0.25 * (x + y);
        Texel {
            height: 0.020 * h + 0.10 * mesh / n as f32,
            color: lit(
                appearance.color(0),
                0.92 + 0.10 * mesh + 0.05 * octaves(u, v, 30, 30, 2, seed),
            ),
            gloss: appearance.shine(0.1),
            glow: 0.0,
        }
    })
}

/// An open net of thread over a ground.
pub(super) fn net(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(12.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let s = 0.05 / n as f32;
        let (a, b) = (
            u + s * gradient(u, v, n, n, seed),
            v + s * gradient(u, v, n, n, seed + 1),
        );
        let (x, y) = ((a + b) * n as f32, (a - b) * n as f32);
        let (dx, dy) = ((fract(x) - 0.5).abs(), (fract(y) - 0.5).abs());
        let width = 0.12;
        let thread = dome((dx / width).min(1.0)).max(dome((dy / width).min(1.0)));
        let knot = dome(((dx * dx + dy * dy).sqrt() / 0.24).min(1.0));
        let twist = 0.5 + 0.5 * wave(3.0 * (x - y));
        let up = thread.max(1.3 * knot);
        let there = step(0.05, 0.3, up);
        Texel {
            height: (0.30 * up + 0.02 * twist) / n as f32,
            color: mix(
                appearance.color(1),
                lit(appearance.color(0), 0.8 + 0.25 * twist),
                there,
            ),
            gloss: appearance.shine(0.05) * there,
            glow: 0.0,
        }
    })
}

/// Flowers of thread on a fine net.
pub(super) fn lace(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(6.0);
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 0.0, appearance.seed);
        let angle = libm::atan2f(c.way.1, c.way.0) / core::f32::consts::TAU;
        let petal = 0.30 + 0.10 * wave(6.0 * angle);
        let flower = step(petal + 0.02, petal - 0.02, c.near) * step(0.05, 0.07, c.near);
        let vein = step(0.86, 0.95, wave(6.0 * angle + 0.5)) * step(petal, petal - 0.05, c.near);
        let rim = step(0.03, 0.015, (c.near - petal).abs());
        let fine = (n * 6) as f32;
        let (x, y) = ((u + v) * fine, (u - v) * fine);
        let wire =
            step(0.36, 0.42, (fract(x) - 0.5).abs()).max(step(0.36, 0.42, (fract(y) - 0.5).abs()));
        let edge = step(0.445, 0.47, c.near) * step(0.53, 0.505, c.near);
        let there = (0.8 * flower - 0.5 * vein)
            .max(rim)
            .max(0.75 * wire)
            .max(edge);
        Texel {
            height: 0.010 * there,
            color: mix(
                appearance.color(1),
                lit(appearance.color(0), 0.95 + 0.08 * wire),
                there,
            ),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// Flat strips over and under each other: carbon fibre, webbing, straw mats, wicker.
pub(super) fn basket(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.multiple(12.0, 4);
    let seed = appearance.seed;
    let shine = appearance.shine(0.1);
    Surface::of(size, |u, v| {
        let (x, y) = (u * n as f32, v * n as f32);
        let (i, j) = (floor(x), floor(y));
        let (fx, fy) = (2.0 * fract(x) - 1.0, 2.0 * fract(y) - 1.0);
        let twill = shine > 0.5;
        let up = if twill {
            (i + j).rem_euclid(4) < 2
        } else {
            (i + j) & 1 == 0
        };
        let (across, along, strand) = if up { (fx, fy, i) } else { (fy, fx, j) };
        let id = unit(hash(strand, i32::from(up), seed));
        let fibre = if up {
            gradient(u, v, n * 8, n / 2, seed)
        } else {
            gradient(u, v, n / 2, n * 8, seed + 1)
        };
        let edge = step(1.0, 0.86, across.abs());
        let bow = dome(along * 0.86);
        let (part, flash) = if up {
            (0, step(0.55, 1.0, bow))
        } else {
            (1, 0.0)
        };
        let tone = (0.8 + 0.3 * id + 0.20 * fibre) * lerp(0.25, 1.0, edge) * (0.7 + 0.3 * bow);
        Texel {
            height: (0.30 * bow * dome(across * 0.9) + 0.03 * fibre) * edge / n as f32,
            color: lit(appearance.color(part), tone),
            gloss: shine * edge * 0.6,
            glow: if twill {
                0.10 * flash * edge * (1.0 + 0.6 * fibre)
            } else {
                0.0
            },
        }
    })
}

/// Twisted strands side by side: rope, cord, cable, yarn.
pub(super) fn rope(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(4.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.0);
    Surface::of(size, |u, v| {
        let x = u * n as f32;
        let side = 2.0 * fract(x) - 1.0;
        let body = dome(side * 0.98);
        // Strands slant more towards the sides, as on a helix.
        let t = v * (n * 2) as f32
            + 0.62 * side
            + 0.14 * side * side * side
            + 0.3 * unit(hash(floor(x).rem_euclid(n), 1, seed));
        let strand = dome((2.0 * fract(t) - 1.0) * 0.97);
        let fibre = gradient(u + 0.2 * v, v, n * 12, n * 10, seed + 1);
        let yarn = wave(5.0 * t);
        let gap = step(0.0, 0.4, body) * step(0.0, 0.5, strand);
        Texel {
            height: (0.42 * body + 0.20 * strand * body + 0.012 * (yarn + fibre)) / n as f32,
            color: lit(
                mix(
                    appearance.color(0),
                    appearance.color(1),
                    0.5 * (1.0 + fibre) * 0.6,
                ),
                (0.85 + 0.10 * yarn + 0.12 * fibre) * lerp(0.28, 1.0, gap),
            ),
            gloss: shine,
            glow: 0.0,
        }
    })
}
