//! Glass, ice, snow and liquids.

use crate::{
    appearance::Appearance,
    color::{Rgb, lit, mix},
    noise::{Sequence, cell, dome, fract, gradient, nth, octaves, step, wave},
    surface::{Surface, Texel, Thread},
};

const WHITE: Rgb = [1.0, 1.0, 1.0];

/// A clear pane that mirrors a window in slanting streaks.
pub(super) fn glass(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let t = fract(u + v);
        let sky = mix(
            appearance.color(0),
            appearance.color(1),
            0.5 + 0.5 * wave(v + 0.10 * gradient(u, v, 2, 2, seed)),
        );
        let streak = |from: f32, to: f32| {
            step(from - 0.006, from + 0.006, t) * step(to + 0.006, to - 0.006, t)
        };
        let light =
            0.50 * streak(0.18, 0.34) + 0.32 * streak(0.38, 0.43) + 0.16 * streak(0.70, 0.84);
        Texel {
            height: 0.0,
            color: sky,
            gloss: 0.0,
            glow: light + 0.05 * octaves(u, v, 3, 3, 2, seed + 1),
        }
    })
}

/// Ground or hammered glass: light broken by bumps.
pub(super) fn bumpy_glass(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(12.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let c = cell(u, v, n, n, 0.9, seed);
        let lens = 1.0 - (c.near * 1.3).min(1.0);
        let caustic = step(0.10, 0.0, c.edge);
        let side = (c.way.0 + c.way.1) * 1.2;
        let sky = 0.5 + 0.5 * wave(v + 0.5 * c.way.1 / n as f32 * 4.0);
        Texel {
            height: 0.25 * lens / n as f32,
            color: lit(
                mix(appearance.color(0), appearance.color(1), sky),
                0.85 + 0.25 * side,
            ),
            gloss: appearance.shine(0.7),
            glow: 0.35 * caustic * step(-0.2, 0.5, side)
                + 0.30
                    * step(
                        0.20,
                        0.06,
                        ((c.way.0 + 0.2) * (c.way.0 + 0.2) + (c.way.1 + 0.2) * (c.way.1 + 0.2))
                            .sqrt(),
                    ),
        }
    })
}

/// Matt glass: a pale haze with a fine sparkle.
pub(super) fn frosted(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let blur = 0.5 + 0.5 * wave(u + v + 0.15 * octaves(u, v, 2, 2, 2, seed));
        let fine = octaves(u, v, 100, 100, 2, seed + 1);
        let spark = nth(cell(u, v, 120, 120, 1.0, seed + 2).id, 1);
        Texel {
            height: 0.0012 * fine,
            color: mix(appearance.color(0), appearance.color(1), blur),
            gloss: 0.0,
            glow: 0.10 * fine + 0.35 * step(0.95, 1.0, spark) + 0.12 * step(0.6, 1.0, blur),
        }
    })
}

/// Clear ice: cracks in the depth, bubbles, a wet shine.
pub(super) fn ice(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let depth = 0.5 + 0.75 * octaves(u, v, 2, 2, 3, seed);
        let mut color = mix(appearance.color(0), appearance.color(1), depth);
        let mut white = 0.0f32;
        for (k, n) in [3, 5].into_iter().enumerate() {
            let k = k as u32;
            let w = 0.07 * octaves(u, v, 4, 4, 2, seed + 10 + k);
            let c = cell(u + w, v - w, n, n, 1.0, seed + 20 + k);
            let shown = step(-0.12, 0.2, gradient(u, v, 3, 3, seed + 30 + k));
            // A sharp line, and the plane of the crack behind it.
            let line = step(0.014, 0.002, c.edge);
            let plane = step(0.14, 0.0, c.edge) * step(0.0, 0.5, c.way.0 + c.way.1);
            white = white.max(shown * (0.95 * line + 0.40 * plane) * (1.0 - 0.3 * k as f32));
        }
        let bubble = cell(u, v, 16, 16, 1.0, seed + 40);
        let radius = 0.06 + 0.16 * nth(bubble.id, 1);
        let there = f32::from(nth(bubble.id, 2) < 0.35);
        let ring = step(0.05, 0.0, (bubble.near - radius).abs()) * there;
        let cloud = step(0.1, 0.6, octaves(u, v, 5, 5, 3, seed + 41));
        color = mix(color, WHITE, white.max(0.5 * ring).max(0.35 * cloud));
        let swell = octaves(u, v, 3, 3, 2, seed + 42);
        let sheen = step(0.10, 0.5, swell) * step(0.75, 0.55, swell);
        Texel {
            height: 0.014 * swell,
            color,
            gloss: appearance.shine(0.8),
            glow: 0.28 * sheen,
        }
    })
}

/// Feathers of frost.
pub(super) fn frost(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let mut surface = Surface::of(size, |u, v| Texel {
        height: 0.0,
        color: mix(
            appearance.color(0),
            appearance.color(1),
            0.5 + 0.5 * octaves(u, v, 2, 2, 3, seed),
        ),
        gloss: 0.0,
        glow: 0.0,
    });
    let mut chance = Sequence::new(seed);
    for k in 0..34 {
        let start = (chance.next(), chance.next());
        let turn = chance.next();
        let length = 0.20 + 0.20 * chance.next();
        let level = 0.001 * k as f32;
        let draw = |from: (f32, f32), turn: f32, length: f32, width: f32, surface: &mut Surface| {
            let to = (
                from.0 + length * wave(turn + 0.25),
                from.1 + length * wave(turn),
            );
            let pale = mix(appearance.color(1), WHITE, 0.75);
            let thread = Thread {
                width,
                taper: 0.8,
                level,
                rise: 0.0,
                lift: 0.004,
                colors: (WHITE, pale),
                gloss: 0.3,
            };
            surface.thread(&[from, to], &thread);
        };
        draw(start, turn, length, 0.007, &mut surface);
        for j in 1..14 {
            let t = j as f32 / 14.0;
            let at = (
                start.0 + t * length * wave(turn + 0.25),
                start.1 + t * length * wave(turn),
            );
            for side in [-1.0, 1.0] {
                let side_turn = turn + side * 0.155;
                let side_length = 0.42 * length * (1.0 - t) + 0.008;
                draw(at, side_turn, side_length, 0.0045, &mut surface);
            }
        }
    }
    surface
}

/// Fresh snow: drifts with blue shade, crumbs, sparkles.
pub(super) fn snow(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(3.0);
    let seed = appearance.seed;
    let drift = |u: f32, v: f32| {
        let w = 0.06 * octaves(u, v, 3, 3, 2, seed + 5);
        octaves(u + w, v - w, n, n + 1, 2, seed)
    };
    Surface::of(size, |u, v| {
        let mound = drift(u, v);
        // Shade on the side away from the light, as the sky lights it.
        let shade = step(-0.30, 1.50, (drift(u - 0.02, v - 0.02) - mound) * 4.5);
        let crumb = octaves(u, v, 40, 40, 3, seed + 1);
        let c = cell(u, v, 64, 64, 1.0, seed + 2);
        let spark = step(0.94, 0.96, nth(c.id, 1)) * step(0.24, 0.05, c.near);
        Texel {
            height: 0.075 * mound + 0.0050 * crumb,
            color: lit(
                mix(appearance.color(0), appearance.color(1), 0.62 * shade),
                0.90 + 0.06 * crumb,
            ),
            gloss: 0.0,
            glow: 0.95 * spark,
        }
    })
}

/// A still or slow liquid with waves of light.
pub(super) fn liquid(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(4.0);
    let seed = appearance.seed;
    let shine = appearance.shine(0.9);
    Surface::of(size, |u, v| {
        let w = 0.10 * octaves(u, v, 2, 2, 2, seed);
        let h = octaves(u + w, v - w, n, n, 2, seed + 1);
        let ahead = octaves(u + w + 0.01, v - w + 0.01, n, n, 2, seed + 1);
        let slope = (h - ahead) * 30.0;
        Texel {
            height: 0.030 * h,
            color: lit(
                mix(appearance.color(0), appearance.color(1), 0.5 + 0.7 * h),
                0.95,
            ),
            gloss: shine,
            glow: 0.65 * shine * step(0.55, 1.3, slope),
        }
    })
}

/// Drops on a smooth ground.
pub(super) fn drops(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(9.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let shade = 0.92 + 0.12 * wave(u + v + 0.2 * gradient(u, v, 2, 2, seed));
        let mut texel = Texel {
            height: 0.0,
            color: lit(appearance.color(0), shade),
            gloss: 0.3,
            glow: 0.0,
        };
        for scale in [3, 2, 1] {
            let c = cell(u, v, n * scale, n * scale, 0.8, seed + scale as u32);
            let radius = 0.14 + 0.22 * nth(c.id, 1);
            let d = c.near / radius;
            if nth(c.id, 2) < 0.55 && d < 1.0 {
                let top = dome(d);
                // A drop is dark where the light enters and bright where it leaves.
                let through = (c.way.0 + c.way.1) / radius;
                let spot = ((c.way.0 / radius + 0.4) * (c.way.0 / radius + 0.4)
                    + (c.way.1 / radius + 0.4) * (c.way.1 / radius + 0.4))
                    .sqrt();
                texel = Texel {
                    height: 0.06 * top * radius / (n * scale) as f32,
                    color: lit(appearance.color(0), shade * (0.85 + 0.40 * through)),
                    gloss: 0.0,
                    glow: 0.9 * step(0.26, 0.14, spot) + 0.12 * step(0.5, 1.1, through),
                };
            }
        }
        texel
    })
}
