//! A piece of surface: heights and colours, before light falls on it.

use crate::color::{Rgb, mix};
use rayon::prelude::*;

/// Pixels that one thread draws in a run, at least.
pub(crate) const RUN: usize = 4096;

/// A pixel of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Texel {
    /// Height, patches: 0.01 is one hundredth of the picture's width.
    pub(crate) height: f32,
    /// Colour without light.
    pub(crate) color: Rgb,
    /// Specular share of the light, 0..=1.
    pub(crate) gloss: f32,
    /// Light that comes on top: a reflection, a glint.
    pub(crate) glow: f32,
}

/// Texels of a square patch, row by row.
#[derive(Debug, Clone)]
pub(crate) struct Surface {
    /// Width and height, pixels.
    pub(crate) size: usize,
    pub(crate) texels: Vec<Texel>,
}

impl Surface {
    /// A surface that says for each place (u, v) in 0..1 what is there.
    pub(crate) fn of(size: usize, at: impl Fn(f32, f32) -> Texel + Sync) -> Self {
        Self {
            size,
            texels: field(size, at),
        }
    }

    /// The surface mirrored at its diagonal, so that what ran across runs down.
    pub(crate) fn turned(&self) -> Self {
        let texel = |n: usize| self.texels[n % self.size * self.size + n / self.size];
        Self {
            size: self.size,
            texels: (0..self.texels.len()).map(texel).collect(),
        }
    }

    /// Stamps a shape around (u, v) within `radius` patches. `shape` maps an offset from the centre, in
    /// patches, to the texel there, if any. A higher texel hides a lower one.
    pub(crate) fn stamp(
        &mut self,
        place: (f32, f32),
        radius: f32,
        shape: impl Fn(f32, f32) -> Option<Texel>,
    ) {
        let mut whole = Band {
            size: self.size,
            first: 0,
            texels: &mut self.texels,
        };
        whole.stamp(place, radius, shape);
    }

    /// Puts each thing on the surface, in their order. Bands of rows are drawn at the same time, so
    /// `stamp` meets each thing once a band.
    pub(crate) fn stamp_each<T: Sync>(
        &mut self,
        things: &[T],
        stamp: impl Fn(&mut Band<'_>, &T) + Sync,
    ) {
        let size = self.size;
        let rows = RUN.div_ceil(size);
        let bands = self.texels.par_chunks_mut(rows * size).enumerate();
        bands.for_each(|(k, texels)| {
            let first = k * rows;
            let mut band = Band {
                size,
                first,
                texels,
            };
            for thing in things {
                stamp(&mut band, thing);
            }
        });
    }

    /// Draws a thread through the points: round, `width` patches wide, `lift` patches high over
    /// its own level, coloured along its way.
    pub(crate) fn thread(&mut self, points: &[(f32, f32)], thread: &Thread) {
        let radius = 0.5 * thread.width.max(1.1 / self.size as f32);
        let pixel = 1.0 / self.size as f32;
        let spacing = (0.6 * radius).max(0.8 * pixel);
        let total = points.len().saturating_sub(1).max(1) as f32;
        for (k, pair) in points.windows(2).enumerate() {
            let ((u0, v0), (u1, v1)) = (pair[0], pair[1]);
            let (du, dv) = (u1 - u0, v1 - v0);
            let length = (du * du + dv * dv).sqrt();
            let count = (length / spacing) as usize + 1;
            for i in 0..count {
                let t = i as f32 / count as f32;
                let along = (k as f32 + t) / total;
                let radius = radius * (1.0 - thread.taper * along);
                let color = mix(thread.colors.0, thread.colors.1, along);
                let level = thread.level + thread.rise * along;
                self.stamp((u0 + du * t, v0 + dv * t), radius, |dx, dy| {
                    let d2 = (dx * dx + dy * dy) / (radius * radius);
                    (d2 < 1.0).then_some(Texel {
                        height: level + thread.lift * (1.0 - d2),
                        color,
                        gloss: thread.gloss,
                        glow: 0.0,
                    })
                });
            }
        }
    }
}

/// Evaluates `at` at the middle of each pixel, row by row; places (u, v) are in 0..1.
pub(crate) fn field<T: Send>(size: usize, at: impl Fn(f32, f32) -> T + Sync) -> Vec<T> {
    let place = |pixel: usize| (pixel as f32 + 0.5) / size as f32;
    let pixels = (0..size * size).into_par_iter().with_min_len(RUN);
    pixels
        .map(|k| at(place(k % size), place(k / size)))
        .collect()
}

/// Some rows of a surface, one below the other.
pub(crate) struct Band<'a> {
    /// Width and height of the whole surface, pixels.
    size: usize,
    /// Its first row.
    first: usize,
    texels: &'a mut [Texel],
}

impl Band<'_> {
    /// As [`Surface::stamp`], on these rows only.
    pub(crate) fn stamp(
        &mut self,
        (u, v): (f32, f32),
        radius: f32,
        shape: impl Fn(f32, f32) -> Option<Texel>,
    ) {
        let n = self.size as f32;
        let first = |c: f32| crate::noise::floor((c - radius) * n);
        let last = |c: f32| crate::noise::floor((c + radius) * n) + 1;
        let size = self.size as i32;
        let rows = self.texels.len() / self.size;
        for y in first(v)..=last(v) {
            let row = (y.rem_euclid(size) as usize).wrapping_sub(self.first);
            if row >= rows {
                continue;
            }
            let row = row * self.size;
            let dy = (y as f32 + 0.5) / n - v;
            for x in first(u)..=last(u) {
                let dx = (x as f32 + 0.5) / n - u;
                let old = &mut self.texels[row + x.rem_euclid(size) as usize];
                if let Some(new) = shape(dx, dy).filter(|new| new.height >= old.height) {
                    *old = new;
                }
            }
        }
    }
}

/// Shape and colours of a thread.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Thread {
    /// Width, patches.
    pub(crate) width: f32,
    /// Share of the width that is lost on the way.
    pub(crate) taper: f32,
    /// Height of its border at its beginning, patches.
    pub(crate) level: f32,
    /// Rise of the border from beginning to end, patches.
    pub(crate) rise: f32,
    /// Height of its middle over its border, patches.
    pub(crate) lift: f32,
    /// Colours at its beginning and end.
    pub(crate) colors: (Rgb, Rgb),
    /// As of a texel.
    pub(crate) gloss: f32,
}
