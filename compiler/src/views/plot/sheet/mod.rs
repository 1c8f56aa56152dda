//! Data sheet of a texture: poles, spectra, taps, grid, friction and wall.

mod contact;
mod distinct;
mod grid;
mod header;
mod layout;
mod level;
mod poles;
mod press;
mod spectra;
mod taps;

pub use header::AssetBytes;

use crate::views::preview::Stored;
use asperity_plot::{Canvas, Color, PlotError, Rect, Stroke, ink};
use asperity_texture::model::{Direction, TextureModel};

/// Width of the sheet, pixels.
pub const WIDTH_PX: u32 = 2400;
/// Height of the sheet, pixels.
pub const HEIGHT_PX: u32 = 1600;

const HEADER_HEIGHT: f32 = 186.0;
const PICTURE_TOP: f32 = 24.0;
const PICTURE_MARGIN: f32 = 40.0;
const UPPER_HEIGHT: f32 = 670.0;
const LOWER_HEIGHT: f32 = 736.0;

/// Draws a texture and returns the bytes of a PNG.
///
/// `bytes` are the sizes of its asset, if there is one. Every model can be drawn, even one
/// without taps, anchors or any vibration. The same model gives the same bytes.
///
/// # Errors
/// [`PlotError`] if the embedded font or the PNG encoder fails.
pub fn sheet(model: &TextureModel, bytes: Option<AssetBytes>) -> Result<Vec<u8>, PlotError> {
    sheet_with_picture(model, bytes, None)
}

/// As [`sheet`], with the preview of the asset in the corner of the header, if there is one.
///
/// # Errors
/// As [`sheet`].
pub fn sheet_with_picture(
    model: &TextureModel,
    bytes: Option<AssetBytes>,
    picture: Option<&Stored>,
) -> Result<Vec<u8>, PlotError> {
    compose(model, bytes, picture)?.png()
}

fn compose(
    model: &TextureModel,
    bytes: Option<AssetBytes>,
    picture: Option<&Stored>,
) -> Result<Canvas, PlotError> {
    let mut canvas = Canvas::new(WIDTH_PX, HEIGHT_PX)?;
    let width = WIDTH_PX as f32;
    let mut header = Rect::new(0.0, 0.0, width, HEADER_HEIGHT);
    if let Some(picture) = picture {
        let left = width - SIDE - PICTURE_MARGIN;
        draw(&mut canvas, (left, PICTURE_TOP), picture);
        if let Some(direction) = &model.direction {
            let center = (left + 0.5 * SIDE, PICTURE_TOP + 0.5 * SIDE);
            arrow(&mut canvas, center, direction);
        }
        header.width = left;
    }
    header::draw(&mut canvas, header, model, bytes);

    let top = HEADER_HEIGHT;
    poles::draw(
        &mut canvas,
        Rect::new(0.0, top, 1150.0, UPPER_HEIGHT),
        &model.grid,
    );
    spectra::draw(
        &mut canvas,
        Rect::new(1150.0, top, width - 1150.0, UPPER_HEIGHT),
        &model.grid,
    );

    let top = top + UPPER_HEIGHT;
    taps::draw(
        &mut canvas,
        Rect::new(0.0, top, 830.0, LOWER_HEIGHT),
        &model.taps,
        model.provenance.taps_synthetic,
    );
    grid::draw(
        &mut canvas,
        Rect::new(830.0, top, 760.0, LOWER_HEIGHT),
        &model.grid,
    );
    contact::draw(
        &mut canvas,
        Rect::new(1590.0, top, width - 1590.0, LOWER_HEIGHT),
        model,
    );
    Ok(canvas)
}

#[cfg(test)]
mod tests;

// The preview in the corner of the header.

/// Width and height on the sheet, pixels.
const SIDE: f32 = 154.0;

/// Draws the axis over the picture, with a head at each end, or at the end to which a nap lies. The picture shows the plane
/// z = 0, x to the right and y upwards.
fn arrow(canvas: &mut Canvas, (x, y): (f32, f32), direction: &Direction) {
    let [right, up] = [direction.axis[0], direction.axis[1]].map(|part| 0.32 * SIDE * part as f32);
    let length = right.hypot(up);
    if length < 1.0 {
        return;
    }
    let (end, start) = ((x + right, y - up), (x - right, y + up));
    let (ahead, aside) = (
        (right / length, -up / length),
        (up / length, right / length),
    );
    let head = |(x, y): (f32, f32), way: f32| {
        [-1.0, 1.0].map(|side| {
            let back = (x - 14.0 * way * ahead.0, y - 14.0 * way * ahead.1);
            [
                (x, y),
                (back.0 + 9.0 * side * aside.0, back.1 + 9.0 * side * aside.1),
            ]
        })
    };
    let mut lines = vec![[start, end]];
    lines.extend(head(end, 1.0));
    if !direction.leans() {
        lines.extend(head(start, -1.0));
    }
    for (color, width) in [(ink::PAPER, 8.0), (ink::BLACK, 3.0)] {
        for line in &lines {
            canvas.line(line, Stroke::new(color, width), None);
        }
    }
}

/// Draws the picture at (x, y), each pixel the mean of those that it stands for.
fn draw(canvas: &mut Canvas, (x, y): (f32, f32), picture: &Stored) {
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
