//! Stone, earth and what is built of them.

use crate::{
    color::{lit, mix},
    look::Look,
    noise::{cell, dome, floor, fract, gradient, hash, lerp, nth, octaves, step, unit, wave},
    surface::{Surface, Texel},
};

/// Angular grains glued side by side, some of which glint.
pub(super) fn grit(look: &Look, size: usize) -> Surface {
    let n = look.count(72.0);
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 1.0, look.seed);
        let tall = nth(c.id, 1);
        let bare = tall < 0.16;
        let tilt = (nth(c.id, 2) - 0.5) * c.way.0 + (nth(c.id, 3) - 0.5) * c.way.1;
        let height = if bare { 0.0 } else { (0.35 + 0.65 * tall) * step(0.0, 0.22, c.edge) + 0.9 * tilt };
        let color = if bare { look.color(0) } else { look.any(nth(c.id, 4)) };
        let glint = step(0.93, 1.0, nth(c.id, 5)) * step(0.1, 0.3, c.edge);
        Texel {
            height: 0.7 * height / n as f32,
            color: lit(color, 0.7 + 0.5 * nth(c.id, 6)),
            gloss: look.shine(0.15),
            glow: 0.75 * glint,
        }
    })
}

/// Fine loose grains in ripples.
pub(super) fn sand(look: &Look, size: usize) -> Surface {
    let (n, ripples) = (look.count(130.0), 5.0);
    Surface::of(size, |u, v| {
        let bend = 0.16 * octaves(u, v, 2, 2, 2, look.seed) + 0.03 * gradient(u, v, 6, 6, look.seed + 1);
        let t = fract(ripples * (v + 0.0) + 1.0 * u + 5.0 * bend);
        // A long slope against the wind, a short one behind.
        let crest = if t < 0.72 { t / 0.72 } else { (1.0 - t) / 0.28 };
        let crest = crest * crest * (3.0 - 2.0 * crest);
        let c = cell(u, v, n, n, 1.0, look.seed + 2);
        let speck = nth(c.id, 1);
        let tone = lerp(0.9, 1.08, crest) * (0.82 + 0.3 * speck);
        let dark = step(0.95, 0.97, nth(c.id, 2));
        Texel {
            height: 0.021 * crest + 0.25 * dome(c.near * 1.4) / n as f32,
            color: lit(mix(look.color(0), look.color(1), dark), tone),
            gloss: 0.0,
            glow: 0.5 * step(0.985, 1.0, nth(c.id, 3)),
        }
    })
}

/// Rounded stones side by side, of several sizes.
pub(super) fn pebbles(look: &Look, size: usize) -> Surface {
    let n = look.count(11.0);
    let fine = n * 3;
    Surface::of(size, |u, v| {
        let warp = 0.22 / n as f32;
        let (a, b) = (u + warp * gradient(u, v, n * 2, n * 2, look.seed + 7), v + warp * gradient(u, v, n * 2, n * 2, look.seed + 8));
        let big = cell(a, b, n, n, 0.95, look.seed);
        let small = cell(a, b, fine, fine, 0.9, look.seed + 1);
        let round = |edge: f32| { let t = (edge / 0.34).min(1.0); (t * (2.0 - t)).max(0.0).sqrt() };
        let (one, other) = ((0.75 + 0.35 * nth(big.id, 1)) * round((big.edge - 0.05) * 1.05), 0.3 * round((small.edge - 0.05) * 1.2));
        let shown = nth(big.id, 6) > 0.12;
        let (height, id) = if shown && one > other { (one, big.id) } else { (other, small.id) };
        let rough = octaves(u, v, n * 4, n * 4, 2, look.seed + (id & 7));
        let tone = 0.72 + 0.5 * nth(id, 2) + 0.22 * rough;
        let gap = step(0.0, 0.35, height);
        let glance = nth(id, 3) - 0.5;
        let slanted = height + 0.35 * glance * if shown && one > other { big.way.0 } else { small.way.1 * 0.3 };
        Texel {
            height: (0.62 * slanted + 0.03 * rough) / n as f32,
            color: lit(look.any(nth(id, 4)), tone * lerp(0.25, 1.0, gap)),
            gloss: look.shine(0.08) * gap,
            glow: 0.0,
        }
    })
}

/// Setts or cobbles in courses.
pub(super) fn cobbles(look: &Look, size: usize) -> Surface {
    let n = look.even(6.0);
    Surface::of(size, |u, v| {
        let s = 0.03 * gradient(u, v, n * 2, n * 2, look.seed);
        let (row, column) = ((v + s) * n as f32, (u + s) * n as f32 * 0.999_999);
        let y = floor(row);
        let x = column + 0.5 * (y & 1) as f32;
        let id = hash(floor(x).rem_euclid(n), y.rem_euclid(n), look.seed);
        let (a, b) = (2.0 * fract(x) - 1.0, 2.0 * fract(row) - 1.0);
        let d = (a * a * a * a + b * b * b * b).sqrt().sqrt();
        let top = step(0.98, 0.55, d);
        let rough = octaves(u, v, n * 5, n * 5, 3, look.seed + 3);
        let stone = lit(look.any(unit(id)), 0.75 + 0.45 * nth(id, 1) + 0.25 * rough);
        Texel {
            height: (0.30 * top + 0.03 * rough) / n as f32,
            color: mix(lit(look.color(9), 0.35), stone, step(1.0, 0.86, d)),
            gloss: look.shine(0.1) * top,
            glow: 0.0,
        }
    })
}

/// Crystals of a polished or broken rock.
pub(super) fn granite(look: &Look, size: usize) -> Surface {
    let n = look.count(34.0);
    Surface::of(size, |u, v| {
        let w = 0.012;
        let (a, b) = (u + w * gradient(u, v, 24, 24, look.seed), v + w * gradient(u, v, 24, 24, look.seed + 1));
        let big = cell(a, b, n, n, 1.0, look.seed + 2);
        let small = cell(a, b, n * 3, n * 3, 1.0, look.seed + 3);
        let id = if nth(big.id, 1) < 0.62 { big.id } else { small.id };
        let color = look.any(nth(id, 2));
        Texel {
            height: 0.04 * nth(id, 3) / n as f32,
            color: lit(color, 0.8 + 0.35 * nth(id, 4)),
            gloss: look.shine(0.35),
            glow: 0.0,
        }
    })
}

/// Chips of stone in a smooth ground.
pub(super) fn terrazzo(look: &Look, size: usize) -> Surface {
    let n = look.count(13.0);
    Surface::of(size, |u, v| {
        let mut color = lit(look.color(0), 1.0 + 0.08 * octaves(u, v, 30, 30, 2, look.seed));
        for (k, scale) in [3, 2, 1].into_iter().enumerate() {
            let c = cell(u, v, n * scale, n * scale, 1.0, look.seed + 5 * scale as u32);
            if c.edge > 0.07 + 0.12 * nth(c.id, 1) && nth(c.id, 2) < 0.5 {
                let part = 1 + (nth(c.id, 3) * 3.0) as usize;
                color = lit(look.color(part), 0.85 + 0.3 * nth(c.id, 4 + k as i32));
            }
        }
        Texel { height: 0.0, color, gloss: look.shine(0.4), glow: 0.12 * step(0.2, 0.7, octaves(u, v, 2, 2, 2, look.seed + 9)) }
    })
}

/// White stone with veins.
pub(super) fn marble(look: &Look, size: usize) -> Surface {
    let seed = look.seed;
    Surface::of(size, |u, v| {
        let wx = 0.20 * octaves(u, v, 2, 2, 4, seed) + 0.02 * octaves(u, v, 14, 14, 2, seed + 9);
        let wy = 0.20 * octaves(u, v, 2, 2, 4, seed + 20) + 0.02 * octaves(u, v, 14, 14, 2, seed + 8);
        let (a, b) = (u + v + wx, v - u * 0.0 + wy);
        let vein = |nx: i32, ny: i32, sharp: f32, seed: u32| {
            let r = (gradient(a, b, nx, ny, seed)).abs();
            1.0 / (1.0 + (r * sharp) * (r * sharp))
        };
        let bold = vein(2, 1, 30.0, seed + 1) * step(-0.25, 0.35, gradient(u, v, 3, 3, seed + 2));
        let thin = vein(4, 3, 70.0, seed + 3) * step(0.0, 0.4, gradient(u, v, 4, 4, seed + 4));
        let haze = vein(2, 1, 6.0, seed + 1);
        let cloud = 0.5 + 0.5 * octaves(a, b, 3, 3, 3, seed + 5);
        let base = lit(look.color(0), 0.93 + 0.1 * cloud);
        let color = mix(base, look.color(1), (0.85 * bold + 0.6 * thin + 0.34 * haze).min(1.0));
        let color = mix(color, look.color(2), 0.5 * thin * step(0.4, 0.8, cloud));
        Texel { height: 0.0, color, gloss: look.shine(0.5), glow: 0.1 * step(0.15, 0.6, octaves(u, v, 2, 2, 1, seed + 6)) }
    })
}

/// Grey cast stone with pits, stains and a hair crack.
pub(super) fn concrete(look: &Look, size: usize) -> Surface {
    let n = look.count(20.0);
    let seed = look.seed;
    Surface::of(size, |u, v| {
        let stain = octaves(u, v, 3, 3, 5, seed);
        let grain = octaves(u, v, 60, 60, 3, seed + 1);
        let pit = cell(u, v, n, n, 1.0, seed + 2);
        let radius = 0.02 + 0.20 * nth(pit.id, 1) * nth(pit.id, 2) * nth(pit.id, 5);
        let hole = if nth(pit.id, 3) < 0.75 { step(radius * 1.3, radius * 0.7, pit.near) } else { 0.0 };
        let w = 0.05 * octaves(u, v, 6, 6, 4, seed + 3);
        let crack = cell(u + w, v + w, 2, 2, 0.9, seed + 4);
        let line = step(0.007, 0.002, crack.edge) * step(-0.1, 0.15, gradient(u, v, 2, 2, seed + 5));
        let sand = step(0.9, 0.97, nth(cell(u, v, n * 5, n * 5, 1.0, seed + 6).id, 1));
        let tone = 1.0 + 0.20 * stain + 0.16 * grain - 0.25 * sand;
        Texel {
            height: 0.002 * grain + 0.004 * stain - 0.014 * hole - 0.008 * line,
            color: mix(lit(look.color(0), tone), lit(look.color(1), 0.5), 0.75 * hole.max(0.9 * line)),
            gloss: look.shine(0.0),
            glow: 0.0,
        }
    })
}

/// A wall coat: trowelled or combed, matt.
pub(super) fn plaster(look: &Look, size: usize) -> Surface {
    let seed = look.seed;
    let n = look.count(5.0);
    Surface::of(size, |u, v| {
        let w = 0.10 * octaves(u, v, 3, 3, 2, seed);
        let sweep = cell(u + w, v - w, n, n, 1.0, seed + 1);
        let turn = nth(sweep.id, 1);
        let along = sweep.way.0 * wave(turn) + sweep.way.1 * wave(turn + 0.25);
        let ridge = octaves(along * 0.9 + nth(sweep.id, 2), 0.3, 16, 3, 2, seed + 2);
        let fine = octaves(u, v, 40, 40, 3, seed + 3);
        let lip = step(0.06, 0.0, sweep.edge);
        Texel {
            height: (0.006 * ridge + 0.010 * along * nth(sweep.id, 3) + 0.003 * fine + 0.006 * lip) * 0.9,
            color: lit(look.color(0), 0.97 + 0.05 * fine + 0.03 * ridge),
            gloss: look.shine(0.0),
            glow: 0.0,
        }
    })
}

/// Strata: bedded or cleft stone.
pub(super) fn strata(look: &Look, size: usize) -> Surface {
    let n = look.count(7.0);
    let seed = look.seed;
    Surface::of(size, |u, v| {
        let bend = 0.10 * octaves(u, v, 2, 2, 4, seed) + 0.02 * octaves(u, v, 10, 20, 3, seed + 1);
        let t = n as f32 * (v + bend);
        let layer = floor(t).rem_euclid(n);
        let id = hash(layer, 1, seed);
        let f = fract(t);
        let rough = octaves(u, v, 12, 36, 3, seed + 2 + (id & 3));
        let lip = step(0.0, 0.10, f);
        let color = mix(look.color(0), look.color(1), unit(id) + 0.5 * rough);
        Texel {
            height: (0.10 * f * (0.4 + nth(id, 2)) + 0.05 * rough) * 0.14,
            color: lit(mix(lit(color, 0.5), color, lip), 0.9 + 0.2 * nth(id, 3)),
            gloss: look.shine(0.05),
            glow: 0.0,
        }
    })
}

/// Dried plates with gaps.
pub(super) fn cracks(look: &Look, size: usize) -> Surface {
    let n = look.count(6.0);
    let seed = look.seed;
    Surface::of(size, |u, v| {
        let w = 0.03 * octaves(u, v, 8, 8, 3, seed);
        let plate = cell(u + w, v - w, n, n, 0.95, seed + 1);
        let fine = cell(u - w, v + w, n * 2, n * 2, 1.0, seed + 2);
        let gap = step(0.025, 0.075, plate.edge);
        let hair = step(0.012, 0.05, fine.edge);
        let rough = octaves(u, v, 30, 30, 3, seed + 3);
        // Drying edges curl up.
        let curl = step(0.35, 0.08, plate.edge);
        let tone = 0.85 + 0.25 * nth(plate.id, 1) + 0.12 * rough + 0.12 * curl;
        Texel {
            height: 0.035 * gap + 0.007 * curl * gap + 0.004 * rough + 0.004 * hair,
            color: mix(lit(look.color(1), 0.35), lit(look.color(0), tone * lerp(0.72, 1.0, hair)), gap),
            gloss: look.shine(0.0),
            glow: 0.0,
        }
    })
}

/// Courses of bricks in mortar.
pub(super) fn brick(look: &Look, size: usize) -> Surface {
    let rows = look.even(8.0);
    let columns = (rows / 2).max(1);
    let seed = look.seed;
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
        let hole = if nth(pit.id, 1) < 0.3 { step(0.35, 0.2, pit.near) } else { 0.0 };
        let burnt = step(0.72, 1.0, nth(id, 2));
        let body = mix(look.color(0), look.color(1), nth(id, 1));
        let body = lit(body, (0.82 + 0.35 * nth(id, 3)) * (1.0 + 0.25 * rough) * (1.0 - 0.35 * burnt - 0.3 * hole));
        let joint = lit(look.color(2), 0.9 + 0.25 * rough);
        Texel {
            height: 0.016 * face + 0.004 * rough - 0.005 * hole * face,
            color: mix(joint, body, step(0.3, 0.7, face)),
            gloss: look.shine(0.0),
            glow: 0.0,
        }
    })
}

/// Square tiles in grout; glazed, they mirror a window.
pub(super) fn tile(look: &Look, size: usize) -> Surface {
    let n = look.count(4.0);
    let seed = look.seed;
    let glaze = look.shine(0.8);
    Surface::of(size, |u, v| {
        let (x, y) = (u * n as f32, v * n as f32);
        let id = hash(floor(x).rem_euclid(n), floor(y).rem_euclid(n), seed);
        let (a, b) = (fract(x), fract(y));
        let d = a.min(1.0 - a).min(b.min(1.0 - b));
        let face = step(0.022, 0.034, d);
        let bevel = step(0.03, 0.10, d);
        let t = a + b + 0.1 * (nth(id, 4) - 0.5) + 0.05 * gradient(u, v, n * 2, n * 2, seed);
        let window = step(0.62, 0.66, t) * step(0.92, 0.88, t) + 0.6 * step(0.97, 1.0, t) * step(1.10, 1.06, t);
        let rough = octaves(u, v, 40, 40, 2, seed + 1);
        let body = lit(mix(look.color(0), look.color(1), nth(id, 1) * 0.7), 0.93 + 0.14 * nth(id, 2) + 0.10 * (1.0 - glaze) * rough);
        let joint = lit(look.color(2), 0.85 + 0.15 * rough);
        Texel {
            height: 0.012 * face + 0.010 * bevel * face + 0.003 * (1.0 - glaze) * rough,
            color: mix(joint, body, face),
            gloss: glaze * face,
            glow: 0.30 * glaze * window * bevel,
        }
    })
}

/// Coarse stones in a ground: render, aggregate, asphalt.
pub(super) fn aggregate(look: &Look, size: usize) -> Surface {
    let n = look.count(30.0);
    let seed = look.seed;
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 0.9, seed);
        let radius = 0.30 + 0.25 * nth(c.id, 1);
        let warped = c.near * (1.0 + 0.35 * gradient(u, v, n * 2, n * 2, seed + 1));
        let stone = if nth(c.id, 2) < 0.8 { step(radius, radius * 0.75, warped) } else { 0.0 };
        let rough = octaves(u, v, n * 3, n * 3, 2, seed + 2);
        let body = lit(look.any(nth(c.id, 3)), 0.75 + 0.45 * nth(c.id, 4));
        Texel {
            height: (0.45 * stone * dome((warped / radius).min(1.0)) + 0.08 * rough) / n as f32,
            color: mix(lit(look.color(0), 0.8 + 0.3 * rough), body, stone),
            gloss: look.shine(0.05),
            glow: 0.4 * step(0.96, 1.0, nth(c.id, 5)) * stone,
        }
    })
}
