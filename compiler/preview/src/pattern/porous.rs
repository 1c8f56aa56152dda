//! Foams, sponges and crumbs.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{cell, gradient, lerp, nth, octaves, step},
    surface::{Surface, Texel},
};

/// Open pores of many sizes.
pub(super) fn sponge(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(9.0);
    pores(appearance, size, n, 1.0)
}

/// Small even pores.
pub(super) fn foam(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(26.0);
    pores(appearance, size, n, 0.45)
}

fn pores(appearance: &Appearance, size: usize, n: i32, uneven: f32) -> Surface {
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let w = 0.14 / n as f32;
        let (a, b) = (
            u + w * gradient(u, v, n * 2, n * 2, seed),
            v + w * gradient(u, v, n * 2, n * 2, seed + 1),
        );
        let (mut hole, mut deep) = (0.0f32, 0.0f32);
        for (k, scale) in [1, 2, 4].into_iter().enumerate() {
            let c = cell(a, b, n * scale, n * scale, 1.0, seed + 5 * scale as u32);
            let there = nth(c.id, 1) < [0.70 + 0.3 * (1.0 - uneven), 0.55, 0.40][k];
            let radius = 0.20 + 0.24 * uneven * nth(c.id, 2) + 0.10 * (1.0 - uneven);
            if there {
                let inside = step(radius, radius * 0.78, c.near);
                hole = hole.max(inside);
                deep = deep.max(inside * (1.0 - 0.6 * (c.near / radius).min(1.0)) / scale as f32);
            }
        }
        let fine = octaves(u, v, n * 6, n * 6, 2, seed + 3);
        let wall = lit(appearance.color(0), 0.95 + 0.10 * fine);
        Texel {
            height: (-0.30 * deep - 0.10 * hole + 0.02 * fine) / n as f32,
            color: mix(
                wall,
                lit(
                    appearance.color(1),
                    lerp(1.0, 0.35 + 0.35 * (1.0 - uneven), (deep * 1.5).min(1.0)),
                ),
                hole,
            ),
            gloss: appearance.shine(0.0) * (1.0 - hole),
            glow: 0.0,
        }
    })
}

/// Beads of foam pressed into a block.
pub(super) fn beads(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(13.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 0.7, seed);
        let t = (c.edge / 0.42).min(1.0);
        let pillow = (t * (2.0 - t)).max(0.0).sqrt();
        let seam = step(0.0, 0.07, c.edge);
        let fine = cell(u, v, n * 6, n * 6, 1.0, seed + 1);
        let skin = step(0.0, 0.2, fine.edge);
        Texel {
            height: (0.24 * pillow * (0.8 + 0.35 * nth(c.id, 1)) + 0.006 * skin) / n as f32,
            color: lit(
                appearance.color(0),
                (0.97 + 0.06 * nth(c.id, 2)) * lerp(0.80, 1.0, seam) * lerp(0.97, 1.0, skin),
            ),
            gloss: appearance.shine(0.15),
            glow: 0.0,
        }
    })
}

/// Waves of pyramids: acoustic foam.
pub(super) fn wedges(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(5.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let a = 2.0 * (0.5 - (crate::noise::fract(u * n as f32) - 0.5).abs());
        let b = 2.0 * (0.5 - (crate::noise::fract(v * n as f32) - 0.5).abs());
        let h = a.min(b);
        let pore = cell(u, v, n * 14, n * 14, 1.0, seed);
        let hole = step(0.45, 0.2, pore.near);
        Texel {
            height: 0.30 * h / n as f32 - 0.0014 * hole,
            color: lit(appearance.color(0), (0.55 + 0.55 * h) * (1.0 - 0.30 * hole)),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// A baked crust: browned, blistered, cracked.
pub(super) fn crust(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(5.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let w = 0.07 * octaves(u, v, 5, 5, 3, seed);
        let c = cell(u + w, v - w, n, n, 1.0, seed + 1);
        let split = step(0.05, 0.015, c.edge) * step(-0.15, 0.25, gradient(u, v, 4, 4, seed + 2));
        let bubble = cell(u, v, n * 5, n * 5, 1.0, seed + 3);
        let blister = step(0.5, 0.1, bubble.near) * nth(bubble.id, 1);
        let brown = octaves(u, v, 4, 4, 4, seed + 4);
        let fine = octaves(u, v, 50, 50, 3, seed + 5);
        let flour = step(0.25, 0.7, octaves(u, v, 7, 7, 4, seed + 6));
        let color = mix(appearance.color(0), appearance.color(1), 0.5 + 1.1 * brown);
        let color = mix(color, appearance.color(2), (0.9 * split).max(0.45 * flour));
        Texel {
            height: 0.008 * blister + 0.004 * fine - 0.018 * split + 0.012 * brown,
            color: lit(color, 1.0 + 0.16 * fine),
            gloss: appearance.shine(0.05),
            glow: 0.0,
        }
    })
}
