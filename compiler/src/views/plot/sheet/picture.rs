//! The preview in the corner of the header.

use crate::views::preview::Stored;
use asperity_plot::{Canvas, Color, Rect};

/// Width and height on the sheet, pixels.
pub(super) const SIDE: f32 = 154.0;

/// Draws the picture at (x, y), each pixel the mean of those that it stands for.
pub(super) fn draw(canvas: &mut Canvas, (x, y): (f32, f32), picture: &Stored) {
    let side = SIDE as usize;
    let (width, height) = (picture.width as usize, picture.height as usize);
    if width == 0 || height == 0 || picture.rgb.len() < 3 * width * height {
        return;
    }
    let span = |k: usize, length: usize| {
        let first = k * length / side;
        first..((k + 1) * length / side).max(first + 1)
    };
    for row in 0..side {
        for column in 0..side {
            let (mut sum, mut count) = ([0u32; 3], 0);
            for py in span(row, height) {
                for px in span(column, width) {
                    let pixel = &picture.rgb[3 * (py * width + px)..][..3];
                    for (sum, channel) in sum.iter_mut().zip(pixel) {
                        *sum += u32::from(*channel);
                    }
                    count += 1;
                }
            }
            let [r, g, b] = sum.map(|sum| (sum / count) as u8);
            let dot = Rect::new(x + column as f32, y + row as f32, 1.0, 1.0);
            canvas.fill_rect(dot, Color { r, g, b, a: 255 });
        }
    }
}
