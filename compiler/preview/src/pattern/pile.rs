//! Fibres, hairs, blades and loops, drawn one by one.

use crate::{
    appearance::Appearance,
    color::{Rgb, lit, mix},
    noise::{Sequence, gradient, wave},
    surface::{Surface, Texel, Thread},
};

/// A ground without relief.
pub(super) fn ground(size: usize, color: Rgb) -> Surface {
    Surface::of(size, |_, _| Texel {
        height: 0.0,
        color,
        gloss: 0.0,
        glow: 0.0,
    })
}

/// The points of a thread from (u, v) that keeps its way, turned by a flow and bent.
pub(super) fn path(
    u: f32,
    v: f32,
    turn: f32,
    bend: f32,
    length: f32,
    points: usize,
) -> Vec<(f32, f32)> {
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

/// Parameters shared by all strokes of a pattern.
struct Strokes {
    count: f32,
    length: f32,
    width: f32,
    taper: f32,
    /// Way of the strokes, turns; 0 to the right, 0.25 down.
    turn: f32,
    /// Random deviation from it, turns.
    stray: f32,
    /// Deflection by the flow, turns, and cells of the flow.
    flow: (f32, i32),
    /// Largest bend of a stroke, turns.
    bend: f32,
    /// Brightness at the root.
    root: f32,
    lift: f32,
    gloss: f32,
}

fn strokes(appearance: &Appearance, surface: &mut Surface, s: &Strokes) {
    let scale = appearance.fineness;
    let mut chance = Sequence::new(appearance.seed);
    let count = (s.count * scale * scale) as usize;
    let seed = appearance.seed + 9;
    for k in 0..count {
        let (u, v) = (chance.next(), chance.next());
        let flow = s.flow.0 * gradient(u, v, s.flow.1, s.flow.1, seed);
        let turn = s.turn + flow + s.stray * chance.signed();
        let bend = s.bend * chance.signed();
        let length = s.length * (0.6 + 0.6 * chance.next()) / scale;
        let base = appearance.any(chance.next());
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
pub(super) fn grass(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.16));
    strokes(
        appearance,
        &mut surface,
        &Strokes {
            count: 2300.0,
            length: 0.15,
            width: 0.0105,
            taper: 0.85,
            turn: 0.75,
            stray: 0.12,
            flow: (0.07, 4),
            bend: 0.16,
            root: 0.22,
            lift: 0.0035,
            gloss: 0.12,
        },
    );
    surface
}

/// Long soft fur in locks.
pub(super) fn fur(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.3));
    strokes(
        appearance,
        &mut surface,
        &Strokes {
            count: 5200.0,
            length: 0.17,
            width: 0.0042,
            taper: 0.6,
            turn: 0.27,
            stray: 0.025,
            flow: (0.16, 5),
            bend: 0.10,
            root: 0.42,
            lift: 0.0022,
            gloss: 0.15,
        },
    );
    surface
}

/// Long hair that lies in one way.
pub(super) fn hair(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.4));
    strokes(
        appearance,
        &mut surface,
        &Strokes {
            count: 2600.0,
            length: 0.6,
            width: 0.0042,
            taper: 0.3,
            turn: 0.25,
            stray: 0.012,
            flow: (0.05, 3),
            bend: 0.03,
            root: 0.75,
            lift: 0.002,
            gloss: 0.45,
        },
    );
    surface
}

/// Matted fibres without a way.
pub(super) fn felt(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.8));
    let seed = appearance.seed;
    let n = size as f32;
    strokes(
        appearance,
        &mut surface,
        &Strokes {
            count: 5200.0,
            length: 0.13,
            width: 0.0048,
            taper: 0.3,
            turn: 0.0,
            stray: 0.5,
            flow: (0.0, 3),
            bend: 0.55,
            root: 1.0,
            lift: 0.0006,
            gloss: 0.0,
        },
    );
    for (k, texel) in surface.texels.iter_mut().enumerate() {
        let (u, v) = ((k % size) as f32 / n, (k / size) as f32 / n);
        // Tones close together: the mat is one colour with soft clouds.
        let cloud =
            1.0 + 0.16 * gradient(u, v, 7, 7, seed + 2) + 0.10 * gradient(u, v, 22, 22, seed + 3);
        texel.color = lit(mix(appearance.color(0), texel.color, 0.75), cloud);
        // Fibres lie in each other rather than on top.
        texel.height = 0.25 * texel.height + 0.004 * gradient(u, v, 8, 8, seed + 4);
    }
    surface
}

/// Long yarns that fall over: shag.
pub(super) fn shag(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.25));
    strokes(
        appearance,
        &mut surface,
        &Strokes {
            count: 900.0,
            length: 0.20,
            width: 0.021,
            taper: 0.35,
            turn: 0.3,
            stray: 0.30,
            flow: (0.35, 4),
            bend: 0.35,
            root: 0.5,
            lift: 0.010,
            gloss: 0.0,
        },
    );
    surface
}

/// Stalks thrown over each other.
pub(super) fn straw(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.22));
    strokes(
        appearance,
        &mut surface,
        &Strokes {
            count: 620.0,
            length: 0.55,
            width: 0.013,
            taper: 0.0,
            turn: 0.04,
            stray: 0.16,
            flow: (0.12, 3),
            bend: 0.02,
            root: 0.95,
            lift: 0.006,
            gloss: appearance.shine(0.25),
        },
    );
    surface
}

/// Springy coils: scouring pads, steel wool, coir, loofah.
pub(super) fn tangle(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = ground(size, lit(appearance.color(0), 0.22));
    let width = 0.28 / appearance.count(40.0) as f32;
    strokes(
        appearance,
        &mut surface,
        &Strokes {
            count: 2300.0,
            length: 0.22,
            width,
            taper: 0.0,
            turn: 0.0,
            stray: 0.5,
            flow: (0.0, 3),
            bend: 0.85,
            root: 0.9,
            lift: 0.5 * width,
            gloss: appearance.shine(0.3),
        },
    );
    surface
}

/// Short hairs on a skin.
pub(super) fn stubble(appearance: &Appearance, size: usize) -> Surface {
    let mut surface = super::hide::skin(appearance, size);
    let mut chance = Sequence::new(appearance.seed + 1);
    for _ in 0..420 {
        let (u, v) = (chance.next(), chance.next());
        let color = lit(appearance.color(9), 0.6 + 0.5 * chance.next());
        let thread = Thread {
            width: 0.005,
            taper: 0.5,
            level: 0.02,
            rise: 0.01,
            lift: 0.002,
            colors: (color, color),
            gloss: 0.1,
        };
        surface.thread(
            &path(
                u,
                v,
                0.2 + 0.08 * chance.signed(),
                0.05,
                0.02 + 0.02 * chance.next(),
                2,
            ),
            &thread,
        );
    }
    surface
}
