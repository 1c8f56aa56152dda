//! The preview of a surface: what it looks like, or its heights under a light.

use asperity_io::diagnostic::Fault;
use asperity_surface::{heights::HeightField, map::Raster};

/// Grey of what lies flat.
const GREY: f32 = 150.0;
/// Change of the grey by a slope of the field's RMS.
const CONTRAST: f32 = 45.0;

/// A picture in colours or grey, `size_px` pixels wide and high, as PNG; of an oblong one, the middle.
pub(super) fn of_color(raster: &Raster, size_px: u32) -> Result<Vec<u8>, Fault> {
    let part = |channel: usize| {
        let at = |n: usize| raster.samples[n * raster.channels + channel.min(raster.channels - 1)];
        square((raster.width, raster.height()), size_px as usize, at)
    };
    let [red, green, blue] = [0, 1, 2].map(part);
    let byte = |part: f32| (255.0 * part).round() as u8;
    let pixels: Vec<[u8; 3]> = (0..red.len())
        .map(|n| [red[n], green[n], blue[n]].map(byte))
        .collect();
    png(&pixels, size_px)
}

/// The field under a light from the upper left, as [`of_color`].
pub(super) fn of_heights(field: &HeightField, size_px: u32) -> Result<Vec<u8>, Fault> {
    let size = size_px as usize;
    let all = field.heights_um();
    let heights = square((field.width(), field.height()), size, |n| all[n]);
    let slope = |n: usize| {
        let (x, y) = (n % size, n / size);
        heights[n] - heights[y.saturating_sub(1) * size + x.saturating_sub(1)]
    };
    let slopes: Vec<f32> = (0..size * size).map(slope).collect();
    let mean = slopes.iter().map(|s| s * s).sum::<f32>() / slopes.len() as f32;
    let rms = mean.sqrt().max(f32::MIN_POSITIVE);
    let lit = |slope: &f32| [(GREY + CONTRAST * slope / rms).clamp(0.0, 255.0) as u8; 3];
    let pixels: Vec<[u8; 3]> = slopes.iter().map(lit).collect();
    png(&pixels, size_px)
}

/// The middle square of numbers in rows, each the mean over its part, or the nearest where there are fewer.
fn square((width, height): (usize, usize), size: usize, at: impl Fn(usize) -> f32) -> Vec<f32> {
    let side = width.min(height);
    let (left, top) = ((width - side) / 2, (height - side) / 2);
    let range = |n: usize| n * side / size..((n + 1) * side / size).max(n * side / size + 1);
    let mean = |n: usize| {
        let places = range(n / size).flat_map(|y| range(n % size).map(move |x| (x, y)));
        let all = places.map(|(x, y)| at((top + y) * width + left + x));
        let (sum, count) = all.fold((0.0, 0.0), |(sum, count), h| (sum + h, count + 1.0));
        sum / count
    };
    (0..size * size).map(mean).collect()
}

fn png(pixels: &[[u8; 3]], size_px: u32) -> Result<Vec<u8>, Fault> {
    asperity_preview::compact_png(pixels, size_px, &[]).map_err(crate::views::preview::not_encoded)
}
