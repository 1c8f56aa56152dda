//! Loose things in a heap: rice, beans, lentils, sugar, leaves.

use crate::{
    appearance::Appearance,
    color::lit,
    noise::{Sequence, dome, step, wave},
    surface::{Surface, Texel},
};

/// Shape of the objects of a heap.
struct Thing {
    /// Width over length.
    slender: f32,
    /// Height over width.
    tall: f32,
    /// Depth of a groove along the middle, of the height.
    groove: f32,
    gloss: f32,
    /// 2 for an ellipse, more for a box.
    corners: i32,
}

/// Long grains: rice, oats, needles.
pub(super) fn grains(appearance: &Appearance, size: usize) -> Surface {
    heap(
        appearance,
        size,
        appearance.count(13.0),
        &Thing {
            slender: 0.30,
            tall: 0.5,
            groove: 0.0,
            gloss: appearance.shine(0.35),
            corners: 2,
        },
    )
}

/// Flat round grains: lentils, coins, confetti.
pub(super) fn discs(appearance: &Appearance, size: usize) -> Surface {
    heap(
        appearance,
        size,
        appearance.count(12.0),
        &Thing {
            slender: 0.95,
            tall: 0.28,
            groove: 0.0,
            gloss: appearance.shine(0.3),
            corners: 2,
        },
    )
}

/// Beans with a groove: coffee.
pub(super) fn beans(appearance: &Appearance, size: usize) -> Surface {
    heap(
        appearance,
        size,
        appearance.count(8.0),
        &Thing {
            slender: 0.68,
            tall: 0.42,
            groove: 0.55,
            gloss: appearance.shine(0.45),
            corners: 2,
        },
    )
}

/// Balls: glass beads, peas.
pub(super) fn balls(appearance: &Appearance, size: usize) -> Surface {
    heap(
        appearance,
        size,
        appearance.count(11.0),
        &Thing {
            slender: 1.0,
            tall: 0.5,
            groove: 0.0,
            gloss: appearance.shine(0.9),
            corners: 2,
        },
    )
}

/// Cubes: sugar, salt.
pub(super) fn crystals(appearance: &Appearance, size: usize) -> Surface {
    heap(
        appearance,
        size,
        appearance.count(26.0),
        &Thing {
            slender: 0.85,
            tall: 0.5,
            groove: 0.0,
            gloss: appearance.shine(0.6),
            corners: 8,
        },
    )
}

fn heap(appearance: &Appearance, size: usize, n: i32, thing: &Thing) -> Surface {
    let mut surface = Surface::of(size, |_, _| Texel {
        height: 0.0,
        color: lit(appearance.color(0), 0.18),
        gloss: 0.0,
        glow: 0.0,
    });
    let mut chance = Sequence::new(appearance.seed);
    let length = 0.62 / n as f32;
    let count = (2.6 * (n * n) as f32 / thing.slender.max(0.4)) as usize;
    for k in 0..count {
        let place = (chance.next(), chance.next());
        let turn = chance.next();
        let scale = 0.85 + 0.3 * chance.next();
        let (long, wide) = (length * scale, length * scale * thing.slender);
        let color = lit(appearance.any(chance.next()), 0.78 + 0.4 * chance.next());
        let (c, s) = (wave(turn + 0.25), wave(turn));
        let level = 1.4 * wide * k as f32 / count as f32;
        let tilt = 0.35 * chance.signed();
        let split = chance.next() < 0.6;
        let box_like = thing.corners > 2;
        let glint = if box_like {
            step(0.7, 1.0, chance.next()) * 0.7
        } else {
            0.0
        };
        surface.stamp(place, long * 1.3, |dx, dy| {
            let (a, b) = ((dx * c + dy * s) / long, (dy * c - dx * s) / wide);
            let d = if box_like {
                a.abs().max(b.abs())
            } else {
                (a * a + b * b).sqrt()
            };
            if d >= 1.0 {
                return None;
            }
            let round = if box_like {
                (1.6 * (1.0 - d)).min(0.5) + tilt * a
            } else {
                dome(d)
            };
            let bend = b + 0.25 * wave(0.35 * a);
            let groove = if split {
                thing.groove * step(0.22, 0.04, bend.abs())
            } else {
                0.0
            };
            let spot = ((a * c - b * s + 0.34) * (a * c - b * s + 0.34)
                + (a * s + b * c + 0.36) * (a * s + b * c + 0.36))
                .sqrt();
            let lamp = if box_like {
                glint
            } else {
                step(0.34, 0.12, spot) * thing.gloss
            };
            Some(Texel {
                height: level
                    + wide * 2.0 * thing.tall * round * (1.0 - 0.5 * groove)
                    + tilt * a * 0.3 * wide,
                color: lit(color, (0.55 + 0.5 * round) * (1.0 - 0.75 * groove)),
                gloss: 0.4 * thing.gloss,
                glow: 0.6 * lamp,
            })
        });
    }
    surface
}
