//! Stone, earth and what is built of them.

use crate::{
    appearance::Appearance,
    color::{lit, mix},
    noise::{cell, dome, floor, fract, gradient, hash, lerp, nth, octaves, step, unit},
    surface::{Surface, Texel},
};

/// Angular grains glued side by side, some of which glint.
pub(super) fn grit(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(72.0);
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 1.0, appearance.seed);
        let tall = nth(c.id, 1);
        let bare = tall < 0.16;
        let tilt = (nth(c.id, 2) - 0.5) * c.way.0 + (nth(c.id, 3) - 0.5) * c.way.1;
        let height = if bare {
            0.0
        } else {
            (0.35 + 0.65 * tall) * step(0.0, 0.22, c.edge) + 0.9 * tilt
        };
        let color = if bare {
            appearance.color(0)
        } else {
            appearance.any(nth(c.id, 4))
        };
        let glint = step(0.93, 1.0, nth(c.id, 5)) * step(0.1, 0.3, c.edge);
        Texel {
            height: 0.7 * height / n as f32,
            color: lit(color, 0.7 + 0.5 * nth(c.id, 6)),
            gloss: appearance.shine(0.15),
            glow: 0.75 * glint,
        }
    })
}

/// Fine loose grains in ripples.
pub(super) fn sand(appearance: &Appearance, size: usize) -> Surface {
    let (n, ripples) = (appearance.count(130.0), 5.0);
    Surface::of(size, |u, v| {
        let bend = 0.16 * octaves(u, v, 2, 2, 2, appearance.seed)
            + 0.03 * gradient(u, v, 6, 6, appearance.seed + 1);
        let t = fract(ripples * v + u + 5.0 * bend);
        // A long slope against the wind, a short one behind.
        let crest = if t < 0.72 { t / 0.72 } else { (1.0 - t) / 0.28 };
        let crest = crest * crest * (3.0 - 2.0 * crest);
        let c = cell(u, v, n, n, 1.0, appearance.seed + 2);
        let speck = nth(c.id, 1);
        let tone = lerp(0.9, 1.08, crest) * (0.82 + 0.3 * speck);
        let dark = step(0.95, 0.97, nth(c.id, 2));
        Texel {
            height: 0.021 * crest + 0.25 * dome(c.near * 1.4) / n as f32,
            color: lit(mix(appearance.color(0), appearance.color(1), dark), tone),
            gloss: 0.0,
            glow: 0.5 * step(0.985, 1.0, nth(c.id, 3)),
        }
    })
}

/// Rounded stones side by side, of several sizes.
pub(super) fn pebbles(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(11.0);
    let fine = n * 3;
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let warp = 0.10 / n as f32;
        let (a, b) = (
            u + warp * gradient(u, v, n * 3, n * 3, seed + 7),
            v + warp * gradient(u, v, n * 3, n * 3, seed + 8),
        );
        // From 0 in the middle of a stone to 1 at its border, with the corners cut round.
        let inside =
            |c: &crate::noise::Cell| (c.near / (c.near + c.edge.max(1e-4))).max(c.near / 0.62);
        let mut best = (0.0, 0, (0.0, 0.0), 0.0);
        for (scale, tall, salt) in [(fine, 0.30, 1), (n * 2, 0.55, 2), (n, 1.0, 3)] {
            let c = cell(a, b, scale, scale, 0.85, seed + salt);
            let d = inside(&c) * 1.08;
            let height = tall * (0.75 + 0.4 * nth(c.id, 1)) * dome(d.min(1.0)).sqrt();
            if d < 1.0 && nth(c.id, 6) < 0.85 && height > best.0 {
                best = (height, c.id, c.way, dome(d));
            }
        }
        let (height, id, way, round) = best;
        let rough = octaves(u, v, n * 4, n * 4, 3, seed + (id & 7));
        let tone = 0.74 + 0.46 * nth(id, 2) + 0.20 * rough;
        let slant = (nth(id, 3) - 0.5) * way.0 + (nth(id, 5) - 0.5) * way.1;
        Texel {
            height: (0.55 * height + 0.18 * slant + 0.025 * rough) / n as f32,
            color: lit(
                appearance.any(nth(id, 4)),
                tone * lerp(0.18, 1.0, step(0.0, 0.55, round)),
            ),
            gloss: appearance.shine(0.08) * step(0.2, 0.6, round),
            glow: 0.0,
        }
    })
}

/// Crystals of a polished or broken rock.
pub(super) fn granite(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(34.0);
    Surface::of(size, |u, v| {
        let w = 0.012;
        let (a, b) = (
            u + w * gradient(u, v, 24, 24, appearance.seed),
            v + w * gradient(u, v, 24, 24, appearance.seed + 1),
        );
        let big = cell(a, b, n, n, 1.0, appearance.seed + 2);
        let small = cell(a, b, n * 3, n * 3, 1.0, appearance.seed + 3);
        let id = if nth(big.id, 1) < 0.62 {
            big.id
        } else {
            small.id
        };
        let color = appearance.any(nth(id, 2));
        Texel {
            height: 0.04 * nth(id, 3) / n as f32,
            color: lit(color, 0.8 + 0.35 * nth(id, 4)),
            gloss: appearance.shine(0.35),
            glow: 0.0,
        }
    })
}

/// Chips of stone in a smooth ground.
pub(super) fn terrazzo(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(13.0);
    Surface::of(size, |u, v| {
        let mut color = lit(
            appearance.color(0),
            1.0 + 0.08 * octaves(u, v, 30, 30, 2, appearance.seed),
        );
        for (k, scale) in [3, 2, 1].into_iter().enumerate() {
            let c = cell(
                u,
                v,
                n * scale,
                n * scale,
                1.0,
                appearance.seed + 5 * scale as u32,
            );
            if c.edge > 0.07 + 0.12 * nth(c.id, 1) && nth(c.id, 2) < 0.5 {
                let part = 1 + (nth(c.id, 3) * 3.0) as usize;
                color = lit(appearance.color(part), 0.85 + 0.3 * nth(c.id, 4 + k as i32));
            }
        }
        Texel {
            height: 0.0,
            color,
            gloss: appearance.shine(0.4),
            glow: 0.12 * step(0.2, 0.7, octaves(u, v, 2, 2, 2, appearance.seed + 9)),
        }
    })
}

/// White stone with veins.
pub(super) fn marble(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let wx = 0.20 * octaves(u, v, 2, 2, 4, seed) + 0.02 * octaves(u, v, 14, 14, 2, seed + 9);
        let wy =
            0.20 * octaves(u, v, 2, 2, 4, seed + 20) + 0.02 * octaves(u, v, 14, 14, 2, seed + 8);
        let (a, b) = (u + v + wx, v + wy);
        let vein = |nx: i32, ny: i32, sharp: f32, seed: u32| {
            let r = (gradient(a, b, nx, ny, seed)).abs();
            1.0 / (1.0 + (r * sharp) * (r * sharp))
        };
        let bold = vein(2, 1, 42.0, seed + 1) * step(-0.5, 0.2, gradient(u, v, 3, 3, seed + 2));
        let thin = vein(5, 4, 62.0, seed + 3) * step(-0.35, 0.3, gradient(u, v, 4, 4, seed + 4));
        let haze = vein(2, 1, 9.0, seed + 1);
        let cloud = 0.5 + 0.5 * octaves(a, b, 3, 3, 3, seed + 5);
        let base = lit(appearance.color(0), 0.93 + 0.1 * cloud);
        let color = mix(
            base,
            appearance.color(1),
            (0.80 * bold + 0.55 * thin + 0.26 * haze).min(1.0),
        );
        let color = mix(
            color,
            appearance.color(2),
            0.5 * thin * step(0.4, 0.8, cloud),
        );
        Texel {
            height: 0.0,
            color,
            gloss: appearance.shine(0.5),
            glow: 0.1 * step(0.15, 0.6, octaves(u, v, 2, 2, 1, seed + 6)),
        }
    })
}

/// Strata: bedded or cleft stone.
pub(super) fn strata(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(7.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let bend = 0.10 * octaves(u, v, 2, 2, 4, seed) + 0.02 * octaves(u, v, 10, 20, 3, seed + 1);
        let t = n as f32 * (v + bend);
        let layer = floor(t).rem_euclid(n);
        let id = hash(layer, 1, seed);
        let f = fract(t);
        let rough = octaves(u, v, 12, 36, 3, seed + 2 + (id & 3));
        let lip = step(0.0, 0.10, f);
        let color = mix(
            appearance.color(0),
            appearance.color(1),
            unit(id) + 0.5 * rough,
        );
        Texel {
            height: (0.10 * f * (0.4 + nth(id, 2)) + 0.05 * rough) * 0.14,
            color: lit(mix(lit(color, 0.5), color, lip), 0.9 + 0.2 * nth(id, 3)),
            gloss: appearance.shine(0.05),
            glow: 0.0,
        }
    })
}

/// Dried plates with gaps.
pub(super) fn cracks(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(6.0);
    let seed = appearance.seed;
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
            color: mix(
                lit(appearance.color(1), 0.35),
                lit(appearance.color(0), tone * lerp(0.72, 1.0, hair)),
                gap,
            ),
            gloss: appearance.shine(0.0),
            glow: 0.0,
        }
    })
}
