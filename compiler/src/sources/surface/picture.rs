//! A picture of heights under a light, as the preview of a surface.

use asperity_io::diagnostic::Fault;
use asperity_surface::heights::HeightField;

/// Grey of what lies flat.
const GREY: f32 = 150.0;
/// Change of the grey by a slope of the field's RMS.
const CONTRAST: f32 = 45.0;

/// The field under a light from the upper left, `size_px` pixels wide and high, as PNG; of an oblong field, the middle.
pub(super) fn png(field: &HeightField, size_px: u32) -> Result<Vec<u8>, Fault> {
    let size = size_px as usize;
    let side = field.width().min(field.height());
    let (left, top) = ((field.width() - side) / 2, (field.height() - side) / 2);
    let at = |x: usize, y: usize| {
        // The mean over a pixel, or the nearest point.
        let range = |n: usize| n * side / size..((n + 1) * side / size).max(n * side / size + 1);
        let rows = range(y).flat_map(|y| {
            let row = (top + y) * field.width() + left;
            field.heights_um()[row..][range(x)].iter()
        });
        let (sum, count) = rows.fold((0.0, 0.0), |(sum, count), h| (sum + h, count + 1.0));
        sum / count
    };
    let heights: Vec<f32> = (0..size * size).map(|n| at(n % size, n / size)).collect();
    let slope = |n: usize| {
        let (x, y) = (n % size, n / size);
        let before = |x: usize, y: usize| heights[y.saturating_sub(1) * size + x.saturating_sub(1)];
        heights[n] - before(x, y)
    };
    let slopes: Vec<f32> = (0..size * size).map(slope).collect();
    let square = slopes.iter().map(|s| s * s).sum::<f32>() / slopes.len() as f32;
    let rms = square.sqrt().max(f32::MIN_POSITIVE);
    let lit = |slope: &f32| [(GREY + CONTRAST * slope / rms).clamp(0.0, 255.0) as u8; 3];
    let pixels: Vec<[u8; 3]> = slopes.iter().map(lit).collect();
    asperity_preview::compact_png(&pixels, size_px, &[]).map_err(crate::views::preview::not_encoded)
}
