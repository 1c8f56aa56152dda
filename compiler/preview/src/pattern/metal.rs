//! Metal surfaces: ground, beaten, rolled, rusted.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{cell, dome, floor, fract, gradient, hash, lerp, nth, octaves, step, unit, wave},
    surface::{Surface, Texel, field},
};

/// Bands of light that a curved room throws on metal, −1..1, constant along u where `n` is 0.
fn room(t: f32, seed: u32) -> f32 {
    0.6 * wave(t + unit(seed)) + 0.4 * wave(2.0 * t + 0.3)
}

/// Fine scratches in one way.
pub(super) fn brushed(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let fine = appearance.count(150.0);
    Surface::of(size, |u, v| {
        let scratch = 0.5 * gradient(u, v, 2, fine, seed)
            + 0.35 * gradient(u, v, 5, fine * 2, seed + 1)
            + 0.3 * gradient(u, v, 1, fine / 3, seed + 2);
        let nick = step(0.52, 0.75, gradient(u, v, 9, fine, seed + 3));
        let light = 0.5 + 0.5 * room(u, seed);
        Texel {
            height: 0.0006 * scratch,
            color: lit(
                appearance.color(0),
                0.62 + 0.34 * scratch + 0.52 * light - 0.12 * nick,
            ),
            gloss: 0.0,
            glow: 0.22 * step(0.55, 1.0, light) * (1.0 + 1.3 * scratch),
        }
    })
}

/// A mirror that shows a dim room.
pub(super) fn polished(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let w = 0.10 * octaves(u, v, 2, 2, 2, seed);
        let t = u + v + w;
        let sky = step(-0.15, 0.3, room(t, seed));
        let floor_line = step(0.52, 0.6, fract(t + 0.1)) * step(0.72, 0.66, fract(t + 0.1));
        let scratch = step(0.6, 0.9, gradient(u + v, v, 40, 3, seed + 2));
        Texel {
            height: 0.0,
            color: lit(
                appearance.color(0),
                0.45 + 0.75 * sky - 0.25 * floor_line + 0.05 * scratch,
            ),
            gloss: 0.3,
            glow: 0.45 * step(0.5, 0.95, room(t + 0.03, seed)),
        }
    })
}

/// Round dents side by side.
pub(super) fn hammered(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(9.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 0.75, seed);
        let bowl = (c.near * c.near).min(0.6);
        let rim = step(0.0, 0.10, c.edge);
        // A bowl mirrors the light on the side away from it.
        let face = (c.way.0 * 0.68 + c.way.1 * 0.73) * 1.5;
        let flash = step(0.18, 0.5, face) * rim;
        let dark = step(-0.1, -0.6, face);
        let fine = gradient(u, v, 70, 70, seed + 1);
        Texel {
            height: 0.50 * bowl / n as f32,
            color: lit(
                appearance.color(0),
                (0.85 - 0.35 * dark + 0.06 * fine) * lerp(0.8, 1.0, rim),
            ),
            gloss: appearance.shine(0.6),
            glow: 0.5 * flash,
        }
    })
}

/// Raised lozenges, every other one turned.
pub(super) fn lugs(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(8.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let (x, y) = (u * n as f32, v * n as f32);
        let (i, j) = (floor(x), floor(y));
        let (a, b) = (2.0 * fract(x) - 1.0, 2.0 * fract(y) - 1.0);
        let (s, t) = (0.707 * (a + b), 0.707 * (a - b));
        let (along, across) = if (i + j) & 1 == 0 { (s, t) } else { (t, s) };
        let width = 0.30 * (1.0 - (along / 0.98) * (along / 0.98)).max(0.0);
        let d = if width > 0.0 {
            across.abs() / width
        } else {
            2.0
        };
        let lug = step(1.0, 0.45, d);
        let grind = octaves(u, v, 30, 30, 3, seed);
        let wear = step(0.7, 1.0, lug);
        Texel {
            height: 0.16 * lug / n as f32 + 0.0006 * grind,
            color: lit(appearance.color(0), 0.78 + 0.12 * grind + 0.3 * wear),
            gloss: appearance.shine(0.5),
            glow: 0.08 * wear + 0.06 * room(u + v, seed),
        }
    })
}

/// Small pyramids between crossing grooves.
pub(super) fn knurl(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(14.0);
    Surface::of(size, |u, v| {
        let (x, y) = ((u + v) * n as f32, (u - v) * n as f32);
        let (a, b) = ((2.0 * fract(x) - 1.0).abs(), (2.0 * fract(y) - 1.0).abs());
        let top = 1.0 - a.max(b);
        let flat = top.min(0.75);
        Texel {
            height: 0.55 * flat / n as f32,
            color: lit(appearance.color(0), 0.55 + 0.6 * flat),
            gloss: appearance.shine(0.6),
            glow: 0.35 * step(0.70, 0.75, top),
        }
    })
}

/// Rust that eats into a sheet.
pub(super) fn rust(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let n = appearance.count(4.0);
    Surface::of(size, |u, v| {
        let w = 0.05 * octaves(u, v, 6, 6, 3, seed + 7);
        let patch = octaves(u + w, v - w, n, n, 5, seed);
        let flake = octaves(u, v, 26, 26, 4, seed + 1);
        let deep = step(0.0, 0.35, patch + 0.25 * flake);
        let bare = step(-0.30, -0.46, patch + 0.2 * flake);
        let orange = mix(appearance.color(0), appearance.color(1), 0.5 + 0.9 * flake);
        let color = mix(
            orange,
            lit(appearance.color(2), 0.9 + 0.3 * flake),
            0.85 * deep,
        );
        let streak = 0.10 * gradient(u, v, 60, 4, seed + 2);
        Texel {
            height: 0.010 * flake - 0.012 * deep + 0.006 * bare,
            color: lit(
                mix(color, appearance.color(3), bare),
                0.95 + 0.2 * flake + streak,
            ),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// Cast or blasted metal: fine pits, dull shine.
pub(super) fn cast(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let n = appearance.count(70.0);
    Surface::of(size, |u, v| {
        let pit = cell(u, v, n, n, 1.0, seed);
        let coarse = octaves(u, v, n / 3 + 1, n / 3 + 1, 3, seed + 1);
        let light = room(u + v, seed);
        Texel {
            height: (0.35 * step(0.0, 0.5, pit.near) * (0.4 + 0.6 * nth(pit.id, 1)) + 0.5 * coarse)
                / n as f32,
            color: lit(appearance.color(0), 0.9 + 0.16 * coarse + 0.12 * light),
            gloss: appearance.shine(0.45),
            glow: 0.06 * light.max(0.0),
        }
    })
}

/// Crystals of zinc, each with its own sheen.
pub(super) fn spangle(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(9.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let w = 0.02 * octaves(u, v, 14, 14, 2, seed);
        let c = cell(u + w, v - w, n, n, 1.0, seed + 1);
        let turn = nth(c.id, 1);
        let way = c.way.0 * wave(turn) + c.way.1 * wave(turn + 0.25);
        let feather = gradient(way * 0.5 + turn, 0.5, 40, 1, seed + 2);
        Texel {
            height: 0.0008 * feather,
            color: lit(
                appearance.color(0),
                0.66 + 0.55 * nth(c.id, 2) + 0.14 * feather,
            ),
            gloss: 0.3,
            glow: 0.10 * nth(c.id, 3),
        }
    })
}

/// Thin sheet crumpled and spread: foil, tissue, cellophane.
pub(super) fn crumple(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let n = appearance.count(5.0);
    let shine = appearance.shine(0.1);
    let height = |u: f32, v: f32| {
        let mut sum = 0.0;
        let (mut weight, mut k) = (1.0, n);
        for octave in 0..4 {
            let s = 0.35 / k as f32;
            let a = u + s * gradient(u, v, k, k, seed + octave);
            // Flat facets between sharp creases, as paper cannot stretch.
            let c = cell(a, v, k, k, 1.0, seed + 10 + octave);
            let tilt = (nth(c.id, 1) - 0.5) * c.way.0 + (nth(c.id, 2) - 0.5) * c.way.1;
            sum += weight * (0.9 * c.near.min(0.8) + 1.4 * tilt) / k as f32;
            weight *= 0.62;
            k *= 2;
        }
        sum
    };
    let heights = field(size, height);
    // The slope towards the light, over whole pixels.
    let far = (0.004 * size as f32).round().max(1.0) as usize;
    Surface::of(size, |u, v| {
        let pixel = |c: f32| (c * size as f32) as usize;
        let at = |x: usize, y: usize| heights[y % size * size + x % size];
        let (x, y) = (pixel(u), pixel(v));
        let h = at(x, y);
        let glow = if shine > 0.3 {
            let s = (at(x + far, y + far) - h) * size as f32 / far as f32;
            0.75 * step(0.18, 0.5, s) * step(1.3, 0.7, s) * shine - 0.35 * step(-0.1, -0.8, s)
        } else {
            0.0
        };
        Texel {
            height: 0.42 * h,
            color: lit(
                appearance.color(0),
                0.97 + 0.04 * octaves(u, v, 30, 30, 2, seed),
            ),
            gloss: shine,
            glow,
        }
    })
}

/// Regular grooves or waves across the patch.
pub(super) fn ribs(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(10.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.3);
    Surface::of(size, |u, v| {
        let t = fract(v * n as f32) * 2.0 - 1.0;
        let rib = dome(t * 0.97);
        let fine = octaves(u, v, 30, 60, 2, seed);
        let id = unit(hash(floor(v * n as f32).rem_euclid(n), 1, seed));
        Texel {
            height: 0.36 * rib / n as f32 + 0.0006 * fine,
            color: lit(
                appearance.color(0),
                (0.42 + 0.6 * rib) * (0.95 + 0.08 * id) + 0.06 * fine,
            ),
            gloss: shine,
            glow: 0.55 * shine * step(0.10, 0.0, (t + 0.38).abs() - 0.06),
        }
    })
}

/// Fine grooves side by side, in bands: records.
pub(super) fn grooves(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(48.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let t = fract(v * n as f32 + 0.25 * gradient(u, v, 26, n, seed));
        let band = step(0.78, 0.80, fract(v * 3.0)) * step(0.88, 0.86, fract(v * 3.0));
        let groove = (2.0 * t - 1.0).abs() * (1.0 - band);
        let light = room(u, seed);
        Texel {
            height: 0.20 * groove / n as f32,
            color: lit(appearance.color(0), 0.75 + 0.5 * groove),
            gloss: appearance.shine(0.4),
            glow: (0.16 + 0.10 * groove) * step(0.3, 1.0, light),
        }
    })
}
