//! A picture of pixels, and its PNG.
//!
//! Everything that is drawn comes down to three operations: to fill a rectangle, to fill a
//! path and to stroke a path. Shapes, markers and text are built on them in files of their own.

use tiny_skia::{FillRule, LineCap, LineJoin, Paint, Path, Pixmap, StrokeDash, Transform};

use crate::color::Color;
use crate::error::PlotError;
use crate::font::Fonts;
use crate::rect::Rect;
use crate::stroke::Stroke;

const MAX_SIDE_PX: u32 = 16_384;

/// A white picture to draw on; the origin is its upper left corner.
pub struct Canvas {
    pub(crate) pixmap: Pixmap,
    pub(crate) fonts: Fonts,
}

impl Canvas {
    /// A white canvas.
    ///
    /// # Errors
    /// [`PlotError::CanvasSize`] for a side of 0 or above 16384 pixels.
    pub fn new(width_px: u32, height_px: u32) -> Result<Self, PlotError> {
        let refused = PlotError::CanvasSize {
            width_px,
            height_px,
        };
        if width_px > MAX_SIDE_PX || height_px > MAX_SIDE_PX {
            return Err(refused);
        }
        let mut pixmap = Pixmap::new(width_px, height_px).ok_or(refused)?;
        pixmap.fill(tiny_skia::Color::WHITE);
        Ok(Self {
            pixmap,
            fonts: Fonts::embedded()?,
        })
    }

    /// The rectangle of the whole canvas, pixels.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect::new(
            0.0,
            0.0,
            self.pixmap.width() as f32,
            self.pixmap.height() as f32,
        )
    }

    /// Fills a rectangle, its edges on whole pixels.
    pub fn fill_rect(&mut self, rect: Rect, color: Color) {
        let (width, height) = (self.pixmap.width(), self.pixmap.height());
        // The conversion to an integer saturates, which cuts off what lies outside.
        let (left, right) = (rect.x.round() as u32, rect.right().round() as u32);
        let (top, bottom) = (rect.y.round() as u32, rect.bottom().round() as u32);
        let (right, bottom) = (right.min(width), bottom.min(height));
        if left >= right {
            return;
        }
        let opacity = u32::from(color.a);
        let opaque = [color.r, color.g, color.b, 255];
        let pixels = self.pixmap.data_mut();
        for y in top..bottom {
            let start = 4 * (y * width + left) as usize;
            let end = 4 * (y * width + right) as usize;
            for pixel in pixels[start..end].chunks_exact_mut(4) {
                if opacity == 255 {
                    pixel.copy_from_slice(&opaque);
                    continue;
                }
                for (channel, ink) in pixel.iter_mut().zip([color.r, color.g, color.b]) {
                    let mixed = u32::from(ink) * opacity + u32::from(*channel) * (255 - opacity);
                    *channel = ((mixed + 127) / 255) as u8;
                }
            }
        }
    }

    /// The picture as an 8-bit RGB PNG.
    ///
    /// # Errors
    /// [`PlotError::Png`] if the encoder fails.
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let rgb: Vec<u8> = self
            .pixmap
            .data()
            .chunks_exact(4)
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
            .collect();
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.pixmap.width(), self.pixmap.height());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&rgb)?;
        writer.finish()?;
        Ok(bytes)
    }

    pub(crate) fn fill_path(&mut self, path: &Path, color: Color) {
        self.pixmap.fill_path(
            path,
            &paint(color),
            FillRule::Winding,
            Transform::identity(),
            None,
        );
    }

    pub(crate) fn stroke_path(&mut self, path: &Path, stroke: Stroke, line_join: LineJoin) {
        let pen = tiny_skia::Stroke {
            width: stroke.width,
            line_cap: LineCap::Butt,
            line_join,
            dash: stroke
                .dash
                .and_then(|dash| StrokeDash::new(dash.to_vec(), 0.0)),
            ..tiny_skia::Stroke::default()
        };
        self.pixmap.stroke_path(
            path,
            &paint(stroke.color),
            &pen,
            Transform::identity(),
            None,
        );
    }
}

/// Returns the `tiny_skia` paint of a colour, with smooth edges.
pub(crate) fn paint(color: Color) -> Paint<'static> {
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    paint.set_color_rgba8(color.r, color.g, color.b, color.a);
    paint
}
