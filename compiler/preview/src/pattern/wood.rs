//! Wood, bark, cork and what is made of chips.

use crate::{
    appearance::Appearance,
    color::{Rgb, lit, mix},
    noise::{
        Sequence, cell, dome, floor, fract, gradient, hash, lerp, nth, octaves, step, unit, wave,
    },
    surface::{Surface, Texel},
};

/// Height and tone of flat-sawn timber: rings that arch around a heart, pores, a knot.
fn grain(
    appearance: &Appearance,
    u: f32,
    v: f32,
    rings: i32,
    seed: u32,
    knot: bool,
) -> (f32, crate::color::Rgb) {
    // Slow along the grain, fast across it.
    let arch = 0.42 * gradient(u, v, 1, 2, seed)
        + 0.16 * gradient(u, v, 2, 4, seed + 1)
        + 0.02 * gradient(u, v, 5, 16, seed + 2);
    let mut t = v + arch;
    let mut heart = 0.0;
    if knot {
        let (du, dv) = (
            fract(u - unit(seed) + 0.5) - 0.5,
            fract(v - nth(seed, 2) + 0.5) - 0.5,
        );
        let d = (du * du * 0.30 + dv * dv).sqrt();
        let pull = 1.0 / (1.0 + (d / 0.075) * (d / 0.075));
        heart = step(0.040, 0.026, (du * du * 0.55 + dv * dv).sqrt());
        t += 0.20 * pull * if dv > 0.0 { 1.0 } else { -1.0 } * step(0.0, 0.03, dv.abs());
    }
    let f = fract(t * rings as f32);
    // Early wood fades into late wood, which ends sharply.
    let late = step(0.15, 0.92, f) * step(1.0, 0.94, f);
    let fibre = gradient(u, v, 7, 150, seed + 3);
    let pore = step(0.40, 0.62, gradient(u, v, 22, 210, seed + 4)) * (0.4 + 0.6 * (1.0 - late));
    let color = mix(
        appearance.color(0),
        appearance.color(1),
        0.80 * late + 0.10 * fibre,
    );
    let color = lit(
        color,
        1.0 + 0.13 * fibre - 0.30 * pore + 0.10 * octaves(u, v, 2, 5, 2, seed + 5),
    );
    let color = mix(
        color,
        lit(appearance.color(1), 0.45 + 0.2 * wave(14.0 * t)),
        0.9 * heart,
    );
    (0.0012 * late - 0.0030 * pore + 0.0010 * fibre, color)
}

/// A sawn or planed board.
pub(super) fn board(appearance: &Appearance, size: usize) -> Surface {
    let rings = appearance.count(9.0);
    let shine = appearance.shine(0.1);
    Surface::of(size, |u, v| {
        let (height, color) = grain(appearance, u, v, rings, appearance.seed, true);
        let gleam = step(0.1, 0.7, octaves(u, v, 1, 2, 2, appearance.seed + 8));
        Texel {
            height: height * 1.4,
            color,
            gloss: shine,
            glow: 0.16 * shine * gleam,
        }
    })
}

/// Boards side by side: floors, decks, pallets.
pub(super) fn planks(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(4.0);
    let shine = appearance.shine(0.1);
    Surface::of(size, |u, v| {
        let y = v * n as f32;
        let row = floor(y).rem_euclid(n);
        let id = hash(row, 3, appearance.seed);
        let a = fract(u + unit(id));
        let f = fract(y);
        let joint = step(0.03, 0.012, f.min(1.0 - f) * 0.5).max(step(0.006, 0.002, a.min(1.0 - a)));
        let (height, color) = grain(
            appearance,
            a,
            fract(v + nth(id, 1)),
            10,
            appearance.seed + (id & 63),
            nth(id, 2) < 0.35,
        );
        let rough = 1.0 - shine.min(1.0);
        Texel {
            height: height * (1.0 + 2.0 * rough) - 0.012 * joint,
            color: lit(
                mix(color, lit(appearance.color(1), 0.12), joint),
                0.82 + 0.32 * nth(id, 4),
            ),
            gloss: shine * (1.0 - joint),
            glow: 0.0,
        }
    })
}

/// The end of a trunk: rings around a heart, cracks from it.
pub(super) fn rings(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(17.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let (du, dv) = (u - 0.5, v - 0.5);
        let w = 0.035 * octaves(u, v, 3, 3, 3, seed);
        let d = (du * du + dv * dv).sqrt() + w;
        let f = fract(1.4 * d * n as f32);
        let late = step(0.2, 0.95, f) * step(1.0, 0.95, f);
        let turn = libm::atan2f(dv, du) / core::f32::consts::TAU + 0.5;
        let ray = gradient(turn, 0.5, 60, 1, seed + 1);
        let crack =
            step(0.010, 0.003, (fract(turn + 0.4 * w) - unit(seed)).abs() * d) * step(0.42, 0.1, d);
        let fine = octaves(u, v, 60, 60, 2, seed + 2);
        let color = mix(
            appearance.color(0),
            appearance.color(1),
            0.75 * late + 0.10 * ray,
        );
        Texel {
            height: 0.0025 * late + 0.002 * fine - 0.02 * crack,
            color: lit(
                mix(color, lit(appearance.color(1), 0.2), crack),
                1.0 + 0.14 * fine - 0.12 * step(0.2, 0.5, d),
            ),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// Furrowed bark in long plates.
pub(super) fn bark(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(8.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let wx = 0.05 * octaves(u, v, 4, 3, 4, seed);
        let wy = 0.05 * octaves(u, v, 5, 4, 3, seed + 1);
        let plate = cell(u + wx, v + wy, n, (n / 3).max(1), 1.0, seed + 2);
        let small = cell(u + wx, v - wy, n * 2, n, 1.0, seed + 3);
        let ridge = step(0.0, 0.26, plate.edge);
        let split = step(0.0, 0.10, small.edge);
        let fibre = octaves(u + 0.6 * wx, v, n * 7, n, 4, seed + 4);
        let scale = nth(plate.id, 1);
        let height = 0.048 * ridge * (0.7 + 0.4 * scale) + 0.010 * split * ridge + 0.009 * fibre;
        let tone = (0.28 + 0.72 * ridge)
            * (0.85 + 0.25 * scale)
            * (1.0 + 0.35 * fibre)
            * lerp(0.75, 1.0, split);
        Texel {
            height,
            color: lit(
                mix(
                    appearance.color(1),
                    appearance.color(0),
                    ridge * (0.7 + 0.5 * fibre),
                ),
                tone,
            ),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// Smooth bark with short dark cross lines.
pub(super) fn birch(appearance: &Appearance, size: usize) -> Surface {
    let seed = appearance.seed;
    let n = appearance.count(9.0);
    Surface::of(size, |u, v| {
        let c = cell(u, v, n / 2 + 1, n * 2, 1.0, seed);
        let (half, thick) = (0.16 + 0.26 * nth(c.id, 1), 0.10 + 0.16 * nth(c.id, 2));
        let (a, b) = (c.way.0 / half, c.way.1 / thick);
        let mark = if nth(c.id, 3) < 0.55 {
            step(1.1, 0.7, a * a + b * b)
        } else {
            0.0
        };
        let curl = octaves(u, v, 3, 26, 3, seed + 1);
        let scar = step(0.42, 0.6, octaves(u, v, 3, 4, 3, seed + 2));
        let color = mix(
            appearance.color(0),
            appearance.color(1),
            (0.9 * mark).max(0.8 * scar),
        );
        Texel {
            height: 0.003 * curl - 0.004 * mark + 0.01 * scar,
            color: lit(color, 0.95 + 0.14 * curl),
            gloss: 0.05,
            glow: 0.0,
        }
    })
}

/// Granules of cork pressed together, each of its own brown, with dark specks between them.
pub(super) fn cork(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(17.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let w = 0.30 / n as f32;
        let (a, b) = (
            u + w * gradient(u, v, n * 2, n * 2, seed),
            v + w * gradient(u, v, n * 2, n * 2, seed + 1),
        );
        let big = cell(a, b, n, n, 1.0, seed + 2);
        let small = cell(a, b, n * 2, n * 2, 1.0, seed + 3);
        let id = if nth(big.id, 1) < 0.6 { big } else { small };
        let seam = step(0.0, 0.07, id.edge);
        let speck = cell(b, a, n * 2, n * 2, 1.0, seed + 4);
        let radius = 0.12 + 0.30 * nth(speck.id, 1);
        let bent = speck.near * (1.0 + 0.5 * gradient(u, v, n * 5, n * 5, seed + 5));
        let dark = if nth(speck.id, 2) < 0.22 {
            step(radius, radius * 0.6, bent)
        } else {
            0.0
        };
        let fine = octaves(u, v, n * 6, n * 6, 2, seed + 6);
        let shade = nth(id.id, 2);
        let color = mix(appearance.color(0), appearance.color(1), shade * shade);
        let color = lit(
            color,
            (0.86 + 0.30 * nth(id.id, 3) + 0.16 * fine) * lerp(0.72, 1.0, seam),
        );
        Texel {
            height: (0.055 * seam + 0.05 * nth(id.id, 4) + 0.03 * fine - 0.16 * dark) / n as f32,
            color: mix(
                color,
                lit(appearance.color(2), 0.8 + 0.4 * fine),
                0.92 * dark,
            ),
            gloss: 0.0,
            glow: 0.0,
        }
    })
}

/// A flat chip that lies somewhere: lengths in patches.
struct Chip {
    place: (f32, f32),
    along: f32,
    across: f32,
    color: Rgb,
    /// Cosine and sine of its turn.
    way: (f32, f32),
    level: f32,
    tilt: f32,
    /// Phase of its ragged ends and its grain, turns.
    phase: f32,
}

impl Chip {
    /// Returns the texel at an offset from the middle, patches; `None` outside the chip.
    fn at(&self, dx: f32, dy: f32) -> Option<Texel> {
        let (c, s) = self.way;
        let (a, b) = (
            (dx * c + dy * s) / self.along,
            (dy * c - dx * s) / self.across,
        );
        // Most of the square lies outside, where no sine is needed.
        if a.abs() > 1.1 || b.abs() >= 1.0 {
            return None;
        }
        let ragged = 0.12 * wave(3.1 * b + self.phase) + 0.06 * wave(7.3 * b);
        let tone = 1.0 + 0.10 * wave(2.5 * b + 0.3 * a + self.phase) + 0.05 * wave(9.0 * b);
        (a.abs() < 0.9 + ragged).then(|| Texel {
            height: self.level + self.tilt * self.across * b,
            color: lit(self.color, tone),
            gloss: 0.0,
            glow: 0.0,
        })
    }
}

/// Flat chips or flakes thrown over each other.
pub(super) fn chips(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(9.0);
    let mut surface = Surface::of(size, |_, _| Texel {
        height: 0.0,
        color: lit(appearance.color(0), 0.35),
        gloss: 0.0,
        glow: 0.0,
    });
    let mut chance = Sequence::new(appearance.seed);
    let count = n * n * 7;
    let chips: Vec<Chip> = (0..count)
        .map(|k| {
            let place = (chance.next(), chance.next());
            let turn = chance.next();
            Chip {
                place,
                along: (0.45 + 0.75 * chance.next()) / n as f32,
                across: (0.16 + 0.30 * chance.next()) / n as f32,
                color: lit(appearance.any(chance.next()), 0.72 + 0.5 * chance.next()),
                way: (wave(turn + 0.25), wave(turn)),
                level: 0.020 * k as f32 / count as f32,
                tilt: 0.10 * chance.signed(),
                phase: unit(chance.id()),
            }
        })
        .collect();
    surface.stamp_each(&chips, |band, chip| {
        let radius = chip.along.max(chip.across) * 1.1;
        band.stamp(chip.place, radius, |dx, dy| chip.at(dx, dy));
    });
    surface
}

/// Canes side by side with knots: bamboo, reed.
pub(super) fn bamboo(appearance: &Appearance, size: usize) -> Surface {
    let n = appearance.count(5.0);
    let seed = appearance.seed;
    Surface::of(size, |u, v| {
        let x = u * n as f32;
        let id = hash(floor(x).rem_euclid(n), 1, seed);
        let side = 2.0 * fract(x) - 1.0;
        let body = dome(side * 0.98);
        let t = fract(v + unit(id));
        let node = step(0.022, 0.008, (t - 0.5).abs());
        let lip = step(0.035, 0.0, (t - 0.475).abs());
        let fibre = gradient(u, v, n * 22, 4, seed);
        let color = mix(
            appearance.color(0),
            appearance.color(1),
            0.5 + 0.6 * gradient(u, v, n, 3, seed + 1),
        );
        Texel {
            height: (0.40 * body + 0.05 * lip - 0.04 * node) / n as f32,
            color: lit(
                color,
                (0.9 + 0.2 * nth(id, 1) + 0.10 * fibre)
                    * lerp(0.30, 1.0, step(0.0, 0.45, body))
                    * (1.0 - 0.55 * node),
            ),
            gloss: appearance.shine(0.45),
            glow: 0.22 * step(0.16, 0.0, (side + 0.42).abs()) * (1.0 - node),
        }
    })
}
