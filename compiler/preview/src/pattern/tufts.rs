//! Loops, tufts and bristles, which stand on their ground.

use super::pile::{ground, path};
use crate::{
    appearance::Appearance,
    color::lit,
    noise::{Sequence, dome, gradient, wave},
    surface::{Surface, Texel, Thread},
};

/// Short fibres in tufts: fleece, cotton wool, plush.
pub(super) fn fleece(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.55));
    let mut chance = Sequence::new(appearance.seed);
    let n = appearance.count(19.0);
    for _ in 0..(n * n * 2) {
        let (u, v) = (chance.next(), chance.next());
        let level = 0.016 * chance.next();
        let tone = 0.8 + 0.3 * chance.next();
        let curl = chance.next();
        for j in 0..7 {
            let color = lit(
                appearance.any(chance.next()),
                tone * (0.92 + 0.16 * chance.next()),
            );
            let thread = Thread {
                width: 0.16 / n as f32,
                taper: 0.5,
                level: level + 0.0006 * j as f32,
                rise: -0.004,
                lift: 0.06 / n as f32,
                colors: (color, lit(color, 0.72)),
                gloss: 0.0,
            };
            let turn = curl + j as f32 / 7.0 + 0.05 * chance.signed();
            surface.thread(&path(u, v, turn, 0.35, 0.75 / n as f32, 4), &thread);
        }
    }
    surface
}

/// Dense small loops in every way: towels, with their flat border.
pub(super) fn loops(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.5));
    let mut chance = Sequence::new(appearance.seed);
    let n = appearance.count(30.0);
    let pitch = 1.0 / n as f32;
    for k in 0..(3 * n * n) {
        let (u, v) = (chance.next(), chance.next());
        let color = lit(appearance.any(chance.next()), 0.84 + 0.26 * chance.next());
        let (turn, radius) = (chance.next(), pitch * (0.30 + 0.16 * chance.next()));
        let points: Vec<(f32, f32)> = (0..=7)
            .map(|k| {
                let t = turn + 0.80 * k as f32 / 7.0;
                (u + radius * wave(t + 0.25), v + radius * wave(t))
            })
            .collect();
        let thread = Thread {
            width: 0.34 * pitch,
            taper: 0.0,
            level: 0.25 * pitch * k as f32 / (3 * n * n) as f32,
            rise: 0.0,
            lift: 0.20 * pitch,
            colors: (lit(color, 0.9), color),
            gloss: 0.0,
        };
        surface.thread(&points, &thread);
    }
    bordered(appearance, &mut surface, n);
    surface
}

/// The flat woven band of a towel, between two cords.
fn bordered(appearance: &Appearance, surface: &mut Surface, n: i32) {
    let size = surface.size;
    for (k, texel) in surface.texels.iter_mut().enumerate() {
        let (u, v) = (
            (k % size) as f32 / size as f32,
            (k / size) as f32 / size as f32,
        );
        let far = (v - 0.74).abs();
        if far < 0.10 {
            let rib = wave(v * 90.0) * 0.5 + wave(u * (n * 3) as f32) * 0.35;
            let cord =
                dome(((far - 0.085) / 0.014).abs().min(1.0)).max(dome((far / 0.020).min(1.0)));
            texel.height = 0.05 / n as f32 * rib * (1.0 - cord) + 0.010 * cord - 0.004;
            texel.color = lit(
                appearance.color(2),
                0.90 + 0.08 * rib * (1.0 - cord) + 0.12 * cord,
            );
        }
    }
}

/// Thick rows of loops: loop carpets.
pub(super) fn thick_loops(appearance: &Appearance, size: usize) -> Surface {
    looped(appearance, size, appearance.count(17.0), 0.66)
}

fn looped(appearance: &Appearance, size: usize, n: i32, width: f32) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.34));
    let mut chance = Sequence::new(appearance.seed);
    let pitch = 1.0 / n as f32;
    for row in 0..n {
        let shift = 0.5 * (row & 1) as f32;
        for column in 0..n {
            let u = (column as f32 + shift + 0.28 * chance.signed()) * pitch;
            let v = (row as f32 + 0.5 + 0.28 * chance.signed()) * pitch;
            let tone = 0.84 + 0.3 * chance.next();
            let color = lit(appearance.any(chance.next()), tone);
            let lean = 0.12 * chance.signed();
            let radius = pitch * (0.40 + 0.14 * chance.next());
            // An arch seen from above and in front: up, over, down.
            let points: Vec<(f32, f32)> = (0..=8)
                .map(|k| {
                    let t = 0.40 + lean + 0.70 * k as f32 / 8.0;
                    (u + radius * wave(t + 0.25), v + 1.15 * radius * wave(t))
                })
                .collect();
            let thread = Thread {
                width: width * pitch,
                taper: 0.12,
                level: 0.004 + 0.10 * pitch * chance.next(),
                rise: 0.12 * pitch,
                lift: 0.30 * pitch,
                colors: (lit(color, 0.82), color),
                gloss: 0.0,
            };
            surface.thread(&points, &thread);
        }
    }
    surface
}

/// Cut yarns that stand on end, each a tuft of fibres.
pub(super) fn cut_pile(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(34.0);
    tufts(appearance, size, n, 0.62)
}

fn tufts(appearance: &Appearance, size: usize, n: i32, length: f32) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.3));
    let mut chance = Sequence::new(appearance.seed);
    let pitch = 1.0 / n as f32;
    for row in 0..n {
        for column in 0..n {
            let u = (column as f32 + 0.5 + 0.7 * chance.signed()) * pitch;
            let v = (row as f32 + 0.5 + 0.7 * chance.signed()) * pitch;
            let color = lit(appearance.any(chance.next()), 0.75 + 0.45 * chance.next());
            let level = 0.30 * pitch * chance.next();
            let turn = 0.70 + 0.10 * gradient(u, v, 4, 4, appearance.seed + 1);
            for _ in 0..6 {
                let shade = 0.86 + 0.28 * chance.next();
                let thread = Thread {
                    width: 0.40 * pitch,
                    taper: 0.0,
                    level,
                    rise: 0.22 * pitch,
                    lift: 0.16 * pitch,
                    colors: (lit(color, 0.62 * shade), lit(color, 1.1 * shade)),
                    gloss: 0.0,
                };
                let start = (
                    u + 0.30 * pitch * chance.signed(),
                    v + 0.30 * pitch * chance.signed(),
                );
                let way = path(
                    start.0,
                    start.1,
                    turn + 0.14 * chance.signed(),
                    0.0,
                    length * pitch * (0.6 + 0.5 * chance.next()),
                    2,
                );
                surface.thread(&way, &thread);
            }
        }
    }
    surface
}

/// Stiff bristles seen from their tips.
pub(super) fn bristles(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(1), 0.25));
    let mut chance = Sequence::new(appearance.seed);
    let n = appearance.count(26.0);
    let pitch = 1.0 / n as f32;
    for row in 0..n {
        for column in 0..n {
            let u = (column as f32 + 0.5 * (row & 1) as f32 + 0.18 * chance.signed()) * pitch;
            let v = (row as f32 + 0.5 + 0.18 * chance.signed()) * pitch;
            let (du, dv) = (0.5 + 0.5 * gradient(u, v, 4, 4, appearance.seed), 0.9);
            let color = lit(appearance.color(0), 0.8 + 0.4 * chance.next());
            let reach = pitch * (0.6 + 0.5 * chance.next());
            let thread = Thread {
                width: 0.36 * pitch,
                taper: 0.0,
                level: 0.0,
                rise: 0.8 * pitch,
                lift: 0.10 * pitch,
                colors: (lit(color, 0.22), color),
                gloss: appearance.shine(0.3),
            };
            let tip = (u - reach * du, v - reach * dv);
            surface.thread(&[(u, v), tip], &thread);
            let (radius, top) = (0.19 * pitch, 0.95 * pitch);
            surface.stamp(tip, radius, |dx, dy| {
                let d = (dx * dx + dy * dy).sqrt() / radius;
                (d < 1.0).then(|| Texel {
                    height: top + 0.1 * pitch * (1.0 - d),
                    color: lit(color, 1.25),
                    gloss: 0.3,
                    glow: 0.0,
                })
            });
        }
    }
    surface
}

/// Small leaves and tufts of a cushion.
pub(super) fn moss(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.25));
    let mut chance = Sequence::new(appearance.seed);
    let n = appearance.count(26.0);
    for _ in 0..(n * n) {
        let (u, v) = (chance.next(), chance.next());
        let mound = gradient(u, v, 5, 5, appearance.seed + 3);
        let level = 0.012 + 0.02 * mound + 0.004 * chance.next();
        let color = lit(
            appearance.any(chance.next()),
            (0.75 + 0.35 * mound) * (0.8 + 0.5 * chance.next()),
        );
        let spin = chance.next();
        for j in 0..8 {
            let thread = Thread {
                width: 0.20 / n as f32,
                taper: 0.8,
                level,
                rise: -0.003,
                lift: 0.06 / n as f32,
                colors: (lit(color, 1.3), lit(color, 0.6)),
                gloss: 0.0,
            };
            surface.thread(
                &path(u, v, spin + j as f32 / 8.0, 0.05, 0.85 / n as f32, 2),
                &thread,
            );
        }
    }
    surface
}
