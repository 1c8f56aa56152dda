//! Fibres, hairs, blades and loops, drawn one by one.

use crate::{
    color::{Rgb, lit, mix},
    look::Look,
    noise::{Sequence, gradient, wave},
    surface::{Surface, Texel, Thread},
};

/// A ground without relief.
fn ground(size: usize, color: Rgb) -> Surface {
    Surface::of(size, |_, _| Texel { height: 0.0, color, gloss: 0.0, glow: 0.0 })
}

/// The points of a thread from (u, v) that keeps its way, turned by a flow and bent.
fn path(u: f32, v: f32, turn: f32, bend: f32, length: f32, points: usize) -> Vec<(f32, f32)> {
    let mut way = Vec::with_capacity(points + 1);
    let (mut u, mut v, mut turn) = (u, v, turn);
    way.push((u, v));
    let step = length / points as f32;
    for _ in 0..points {
        u += step * wave(turn + 0.25);
        v += step * wave(turn);
        turn += bend / points as f32;
        way.push((u, v));
    }
    way
}

/// What strokes have in common.
struct Strokes {
    count: f32,
    length: f32,
    width: f32,
    taper: f32,
    /// Way of the strokes, turns; 0 to the right, 0.25 down.
    turn: f32,
    /// How far strokes stray from it by chance, turns.
    stray: f32,
    /// How far the flow bends it, turns, and cells of the flow.
    flow: (f32, i32),
    /// How much a stroke bends, turns.
    bend: f32,
    /// Brightness at the root.
    root: f32,
    lift: f32,
    gloss: f32,
}

fn strokes(look: &Look, surface: &mut Surface, s: &Strokes) {
    let scale = look.fineness;
    let mut chance = Sequence::new(look.seed);
    let count = (s.count * scale * scale) as usize;
    let seed = look.seed + 9;
    for k in 0..count {
        let (u, v) = (chance.next(), chance.next());
        let flow = s.flow.0 * gradient(u, v, s.flow.1, s.flow.1, seed);
        let turn = s.turn + flow + s.stray * chance.signed();
        let bend = s.bend * chance.signed();
        let length = s.length * (0.6 + 0.6 * chance.next()) / scale;
        let base = look.any(chance.next());
        let tone = 0.72 + 0.5 * chance.next();
        let level = 0.012 * k as f32 / count as f32;
        let thread = Thread {
            width: s.width * (0.7 + 0.6 * chance.next()) / scale,
            taper: s.taper,
            level,
            rise: 0.006,
            lift: s.lift / scale,
            colors: (lit(base, tone * s.root), lit(base, tone)),
            gloss: s.gloss,
        };
        surface.thread(&path(u, v, turn, bend, length, 5), &thread);
    }
}

/// Blades of grass, which grow upwards and lean.
pub(super) fn grass(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.16));
    strokes(look, &mut surface, &Strokes {
        count: 2300.0, length: 0.15, width: 0.0105, taper: 0.85, turn: 0.75, stray: 0.12,
        flow: (0.07, 4), bend: 0.16, root: 0.22, lift: 0.0035, gloss: 0.12,
    });
    surface
}

/// Long soft fur in locks.
pub(super) fn fur(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.3));
    strokes(look, &mut surface, &Strokes {
        count: 5200.0, length: 0.17, width: 0.0042, taper: 0.6, turn: 0.27, stray: 0.025,
        flow: (0.16, 5), bend: 0.10, root: 0.42, lift: 0.0022, gloss: 0.15,
    });
    surface
}

/// Long hair that lies in one way.
pub(super) fn hair(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.4));
    strokes(look, &mut surface, &Strokes {
        count: 2600.0, length: 0.6, width: 0.0042, taper: 0.3, turn: 0.25, stray: 0.012,
        flow: (0.05, 3), bend: 0.03, root: 0.75, lift: 0.002, gloss: 0.45,
    });
    surface
}

/// Matted fibres without a way.
pub(super) fn felt(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.8));
    let seed = look.seed;
    let n = size as f32;
    strokes(look, &mut surface, &Strokes {
        count: 6500.0, length: 0.09, width: 0.0030, taper: 0.2, turn: 0.0, stray: 0.5,
        flow: (0.0, 3), bend: 0.5, root: 1.0, lift: 0.0011, gloss: 0.0,
    });
    for (k, texel) in surface.texels.iter_mut().enumerate() {
        let (u, v) = ((k % size) as f32 / n, (k / size) as f32 / n);
        // Tones close together: the mat is one colour with soft clouds.
        let cloud = 1.0 + 0.16 * gradient(u, v, 7, 7, seed + 2) + 0.10 * gradient(u, v, 22, 22, seed + 3);
        texel.color = lit(mix(look.color(0), texel.color, 0.55), cloud);
        texel.height += 0.002 * gradient(u, v, 9, 9, seed + 4);
    }
    surface
}

/// Short fibres in tufts: fleece, cotton wool, plush.
pub(super) fn fleece(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.55));
    let mut chance = Sequence::new(look.seed);
    let n = look.count(19.0);
    for k in 0..(n * n * 2) {
        let (u, v) = (chance.next(), chance.next());
        let level = 0.016 * chance.next();
        let tone = 0.8 + 0.3 * chance.next();
        let curl = chance.next();
        for j in 0..7 {
            let color = lit(look.any(chance.next()), tone * (0.92 + 0.16 * chance.next()));
            let thread = Thread {
                width: 0.16 / n as f32, taper: 0.5, level: level + 0.0006 * j as f32, rise: -0.004,
                lift: 0.06 / n as f32, colors: (color, lit(color, 0.72)), gloss: 0.0,
            };
            let turn = curl + j as f32 / 7.0 + 0.05 * chance.signed();
            surface.thread(&path(u, v, turn, 0.35, 0.75 / n as f32, 4), &thread);
        }
        let _ = k;
    }
    surface
}

/// Rows of loops: towels, loop carpets.
pub(super) fn loops(look: &Look, size: usize) -> Surface {
    looped(look, size, look.count(30.0), 0.48)
}

/// Thick rows of loops.
pub(super) fn thick_loops(look: &Look, size: usize) -> Surface {
    looped(look, size, look.count(17.0), 0.66)
}

fn looped(look: &Look, size: usize, n: i32, width: f32) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.34));
    let mut chance = Sequence::new(look.seed);
    let pitch = 1.0 / n as f32;
    for row in 0..n {
        let shift = 0.5 * (row & 1) as f32;
        for column in 0..n {
            let u = (column as f32 + shift + 0.28 * chance.signed()) * pitch;
            let v = (row as f32 + 0.5 + 0.28 * chance.signed()) * pitch;
            let tone = 0.84 + 0.3 * chance.next();
            let color = lit(look.any(chance.next()), tone);
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
                width: width * pitch, taper: 0.12, level: 0.004 + 0.10 * pitch * chance.next(), rise: 0.12 * pitch,
                lift: 0.30 * pitch, colors: (lit(color, 0.82), color), gloss: 0.0,
            };
            surface.thread(&points, &thread);
        }
    }
    surface
}

/// Cut yarns that stand on end, each a tuft of fibres.
pub(super) fn cut_pile(look: &Look, size: usize) -> Surface {
    let n = look.count(34.0);
    tufts(look, size, n, 1.05)
}

/// Long yarns that fall over: shag.
pub(super) fn shag(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.25));
    strokes(look, &mut surface, &Strokes {
        count: 900.0, length: 0.20, width: 0.021, taper: 0.35, turn: 0.3, stray: 0.30,
        flow: (0.35, 4), bend: 0.35, root: 0.5, lift: 0.010, gloss: 0.0,
    });
    surface
}

fn tufts(look: &Look, size: usize, n: i32, length: f32) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.3));
    let mut chance = Sequence::new(look.seed);
    let pitch = 1.0 / n as f32;
    for row in 0..n {
        for column in 0..n {
            let u = (column as f32 + 0.5 + 0.7 * chance.signed()) * pitch;
            let v = (row as f32 + 0.5 + 0.7 * chance.signed()) * pitch;
            let color = lit(look.any(chance.next()), 0.75 + 0.45 * chance.next());
            let level = 0.5 * pitch * chance.next();
            let turn = 0.70 + 0.10 * gradient(u, v, 4, 4, look.seed + 1);
            for _ in 0..6 {
                let shade = 0.86 + 0.28 * chance.next();
                let thread = Thread {
                    width: 0.26 * pitch, taper: 0.1, level, rise: 0.24 * pitch, lift: 0.12 * pitch,
                    colors: (lit(color, 0.55 * shade), lit(color, shade)), gloss: 0.0,
                };
                let start = (u + 0.30 * pitch * chance.signed(), v + 0.30 * pitch * chance.signed());
                let way = path(start.0, start.1, turn + 0.14 * chance.signed(), 0.0, length * pitch * (0.6 + 0.5 * chance.next()), 2);
                surface.thread(&way, &thread);
            }
        }
    }
    surface
}

/// Stiff bristles seen from their tips.
pub(super) fn bristles(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(1), 0.25));
    let mut chance = Sequence::new(look.seed);
    let n = look.count(26.0);
    let pitch = 1.0 / n as f32;
    for row in 0..n {
        for column in 0..n {
            let u = (column as f32 + 0.5 * (row & 1) as f32 + 0.18 * chance.signed()) * pitch;
            let v = (row as f32 + 0.5 + 0.18 * chance.signed()) * pitch;
            let (du, dv) = (0.5 + 0.5 * gradient(u, v, 4, 4, look.seed), 0.9);
            let color = lit(look.color(0), 0.8 + 0.4 * chance.next());
            let reach = pitch * (0.6 + 0.5 * chance.next());
            let thread = Thread {
                width: 0.36 * pitch, taper: 0.0, level: 0.0, rise: 0.8 * pitch, lift: 0.10 * pitch,
                colors: (lit(color, 0.22), color), gloss: look.shine(0.3),
            };
            let tip = (u - reach * du, v - reach * dv);
            surface.thread(&[(u, v), tip], &thread);
            let (radius, top) = (0.19 * pitch, 0.95 * pitch);
            surface.stamp(tip, radius, |dx, dy| {
                let d = (dx * dx + dy * dy).sqrt() / radius;
                (d < 1.0).then(|| Texel { height: top + 0.1 * pitch * (1.0 - d), color: lit(color, 1.25), gloss: 0.3, glow: 0.0 })
            });
        }
    }
    surface
}

/// Stalks thrown over each other.
pub(super) fn straw(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.22));
    strokes(look, &mut surface, &Strokes {
        count: 620.0, length: 0.55, width: 0.013, taper: 0.0, turn: 0.04, stray: 0.16,
        flow: (0.12, 3), bend: 0.02, root: 0.95, lift: 0.006, gloss: look.shine(0.25),
    });
    surface
}

/// Springy coils: scouring pads, steel wool, coir, loofah.
pub(super) fn tangle(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.22));
    let width = 0.28 / look.count(40.0) as f32;
    strokes(look, &mut surface, &Strokes {
        count: 2300.0, length: 0.22, width, taper: 0.0, turn: 0.0, stray: 0.5,
        flow: (0.0, 3), bend: 0.85, root: 0.9, lift: 0.5 * width, gloss: look.shine(0.3),
    });
    surface
}

/// Short hairs on a skin.
pub(super) fn stubble(look: &Look, size: usize) -> Surface {
    let mut surface = super::hide::skin(look, size);
    let mut chance = Sequence::new(look.seed + 1);
    for _ in 0..420 {
        let (u, v) = (chance.next(), chance.next());
        let color = lit(look.color(9), 0.6 + 0.5 * chance.next());
        let thread = Thread { width: 0.005, taper: 0.5, level: 0.02, rise: 0.01, lift: 0.002, colors: (color, color), gloss: 0.1 };
        surface.thread(&path(u, v, 0.2 + 0.08 * chance.signed(), 0.05, 0.02 + 0.02 * chance.next(), 2), &thread);
    }
    surface
}

/// Small leaves and tufts of a cushion.
pub(super) fn moss(look: &Look, size: usize) -> Surface {
    let mut surface = ground(size, lit(look.color(0), 0.25));
    let mut chance = Sequence::new(look.seed);
    let n = look.count(26.0);
    for _ in 0..(n * n) {
        let (u, v) = (chance.next(), chance.next());
        let mound = gradient(u, v, 5, 5, look.seed + 3);
        let level = 0.012 + 0.02 * mound + 0.004 * chance.next();
        let color = lit(look.any(chance.next()), (0.75 + 0.35 * mound) * (0.8 + 0.5 * chance.next()));
        let spin = chance.next();
        for j in 0..8 {
            let thread = Thread {
                width: 0.20 / n as f32, taper: 0.8, level, rise: -0.003, lift: 0.06 / n as f32,
                colors: (lit(color, 1.3), lit(color, 0.6)), gloss: 0.0,
            };
            surface.thread(&path(u, v, spin + j as f32 / 8.0, 0.05, 0.85 / n as f32, 2), &thread);
        }
    }
    surface
}
