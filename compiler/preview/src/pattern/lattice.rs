//! Wires, holes and studs in regular order.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{cell, dome, floor, fract, hash, lerp, octaves, step, unit, wave},
    surface::{Surface, Texel},
};

/// Wires woven over and under each other with open holes.
pub(super) fn mesh(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(12.0);
    let shine = appearance.shine(0.6);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let (x, y) = (u * n as f32, v * n as f32);
        let (i, j) = (floor(x), floor(y));
        let (a, b) = (2.0 * fract(x) - 1.0, 2.0 * fract(y) - 1.0);
        let radius = 0.34;
        let up = if (i + j) & 1 == 0 { 1.0 } else { -1.0 };
        // Each wire rises over one crossing and dives under the next.
        let wire = |across: f32, along: f32, sign: f32| {
            let round = dome((across / radius).abs().min(1.0));
            let lift = 0.5 * sign * wave(0.25 * (along + 1.0));
            (
                round,
                if round > 0.0 {
                    round * 0.34 + lift
                } else {
                    f32::MIN
                },
            )
        };
        let (one, other) = (wire(a, b, up), wire(b, a, -up));
        let ((round, level), across) = if one.1 > other.1 {
            (one, a)
        } else {
            (other, b)
        };
        let there = step(0.0, 0.25, round);
        let tone = 0.35 + 0.75 * round;
        let fine = octaves(u, v, 40, 40, 2, seed);
        Texel {
            height: if round > 0.0 {
                (0.30 * level + 0.2) / n as f32
            } else {
                -0.25 / n as f32
            },
            color: mix(
                appearance.color(1),
                lit(appearance.color(0), tone + 0.05 * fine),
                there,
            ),
            gloss: shine * there,
            glow: 0.45 * shine * step(0.24, 0.05, (across / radius + 0.32).abs()) * there,
        }
    })
}

/// Round holes in a sheet, in a triangular order.
pub(super) fn holes(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(10.0);
    let rows = ((n * 8 + 3) / 7).max(2) / 2 * 2;
    let seed = appearance.seed;
    let shine = appearance.shine(0.5);
    Surface::of(size, |u, v| {
        let d = triangular(u, v, n, rows);
        let hole = step(0.34, 0.30, d);
        let rim = step(0.30, 0.36, d) * step(0.46, 0.38, d);
        let brush = octaves(u, v, 4, 120, 2, seed);
        let sheet = lit(
            appearance.color(0),
            0.80 + 0.14 * brush + 0.12 * wave(u + v + unit(seed)),
        );
        Texel {
            height: (-0.30 * hole + 0.06 * rim) / n as f32 * 2.0,
            color: mix(sheet, appearance.color(1), hole),
            gloss: shine * (1.0 - hole),
            glow: 0.12 * rim * shine,
        }
    })
}

/// Distance to the nearest point of a triangular lattice, columns.
fn triangular(u: f32, v: f32, n: i32, rows: i32) -> f32 {
    let aspect = n as f32 / rows as f32;
    let y = v * rows as f32;
    let mut best = f32::MAX;
    for row in floor(y - 0.5)..=floor(y - 0.5) + 1 {
        let x = u * n as f32 + 0.5 * (row & 1) as f32;
        let dx = fract(x) - 0.5;
        let dy = (y - row as f32 - 0.5) * aspect;
        best = best.min(dx * dx + dy * dy);
    }
    best.sqrt()
}

/// Wire in six-sided holes, or walls of a comb.
pub(super) fn hexagons(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(8.0);
    let rows = ((n * 8 + 3) / 7).max(2) / 2 * 2;
    let shine = appearance.shine(0.3);
    Surface::of(size, |u, v| {
        // The distance to the border of the nearest point's cell.
        let aspect = n as f32 / rows as f32;
        let y = v * rows as f32;
        let mut near = [(f32::MAX, 0.0, 0.0); 2];
        for row in floor(y) - 1..=floor(y) + 1 {
            let x = u * n as f32 + 0.5 * (row & 1) as f32;
            for column in floor(x) - 1..=floor(x) + 1 {
                let (dx, dy) = (x - column as f32 - 0.5, (y - row as f32 - 0.5) * aspect);
                let d = dx * dx + dy * dy;
                if d < near[0].0 {
                    near[1] = near[0];
                    near[0] = (d, dx, dy);
                } else if d < near[1].0 {
                    near[1] = (d, dx, dy);
                }
            }
        }
        let (px, py) = (near[0].1 - near[1].1, near[0].2 - near[1].2);
        let edge = (near[1].0 - near[0].0) / (2.0 * (px * px + py * py).sqrt().max(1e-6));
        let wall = dome((edge / 0.11).min(1.0));
        let there = step(0.0, 0.4, wall);
        let depth = step(0.0, 0.5, near[0].0.sqrt());
        Texel {
            height: (0.28 * wall + 0.2 * depth) / n as f32,
            color: mix(
                lit(appearance.color(1), 0.6 + 0.5 * depth),
                lit(appearance.color(0), 0.55 + 0.5 * wall),
                there,
            ),
            gloss: shine * there,
            glow: 0.25 * shine * step(0.85, 1.0, wall),
        }
    })
}

/// A sheet slit and pulled: long lozenges.
pub(super) fn lozenges(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(7.0);
    let shine = appearance.shine(0.4);
    Surface::of(size, |u, v| {
        let (x, y) = (u * n as f32, v * (2 * n) as f32);
        let (a, b) = (fract(x + 0.5 * y), fract(0.5 * y - x));
        let d = (0.5 - (a - 0.5).abs()).min(0.5 - (b - 0.5).abs());
        let strand = step(0.17, 0.13, d);
        let slope = if (0.5 - (a - 0.5).abs()) < (0.5 - (b - 0.5).abs()) {
            a
        } else {
            b
        };
        Texel {
            height: 0.22 * strand * (0.7 + 0.3 * wave(slope)) / n as f32,
            color: mix(
                appearance.color(1),
                lit(appearance.color(0), 0.85 + 0.2 * wave(slope + 0.1)),
                strand,
            ),
            gloss: shine * strand,
            glow: 0.12 * strand * shine,
        }
    })
}

/// Rings through each other.
pub(super) fn rings(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(8.0);
    let shine = appearance.shine(0.7);
    let mut surface = Surface::of(size, |_, _| Texel {
        height: -0.4 / n as f32,
        color: appearance.color(1),
        gloss: 0.0,
        glow: 0.0,
    });
    let pitch = 1.0 / n as f32;
    let (radius, wire) = (0.62 * pitch, 0.145 * pitch);
    for row in 0..n {
        for column in 0..n {
            let (u, v) = ((column as f32 + 0.5) * pitch, (row as f32 + 0.5) * pitch);
            // Rows lean in turn, so that rings pass through their neighbours.
            let lean = if row & 1 == 0 { 1.0 } else { -1.0 };
            let tone = 0.8 + 0.3 * unit(hash(column, row, appearance.seed));
            surface.stamp((u, v), radius + wire, |dx, dy| {
                let dx = dx / 0.92;
                let d = (dx * dx + dy * dy).sqrt();
                let t = (d - radius) / wire;
                (t.abs() < 1.0).then(|| {
                    let round = dome(t);
                    Texel {
                        height: 0.8 * wire * round + 0.5 * lean * dx,
                        color: lit(appearance.color(0), tone * (0.35 + 0.7 * round)),
                        gloss: shine,
                        glow: 0.5 * shine * step(0.4, 0.0, (t + 0.3).abs()),
                    }
                })
            });
        }
    }
    surface
}

/// Round studs with flat tops.
pub(super) fn studs(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(7.0);
    let shine = appearance.shine(0.2);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let (a, b) = (
            2.0 * fract(u * n as f32) - 1.0,
            2.0 * fract(v * n as f32) - 1.0,
        );
        let d = (a * a + b * b).sqrt();
        let stud = step(0.66, 0.54, d);
        let skirt = step(0.80, 0.66, d);
        let fine = octaves(u, v, 70, 70, 2, seed);
        let facing = (-a - b) / d.max(0.01);
        let lip = step(0.08, 0.0, (d - 0.56).abs()) * step(0.2, 1.3, facing);
        Texel {
            height: 0.16 * stud / n as f32 + 0.0006 * fine,
            color: lit(
                appearance.color(0),
                0.9 + 0.12 * stud - 0.25 * (skirt - stud).max(0.0) + 0.10 * fine,
            ),
            gloss: shine,
            glow: (0.15 + 0.5 * shine) * lip,
        }
    })
}

/// Round domes: bubbles, beads, pearls.
pub(super) fn domes(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(8.0);
    let rows = ((n * 8 + 3) / 7).max(2) / 2 * 2;
    let shine = appearance.shine(0.9);
    Surface::of(size, |u, v| {
        let d = triangular(u, v, n, rows) / 0.46;
        let dome_height = dome(d.min(1.0));
        let rim = step(0.14, 0.0, (d - 0.95).abs());
        // Where on the dome: the light stands at the upper left.
        let spot = {
            let e = triangular(u + 0.17 / n as f32, v + 0.17 / n as f32, n, rows) / 0.46;
            step(0.30, 0.12, e)
        };
        Texel {
            height: 0.36 * dome_height / n as f32,
            color: mix(
                appearance.color(1),
                lit(appearance.color(0), 0.78 + 0.3 * dome_height - 0.16 * rim),
                step(1.03, 0.97, d),
            ),
            gloss: shine,
            glow: 0.8 * shine * spot,
        }
    })
}

/// Shallow round hollows in a triangular order, as on golf balls and orange skins.
pub(super) fn dimples(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(8.0);
    let rows = ((n * 8 + 3) / 7).max(2) / 2 * 2;
    Surface::of(size, |u, v| {
        let d = triangular(u, v, n, rows) / 0.42;
        let bowl = if d < 1.0 { dome(d) } else { 0.0 };
        Texel {
            height: -0.17 * bowl / n as f32,
            color: lit(appearance.color(0), 1.0 - 0.06 * bowl),
            gloss: appearance.shine(0.5),
            glow: 0.0,
        }
    })
}

/// Raised blocks with sloping sides: chocolate, waffles (where the blocks are hollows), keys.
pub(super) fn blocks(appearance: &Appearance, size: usize) -> Surface {
    panels(appearance, size, 1.0)
}

/// Hollow squares between ridges.
pub(super) fn pits(appearance: &Appearance, size: usize) -> Surface {
    panels(appearance, size, -1.0)
}

fn panels(appearance: &Appearance, size: usize, sign: f32) -> Surface {
    let n = appearance.count(5.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.4);
    Surface::of(size, |u, v| {
        let (a, b) = (
            (2.0 * fract(u * n as f32) - 1.0).abs(),
            (2.0 * fract(v * n as f32) - 1.0).abs(),
        );
        let d = a.max(b);
        let block = step(0.97, 0.66, d);
        let rough = octaves(u, v, 18, 18, 4, seed);
        let low = if sign > 0.0 { 1.0 - block } else { block };
        Texel {
            height: sign * 0.20 * block / n as f32 + 0.003 * (1.0 - shine) * rough,
            color: lit(
                mix(appearance.color(0), appearance.color(1), low),
                (1.0 + 0.18 * (1.0 - shine) * rough) * lerp(1.0, 0.82, low),
            ),
            gloss: shine,
            glow: 0.0,
        }
    })
}

/// A tread of blocks and grooves.
pub(super) fn tread(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(6.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let fold = (2.0 * fract(u * (n / 2) as f32) - 1.0).abs();
        let (x, y) = (u * n as f32, v * n as f32 + 0.9 * fold);
        let (a, b) = (fract(x), fract(y));
        let main = step(0.08, 0.14, a.min(1.0 - a));
        let cross = step(0.10, 0.16, b.min(1.0 - b));
        let sipe = step(0.02, 0.035, (b - 0.5).abs()).max(step(0.30, 0.34, (a - 0.5).abs()));
        let block = main * cross;
        let fine = octaves(u, v, 60, 60, 2, seed);
        Texel {
            height: (0.26 * block + 0.06 * sipe * block) / n as f32 + 0.0007 * fine,
            color: lit(
                appearance.color(0),
                (0.35 + 0.65 * block) * (0.75 + 0.25 * sipe) * (1.0 + 0.15 * fine),
            ),
            gloss: appearance.shine(0.15),
            glow: 0.0,
        }
    })
}

/// Grains that mirror, each its own way: glitter, anti-slip tape.
pub(super) fn glitter(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(70.0);
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 1.0, appearance.seed);
        let bright = unit(hash(c.id as i32, 1, 2));
        let hue = unit(hash(c.id as i32, 2, 2));
        let facet = step(0.0, 0.08, c.edge);
        Texel {
            height: 0.2 * facet * bright / n as f32,
            color: lit(
                appearance.any(hue),
                (0.25 + 1.2 * bright * bright) * lerp(0.5, 1.0, facet),
            ),
            gloss: 0.0,
            glow: 0.9 * step(0.92, 0.98, bright) * facet,
        }
    })
}
