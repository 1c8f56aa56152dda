//! A preview that is drawn from the vibration of a texture, not from a photograph.
//!
//! The picture is a relief under one light: a sum of waves with random directions and phases,
//! whose lengths v/f are drawn from the spectrum at the middle of the grid. The depth of the relief
//! follows the level, and its tint the families of the nearest materials.

use crate::model::{ModelGrid, VertexKind};
use crate::signal::spectrum::ArmaModel;
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;
use thiserror::Error;

/// Width and height, pixels.
pub const SIZE: usize = 192;
/// Width of the piece of surface that is shown, mm.
const PATCH_MM: f64 = 14.0;
/// Waves that make the relief.
const WAVES: usize = 96;
/// Frequencies between which the waves are drawn, Hz.
const BAND_HZ: (f64, f64) = (20.0, 450.0);
/// Levels between which the relief grows from flat to steep, dB re 1 m/s².
const LEVELS_DB: (f64, f64) = (-24.0, 16.0);
/// Brightness of a flat, lit surface.
const AMBIENT: f64 = 0.72;
/// Tint of a family that is not in the table.
const NEUTRAL: [f64; 3] = [0.62, 0.62, 0.62];
/// Tints of the families of the reference corpus, linear in 0..=1.
const TINTS: [(&str, [f64; 3]); 20] = [
    ("abrasives", [0.60, 0.42, 0.28]),
    ("carpets", [0.50, 0.36, 0.34]),
    ("ceramics", [0.78, 0.52, 0.40]),
    ("fabrics", [0.42, 0.50, 0.66]),
    ("foams", [0.86, 0.82, 0.58]),
    ("foods", [0.80, 0.62, 0.36]),
    ("gels", [0.72, 0.78, 0.62]),
    ("glass", [0.66, 0.80, 0.82]),
    ("granular", [0.80, 0.72, 0.54]),
    ("leathers", [0.50, 0.32, 0.22]),
    ("meshes", [0.52, 0.56, 0.58]),
    ("metals", [0.70, 0.72, 0.76]),
    ("organic", [0.48, 0.54, 0.34]),
    ("papers", [0.88, 0.86, 0.80]),
    ("piles", [0.58, 0.46, 0.60]),
    ("plastics", [0.46, 0.58, 0.72]),
    ("rubbers", [0.30, 0.30, 0.32]),
    ("stones", [0.60, 0.58, 0.54]),
    ("wet", [0.54, 0.70, 0.78]),
    ("woods", [0.68, 0.50, 0.32]),
];

/// The picture could not be encoded as PNG.
#[derive(Debug, Error)]
#[error("the preview: {0}")]
pub struct PreviewError(#[from] png::EncodingError);

impl crate::diagnostic::Diagnostic for PreviewError {
    fn remedy(&self) -> String {
        "compile with --no-preview".into()
    }
}

/// The preview as PNG bytes; `families` are the nearest materials' with their weights.
///
/// # Errors
/// [`PreviewError`] when the encoder fails.
pub fn png(grid: &ModelGrid, families: &[(&str, f64)], seed: u64) -> Result<Vec<u8>, PreviewError> {
    let heights = relief(grid, seed);
    let pixels = shade(&heights, tint(families));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIZE as u32, SIZE as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// Heights, row by row. Their RMS grows with the level.
fn relief(grid: &ModelGrid, seed: u64) -> Vec<f64> {
    let mut heights = vec![0.0; SIZE * SIZE];
    let interior = || {
        grid.vertices
            .iter()
            .filter(|vertex| vertex.kind == VertexKind::Interior)
    };
    let count = interior().count().max(1) as f64;
    let mean_speed = interior().map(|v| v.speed_mm_s).sum::<f64>() / count;
    let mean_force = interior().map(|v| v.force_n).sum::<f64>() / count;
    let distance = |v: &crate::model::GridVertex| {
        let x = v.speed_mm_s / mean_speed - 1.0;
        let y = v.force_n / mean_force - 1.0;
        x * x + y * y
    };
    let Some(middle) = interior().min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
        return heights;
    };
    let model = ArmaModel::at_vertex(grid, middle);
    let Some(vibration) = model.vibration() else {
        return heights;
    };
    let frequencies = quantiles(&model);
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut uniform = || (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    for freq_hz in frequencies {
        let per_pixel = TAU * freq_hz / middle.speed_mm_s * PATCH_MM / SIZE as f64;
        let (sin, cos) = libm::sincos(TAU * uniform());
        let (step_x, step_y) = (per_pixel * cos, per_pixel * sin);
        let phase = TAU * uniform();
        // By the addition theorem a pixel takes two products instead of a cosine.
        let columns: Vec<(f64, f64)> = (0..SIZE)
            .map(|x| libm::sincos(step_x * x as f64 + phase))
            .collect();
        for (y, row) in heights.chunks_mut(SIZE).enumerate() {
            let (sin_y, cos_y) = libm::sincos(step_y * y as f64);
            for (height, (sin_x, cos_x)) in row.iter_mut().zip(&columns) {
                *height += cos_x * cos_y - sin_x * sin_y;
            }
        }
    }
    let level_db = 10.0 * libm::log10(vibration.power);
    let (low, high) = LEVELS_DB;
    let depth = ((level_db - low) / (high - low)).clamp(0.02, 1.0);
    let scale = depth / (WAVES as f64 / 2.0).sqrt();
    for height in &mut heights {
        *height *= scale;
    }
    heights
}

/// Frequencies that split the power of a model into [`WAVES`] equal parts.
fn quantiles(model: &ArmaModel) -> Vec<f64> {
    const STEPS: usize = 860;
    let (low, high) = BAND_HZ;
    let width = (high - low) / STEPS as f64;
    let powers: Vec<f64> = (0..STEPS)
        .map(|step| model.power(low + (step as f64 + 0.5) * width))
        .collect();
    let total: f64 = powers.iter().sum();
    let mut frequencies = Vec::with_capacity(WAVES);
    let mut sum = 0.0;
    for (step, power) in powers.iter().enumerate() {
        sum += power / total;
        while frequencies.len() < WAVES && (frequencies.len() as f64 + 0.5) / WAVES as f64 <= sum {
            frequencies.push(low + (step as f64 + 0.5) * width);
        }
    }
    frequencies
}

fn tint(families: &[(&str, f64)]) -> [f64; 3] {
    let of = |family: &str| {
        TINTS
            .iter()
            .find(|(name, _)| *name == family)
            .map_or(NEUTRAL, |(_, tint)| *tint)
    };
    let total: f64 = families.iter().map(|(_, weight)| weight).sum();
    if total <= 0.0 {
        return NEUTRAL;
    }
    let mut mean = [0.0; 3];
    for (family, weight) in families {
        for (sum, channel) in mean.iter_mut().zip(of(family)) {
            *sum += weight / total * channel;
        }
    }
    mean
}

/// RGB of a relief lit from the upper left.
fn shade(heights: &[f64], tint: [f64; 3]) -> Vec<u8> {
    let at = |x: usize, y: usize| heights[(y % SIZE) * SIZE + x % SIZE];
    let mut pixels = Vec::with_capacity(3 * SIZE * SIZE);
    for y in 0..SIZE {
        for x in 0..SIZE {
            // The last column and row take the slope of the ones before them.
            let (x0, y0) = (x.min(SIZE - 2), y.min(SIZE - 2));
            let slope = at(x0 + 1, y0) - at(x0, y0) + at(x0, y0 + 1) - at(x0, y0);
            let light = AMBIENT - 0.55 * slope + 0.10 * at(x, y);
            for channel in tint {
                let value = 255.0 * (channel * light / AMBIENT).clamp(0.0, 1.0);
                pixels.push((value + 0.5) as u8);
            }
        }
    }
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::front_ends::builtin;

    #[test]
    fn a_louder_texture_has_more_contrast() {
        let quiet = builtin::texture().grid;
        let mut loud = quiet.clone();
        for vertex in &mut loud.vertices {
            vertex.sigma_m_s2 *= 3.0;
        }
        let contrast = |grid: &ModelGrid| {
            let heights = relief(grid, 1);
            heights.iter().map(|h| h * h).sum::<f64>()
        };
        assert!(contrast(&loud) > 1.2 * contrast(&quiet));
    }

    #[test]
    fn the_same_texture_gives_the_same_bytes_and_a_readable_png() {
        let grid = builtin::texture().grid;
        let bytes = png(&grid, &[("abrasives", 0.7), ("unknown", 0.3)], 3).unwrap();
        assert_eq!(
            bytes,
            png(&grid, &[("abrasives", 0.7), ("unknown", 0.3)], 3).unwrap()
        );
        let reader = png::Decoder::new(std::io::Cursor::new(&bytes))
            .read_info()
            .unwrap();
        assert_eq!(reader.info().size(), (SIZE as u32, SIZE as u32));
    }
}
