//! Sheets: paper, board, print, plastic.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{Sequence, cell, floor, fract, gradient, hash, nth, octaves, step, unit, wave},
    surface::{Surface, Texel, Thread},
};

/// A sheet that was folded twice, with fibres in it.
pub(super) fn paper(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let shine = appearance.shine(0.0);
    let mut surface = Surface::of(size, |u, v| {
        // A crease springs back: a sharp edge that fades into the sheet.
        let fold = |d: f32| {
            let t = (1.0 - d.abs() / 0.24).max(0.0);
            0.022 * t * t * t
        };
        let (a, b) = (
            u - 0.5 + 0.004 * gradient(u, v, 2, 9, seed),
            v - 0.5 + 0.004 * gradient(u, v, 9, 2, seed + 1),
        );
        let crease = step(0.006, 0.001, a.abs()).max(step(0.006, 0.001, b.abs()));
        let cloud = octaves(u, v, 18, 18, 3, seed + 2);
        let tooth = octaves(u, v, 80, 80, 2, seed + 3);
        let wavy = octaves(u, v, 2, 3, 2, seed + 4);
        Texel {
            height: fold(a) - fold(b) * 0.9 + 0.0009 * tooth + 0.020 * wavy,
            color: lit(appearance.color(0), 0.93 + 0.035 * cloud - 0.10 * crease),
            gloss: shine,
            glow: 0.0,
        }
    });
    let mut chance = Sequence::new(seed);
    for _ in 0..120 {
        let start = (chance.next(), chance.next());
        let turn = chance.next();
        let length = 0.012 + 0.02 * chance.next();
        let color = lit(appearance.color(0), 0.80 + 0.10 * chance.next());
        let end = (
            start.0 + length * wave(turn),
            start.1 + length * wave(turn + 0.25),
        );
        let thread = Thread {
            width: 0.002,
            taper: 0.0,
            level: 0.045,
            rise: 0.0,
            lift: 0.0,
            colors: (color, color),
            gloss: 0.0,
        };
        flat(&mut surface, &[start, end], &thread);
    }
    surface
}

/// Draws a thread as a stain that leaves the heights as they were.
fn flat(surface: &mut Surface, points: &[(f32, f32)], thread: &Thread) {
    let mut drawn = surface.clone();
    drawn.thread(points, thread);
    for (texel, new) in surface.texels.iter_mut().zip(&drawn.texels) {
        texel.color = new.color;
    }
}

/// Brown board with the waves of its middle showing through.
pub(super) fn cardboard(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(13.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let flute = wave(u * n as f32);
        let speck = cell(u, v, 44, 60, 1.0, seed);
        let (a, b) = (
            speck.way.0 * wave(nth(speck.id, 1)) + speck.way.1 * wave(nth(speck.id, 1) + 0.25),
            speck.way.0 * wave(nth(speck.id, 1) + 0.25) - speck.way.1 * wave(nth(speck.id, 1)),
        );
        let fleck = if nth(speck.id, 2) < 0.30 {
            step(1.0, 0.5, a.abs() / 0.36 + b.abs() / 0.07)
        } else {
            0.0
        };
        let light = nth(speck.id, 3) < 0.4;
        let cloud = octaves(u, v, 8, 16, 3, seed + 1);
        let tooth = octaves(u, v, 90, 60, 2, seed + 2);
        // Worn ends show the waves themselves.
        let color = lit(
            appearance.color(0),
            0.93 + 0.10 * flute + 0.10 * cloud + 0.07 * tooth,
        );
        let color = mix(
            color,
            lit(appearance.color(0), if light { 1.35 } else { 0.45 }),
            0.6 * fleck,
        );
        Texel {
            height: 0.30 * flute / (n * 6) as f32 + 0.0008 * tooth,
            color,
            gloss: appearance.shine(0.0),
            glow: 0.0,
        }
    })
}

/// Lines of print.
pub(super) fn print(appearance: &Appearance, size: usize) -> Surface {
    let lines = appearance.count(22.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let y = v * lines as f32;
        let line = floor(y).rem_euclid(lines);
        let row = fract(y);
        let column = fract(u * 2.0);
        let inside = step(0.04, 0.05, column) * step(0.96, 0.95, column);
        let block = floor(u * 2.0);
        let last = nth(hash(line, block, seed), 1) < 0.14;
        let written = if last {
            column < 0.3 + 0.4 * unit(hash(line, block, seed + 1))
        } else {
            true
        };
        // Letters are two or three strokes wide; every few a space.
        let letters = 48.0;
        let x = u * letters * 2.0;
        let letter = hash(floor(x), line, seed + 2);
        let space = unit(letter) < 0.17;
        let tall = if nth(letter, 1) < 0.3 { 0.20 } else { 0.36 };
        let f = fract(x);
        let bar = [0.22, 0.5, 0.78]
            .iter()
            .enumerate()
            .any(|(k, &at)| nth(letter, 2 + k as i32) < 0.7 && (f - at).abs() < 0.11);
        let dash = (row - 0.5).abs() < 0.06 && nth(letter, 6) < 0.5 && f > 0.12 && f < 0.88;
        let ink = !space && written && row > tall && row < 0.76 && (bar || dash);
        let dark = if ink { 0.85 * inside } else { 0.0 };
        let cloud = octaves(u, v, 30, 30, 3, seed + 3);
        Texel {
            height: 0.0012 * cloud + 0.008 * octaves(u, v, 2, 3, 2, seed + 4),
            color: mix(
                lit(appearance.color(0), 0.97 + 0.07 * cloud),
                appearance.color(1),
                dark,
            ),
            gloss: appearance.shine(0.0),
            glow: 0.0,
        }
    })
}

/// Moulded plastic: one clean colour, soft waves, a mirrored lamp.
pub(super) fn plastic(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let shine = appearance.shine(0.7);
    Surface::of(size, |u, v| {
        let w = octaves(u, v, 2, 2, 2, seed);
        let t = fract(u + v + 0.10 * w);
        let lamp = step(0.10, 0.14, t) * step(0.34, 0.30, t)
            + 0.5 * step(0.38, 0.40, t) * step(0.45, 0.43, t);
        let shade = 0.5 + 0.5 * wave(u + v + 0.10 * w + 0.52);
        let peel = gradient(u, v, 40, 40, seed + 1);
        Texel {
            height: 0.0003 * peel,
            color: lit(appearance.color(0), 0.80 + 0.26 * shade),
            gloss: 0.4 * shine,
            glow: 0.34 * shine * lamp * (0.6 + 0.4 * shade),
        }
    })
}

/// Moulded with a fine pebbled grain: dashboards, housings, rubber.
pub(super) fn moulded(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(44.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.25);
    Surface::of(size, |u, v| {
        let w = 0.35 / n as f32;
        let c = cell(u + w * gradient(u, v, n, n, seed), v, n, n, 1.0, seed + 1);
        let pebble = step(0.0, 0.30, c.edge);
        let cloud = octaves(u, v, 3, 3, 2, seed + 2);
        Texel {
            height: 0.26 * pebble / n as f32,
            color: lit(
                appearance.color(0),
                (0.80 + 0.20 * pebble) * (1.0 + 0.08 * cloud),
            ),
            gloss: shine,
            glow: 0.0,
        }
    })
}

/// Lines of a print head: layers side by side.
pub(super) fn layers(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(28.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.4);
    Surface::of(size, |u, v| {
        let y = v * n as f32 + 0.10 * gradient(u, v, 5, n, seed);
        let t = 2.0 * fract(y) - 1.0;
        let bead = crate::noise::dome(t * 0.96);
        let id = unit(hash(floor(y).rem_euclid(n), 1, seed));
        Texel {
            height: 0.32 * bead / n as f32,
            color: lit(
                appearance.color(0),
                (0.45 + 0.6 * bead) * (0.94 + 0.12 * id),
            ),
            gloss: shine,
            glow: 0.35 * shine * step(0.30, 0.05, (t + 0.35).abs()),
        }
    })
}
