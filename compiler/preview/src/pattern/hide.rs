//! Hides, skins, scales, leaves and feathers.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{cell, dome, floor, fract, gradient, hash, lerp, nth, octaves, step, unit, wave},
    surface::{Surface, Texel},
};

/// Tanned hide: small rounded pebbles between fine creases, and a few long ones.
pub(super) fn leather(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(30.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.4);
    Surface::of(size, |u, v| {
        let w = 0.018;
        let (a, b) = (
            u + w * octaves(u, v, 8, 8, 2, seed),
            v + w * octaves(u, v, 8, 8, 2, seed + 1),
        );
        let c = cell(a, b, n, n, 1.0, seed + 2);
        let fine = cell(a, b, n * 2, n * 2, 1.0, seed + 3);
        let t = (c.edge / 0.36).min(1.0);
        let pebble = (t * (2.0 - t)).sqrt();
        let small = step(0.0, 0.16, fine.edge);
        let crease = cell(
            a + 0.02 * gradient(u, v, 5, 5, seed + 9),
            b,
            4,
            5,
            1.0,
            seed + 4,
        );
        let line = step(0.03, 0.0, crease.edge) * step(-0.2, 0.3, gradient(u, v, 3, 3, seed + 5));
        let patina = octaves(u, v, 3, 3, 3, seed + 6);
        let top = pebble * (0.7 + 0.3 * small);
        let tone = (0.70 + 0.30 * top) * (1.0 + 0.30 * patina) * (1.0 - 0.25 * line);
        Texel {
            height: (0.17 * pebble * (0.8 + 0.4 * nth(c.id, 1)) + 0.03 * small - 0.22 * line)
                / n as f32,
            color: lit(
                mix(appearance.color(1), appearance.color(0), 0.45 + 0.55 * top),
                tone,
            ),
            gloss: shine * top,
            glow: 0.0,
        }
    })
}

/// Napped hide: soft, with strokes of a hand in it.
pub(super) fn suede(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let w = 0.08 * octaves(u, v, 3, 3, 2, seed);
        let swipe = step(-0.12, 0.12, octaves(u + w, v - w, 3, 4, 2, seed + 1));
        let nap = octaves(u, v, 60, 90, 3, seed + 2);
        Texel {
            height: 0.0018 * nap,
            color: lit(appearance.color(0), 0.80 + 0.22 * swipe + 0.24 * nap),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// Living skin: a net of fine lines, pores.
pub(super) fn skin(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(26.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let w = 0.02 * octaves(u, v, 5, 5, 2, seed);
        let c = cell(u + w, v - w, n, n, 0.85, seed + 1);
        let line = step(0.12, 0.0, c.edge);
        let pore = step(0.10, 0.03, c.near) * f32::from(nth(c.id, 1) < 0.5);
        let flush = octaves(u, v, 3, 3, 3, seed + 2);
        let fine = octaves(u, v, n * 3, n * 3, 2, seed + 3);
        Texel {
            height: (0.10 * dome(c.near * 1.2) - 0.10 * line - 0.10 * pore + 0.02 * fine)
                / n as f32,
            color: lit(
                mix(appearance.color(0), appearance.color(1), 0.45 + 0.6 * flush),
                1.0 - 0.10 * line - 0.18 * pore + 0.05 * fine,
            ),
            gloss: appearance.shine(0.2),
            glow: 0.0,
        }
    })
}

/// The whorls of a palm.
pub(super) fn whorls(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(24.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let bend = 0.30 * octaves(u, v, 2, 2, 2, seed);
        let t = fract((v + bend) * n as f32 * 0.999_9);
        let ridge = dome(2.0 * t - 1.0);
        let crease = cell(u + bend * 0.4, v, 2, 3, 1.0, seed + 3);
        let fold = step(0.035, 0.0, crease.edge);
        Texel {
            height: (0.14 * ridge) / n as f32 - 0.010 * fold,
            color: lit(
                mix(
                    appearance.color(1),
                    appearance.color(0),
                    0.35 + 0.65 * ridge,
                ),
                1.0 - 0.25 * fold + 0.06 * octaves(u, v, 3, 3, 2, seed + 4),
            ),
            gloss: appearance.shine(0.15),
            glow: 0.0,
        }
    })
}

/// Rows of scales, each over the next: snakes, fish, cones, roofs.
pub(super) fn scales(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.even(10.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.4);
    Surface::of(size, |u, v| {
        let rows = n as f32;
        let mut found = (0.0, 0u32, 0.0, 0.0);
        // From the row at hand upwards: of the scales that reach down to here, the highest row's
        // lies on top.
        let y = v * rows;
        for back in 0..3 {
            let row = floor(y) - back;
            let x = u * n as f32 + 0.5 * (row & 1) as f32;
            let a = fract(x) - 0.5;
            let b = y - row as f32;
            let reach = 1.55 * (0.25 - a * a * 0.92).max(0.0).sqrt() * 1.25 + 0.35;
            if b <= reach {
                found = (
                    reach - b,
                    hash(floor(x).rem_euclid(n), row.rem_euclid(n), seed),
                    a,
                    b,
                );
            }
        }
        let (rim, id, a, b) = found;
        let edge = step(0.0, 0.16, rim);
        let keel = step(0.10, 0.0, a.abs()) * step(0.2, 0.8, b);
        let tone = (0.70 + 0.5 * nth(id, 1)) * lerp(0.35, 1.0, edge) * (1.08 - 0.22 * rim);
        Texel {
            height: (0.30 * (1.0 - 0.45 * rim.min(1.5)) * edge + 0.04 * keel) / n as f32,
            color: lit(appearance.any(nth(id, 2)), tone),
            gloss: shine * edge,
            glow: 0.22
                * shine
                * step(0.22, 0.05, (a + 0.14).abs())
                * step(0.2, 0.5, rim)
                * step(0.95, 0.6, rim),
        }
    })
}

/// A leaf: a middle rib, side ribs, a net between.
pub(super) fn leaf(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(6.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.35);
    Surface::of(size, |u, v| {
        let side = (u - 0.5).abs();
        let t = fract(v * n as f32 + side * 3.2 + 0.10 * gradient(u, v, 4, 4, seed));
        let far = (t - 0.5).abs();
        let width = 0.035 * (1.0 - 1.3 * side);
        let rib = step(width, width * 0.3, far / n as f32 * 1.6);
        let middle = step(0.016, 0.008, side);
        let net = cell(u, v, n * 5, n * 5, 1.0, seed + 1);
        let mesh = step(0.08, 0.0, net.edge);
        let bulge = dome((1.0 - 2.0 * far).clamp(0.0, 1.0) - 0.2);
        let color = mix(
            appearance.color(0),
            appearance.color(1),
            (0.9 * middle).max(0.75 * rib).max(0.30 * mesh),
        );
        Texel {
            height: 0.006 * bulge - 0.006 * rib - 0.010 * middle - 0.0012 * mesh,
            color: lit(
                color,
                0.92 + 0.10 * octaves(u, v, 4, 4, 3, seed + 2) + 0.10 * far,
            ),
            gloss: shine,
            glow: 0.0,
        }
    })
}

/// Vanes of a feather: fine barbs that slant from quills.
pub(super) fn feather(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(3.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let x = u * n as f32;
        let id = floor(x).rem_euclid(n);
        let side = 2.0 * fract(x) - 1.0;
        let s = side.abs();
        let t = v * 40.0 + 9.0 * s + 0.5 * gradient(u, v, n * 2, 5, seed);
        let barb = dome(2.0 * fract(t) - 1.0);
        let split = step(
            0.50,
            0.62,
            gradient(
                0.5,
                fract(v + 0.22 * s),
                1,
                9,
                seed + (id as u32) * 3 + u32::from(side > 0.0),
            ),
        );
        let quill = step(0.055, 0.02, s);
        let vane = step(1.0, 0.85, s + 0.25 * split);
        let bands = 0.5 + 0.5 * wave(3.0 * (v + 0.22 * s) + 0.2 * unit(hash(id, 2, seed)));
        let color = mix(
            appearance.color(0),
            appearance.color(1),
            0.55 * step(0.45, 0.8, bands),
        );
        Texel {
            height: (0.10 * (1.0 - s) + 0.008 * barb + 0.05 * quill - 0.02 * split) / n as f32
                * 0.5,
            color: lit(
                mix(
                    lit(
                        color,
                        (0.8 + 0.25 * barb) * lerp(0.45, 1.0, vane) * (1.0 - 0.4 * split),
                    ),
                    appearance.color(2),
                    quill,
                ),
                1.0,
            ),
            gloss: 0.1,
            glow: 0.0,
        }
    })
}

/// Low warts or quill bumps on a skin.
pub(super) fn bumps(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(11.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.3);
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 0.7, seed);
        let radius = 0.20 + 0.18 * nth(c.id, 1);
        let bump = dome((c.near / radius).min(1.0));
        let fine = cell(u, v, n * 4, n * 4, 1.0, seed + 1);
        let net = step(0.0, 0.16, fine.edge);
        Texel {
            height: (0.22 * bump + 0.02 * net) / n as f32,
            color: lit(
                mix(
                    appearance.color(0),
                    appearance.color(1),
                    0.8 * step(0.2, 1.0, bump),
                ),
                (0.86 + 0.14 * net) * (1.0 + 0.10 * octaves(u, v, 4, 4, 2, seed + 2)),
            ),
            gloss: shine,
            glow: 0.0,
        }
    })
}
