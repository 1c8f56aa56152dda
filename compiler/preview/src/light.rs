//! Shading of a surface by a single light from the upper left.

use crate::{
    color::{Rgb, encoded, lit, mix},
    surface::{RUN, Surface},
};
use rayon::prelude::*;

/// Way to the light: right, down, towards the eye; of length 1.
const TO_LIGHT: [f32; 3] = [-0.48, -0.52, 0.706_5];
/// Light that comes from everywhere, of a flat surface's.
const AMBIENT: f32 = 0.42;
/// Relative darkening of hollows and brightening of peaks, per hundredth of a patch.
const HOLLOW: f32 = 0.34;
/// Radius within which a hollow is one, of the picture.
const HOLLOW_RADIUS: f32 = 0.016;

/// The slopes of the heights at every pixel, to the right and down, from both neighbours.
pub(crate) fn slopes(surface: &Surface) -> Vec<(f32, f32)> {
    let n = surface.size;
    let at = |x: usize, y: usize| surface.texels[y * n + x].height;
    let mut slopes = Vec::with_capacity(n * n);
    let half = 0.5 * n as f32;
    for y in 0..n {
        let (above, below) = ((y + n - 1) % n, (y + 1) % n);
        for x in 0..n {
            let (left, right) = ((x + n - 1) % n, (x + 1) % n);
            let across = (at(right, y) - at(left, y)) * half;
            slopes.push((across, (at(x, below) - at(x, above)) * half));
        }
    }
    slopes
}

/// The picture of a surface as sRGB.
pub(crate) fn shade(surface: &Surface) -> Vec<[u8; 3]> {
    let slopes = slopes(surface);
    let hollows = hollows(surface);
    let middle = {
        let (x, y, z) = (TO_LIGHT[0], TO_LIGHT[1], TO_LIGHT[2] + 1.0);
        let length = (x * x + y * y + z * z).sqrt();
        [x / length, y / length, z / length]
    };
    let exponent = |gloss: f32| 6.0 + 70.0 * gloss;
    let flat = |gloss: f32| libm::powf(middle[2], exponent(gloss));
    // Most materials are equally glossy all over.
    let usual = surface.texels.first().map_or(0.0, |texel| texel.gloss);
    let usual_flat = flat(usual);
    let texels = surface.texels.par_iter().with_min_len(RUN);
    texels
        .zip(slopes)
        .zip(hollows)
        .map(|((texel, (dx, dy)), hollow)| {
            let length = (dx * dx + dy * dy + 1.0).sqrt();
            let along = |way: [f32; 3]| (way[2] - way[0] * dx - way[1] * dy) / length;
            let facing = along(TO_LIGHT).max(0.0) / TO_LIGHT[2];
            let light = (AMBIENT + (1.0 - AMBIENT) * facing) * hollow;
            let color = lit(texel.color, light);
            let shine = if texel.gloss > 0.0 {
                let flat = if texel.gloss == usual {
                    usual_flat
                } else {
                    flat(texel.gloss)
                };
                let mirrored = libm::powf(along(middle).max(0.0), exponent(texel.gloss));
                texel.gloss * (mirrored - flat)
            } else {
                0.0
            };
            encoded(shone(color, shine + texel.glow))
        })
        .collect()
}

/// The colours of a surface as sRGB, for a renderer that brings its own light: hollows are dark and reflections bright,
/// but no side faces a light.
pub(crate) fn unlit(surface: &Surface) -> Vec<[u8; 3]> {
    let texels = surface.texels.iter().zip(hollows(surface));
    texels
        .map(|(texel, hollow)| encoded(shone(lit(texel.color, hollow), texel.glow)))
        .collect()
}

/// A colour with a share of white light on it, or with less of its own where that is negative.
fn shone(color: Rgb, shine: f32) -> Rgb {
    if shine > 0.0 {
        mix(color, [1.0; 3], shine * 0.85)
    } else {
        lit(color, 1.0 + 0.6 * shine)
    }
}

/// What the heights around leave of the light that falls on each pixel.
fn hollows(surface: &Surface) -> Vec<f32> {
    let texels = surface.texels.iter().zip(blurred(surface));
    texels
        .map(|(texel, mean)| (1.0 + HOLLOW * 100.0 * (texel.height - mean)).clamp(0.45, 1.25))
        .collect()
}

/// The heights, each the mean of a square around it.
fn blurred(surface: &Surface) -> Vec<f32> {
    let n = surface.size;
    let radius = ((HOLLOW_RADIUS * n as f32) as usize).max(2);
    let heights: Vec<f32> = surface.texels.iter().map(|t| t.height).collect();
    let rows = running_mean(&heights, n, radius);
    transposed(&running_mean(&transposed(&rows, n), n, radius), n)
}

/// Running means along the rows. Whole numbers are summed, so that no error adds up.
fn running_mean(values: &[f32], n: usize, radius: usize) -> Vec<f32> {
    const ONE: f32 = (1 << 24) as f32;
    let width = (2 * radius + 1) as f32;
    let mut means = Vec::with_capacity(values.len());
    for row in values.chunks(n) {
        let whole: Vec<i64> = row.iter().map(|v| (v * ONE) as i64).collect();
        let mut sum: i64 = (0..=2 * radius).map(|k| whole[(k + n - radius) % n]).sum();
        for x in 0..n {
            means.push(sum as f32 / (ONE * width));
            sum += whole[(x + radius + 1) % n] - whole[(x + n - radius) % n];
        }
    }
    means
}

fn transposed(values: &[f32], n: usize) -> Vec<f32> {
    let mut turned = Vec::with_capacity(values.len());
    for x in 0..n {
        turned.extend((0..n).map(|y| values[y * n + x]));
    }
    turned
}
