//! An RGB picture: lines, areas, markers and text in pixels, and its PNG bytes.

use tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform,
};

use super::color::{Color, ink};
use super::font::Fonts;
use super::geometry::{Rect, clip_polyline};
use super::svg::Recorder;
use super::{PlotError, size};

const MAX_SIDE_PX: u32 = 16_384;

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub color: Color,
    /// Its width, pixels.
    pub width: f32,
    /// Lengths of dash and gap, pixels; solid if absent.
    pub dash: Option<[f32; 2]>,
}

impl Stroke {
    /// A solid line.
    #[must_use]
    pub const fn new(color: Color, width: f32) -> Self {
        Self {
            color,
            width,
            dash: None,
        }
    }

    /// The same line, dashed.
    #[must_use]
    pub const fn dashed(self) -> Self {
        Self {
            dash: Some([10.0, 7.0]),
            ..self
        }
    }

    /// The same line, dotted.
    #[must_use]
    pub const fn dotted(self) -> Self {
        Self {
            dash: Some([3.0, 5.0]),
            ..self
        }
    }
}

/// The shape of a data point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Circle,
    /// A square.
    Square,
    /// A square on its corner.
    Diamond,
    /// A diagonal cross, drawn by its stroke alone.
    Cross,
    /// A triangle pointing downwards.
    Triangle,
}

/// Where text stands relative to its anchor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// The text begins at the anchor.
    Left,
    /// The text is centred on the anchor.
    Center,
    /// The text ends at the anchor.
    Right,
}

/// Which height of the text stands at its anchor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VAlign {
    /// The top of capitals.
    Top,
    /// Half the height of capitals.
    Middle,
    /// The baseline.
    Baseline,
}

/// How text is set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextStyle {
    /// Size of the em square, pixels.
    pub size: f32,
    /// Bold instead of regular.
    pub bold: bool,
    /// Its colour.
    pub color: Color,
    /// Placement along the line.
    pub align: Align,
    /// Placement across the line.
    pub valign: VAlign,
    /// Reading upwards, as the label of a vertical axis.
    pub upwards: bool,
}

impl TextStyle {
    /// Black, regular, left, on the baseline.
    #[must_use]
    pub const fn new(size: f32) -> Self {
        Self {
            size,
            bold: false,
            color: ink::BLACK,
            align: Align::Left,
            valign: VAlign::Baseline,
            upwards: false,
        }
    }

    /// The same in bold.
    #[must_use]
    pub const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// The same in another colour.
    #[must_use]
    pub const fn color(self, color: Color) -> Self {
        Self { color, ..self }
    }

    /// The same with another placement.
    #[must_use]
    pub const fn align(self, align: Align, valign: VAlign) -> Self {
        Self {
            align,
            valign,
            ..self
        }
    }

    /// The same, reading upwards.
    #[must_use]
    pub const fn upwards(self) -> Self {
        Self {
            upwards: true,
            ..self
        }
    }
}

impl Default for TextStyle {
    fn default() -> Self {
        Self::new(size::TICK)
    }
}

/// A white picture to draw on; the origin is its upper left corner.
pub struct Canvas {
    pixmap: Pixmap,
    fonts: Fonts,
    svg: Option<Recorder>,
}

/// Height of DejaVu's capitals relative to the em square.
const CAP_HEIGHT: f32 = 0.729;

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
            svg: None,
        })
    }

    /// A white canvas that also writes down what is drawn, for [`Canvas::svg`].
    ///
    /// # Errors
    /// As [`Canvas::new`].
    pub fn recording(width_px: u32, height_px: u32) -> Result<Self, PlotError> {
        Ok(Self {
            svg: Some(Recorder::new()),
            ..Self::new(width_px, height_px)?
        })
    }

    /// The picture as SVG; `None` of a canvas that was not [recording](Canvas::recording).
    #[must_use]
    pub fn svg(&self) -> Option<String> {
        let recorder = self.svg.as_ref()?;
        Some(recorder.document(self.pixmap.width(), self.pixmap.height()))
    }

    /// The whole canvas.
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
        // A float converts to an integer by saturation: what lies outside is cut.
        let (left, right) = (rect.x.round() as u32, rect.right().round() as u32);
        let (top, bottom) = (rect.y.round() as u32, rect.bottom().round() as u32);
        let (right, bottom) = (right.min(width), bottom.min(height));
        if left >= right {
            return;
        }
        if let Some(svg) = &mut self.svg {
            svg.rect(rect, color);
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

    /// Draws the border of a rectangle.
    pub fn stroke_rect(&mut self, rect: Rect, stroke: Stroke) {
        let (x0, y0) = (crisp(rect.x), crisp(rect.y));
        let (x1, y1) = (crisp(rect.right()), crisp(rect.bottom()));
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        if let Some(path) = polygon(&corners) {
            self.stroke_path(&path, stroke, LineJoin::Miter);
        }
    }

    /// Draws a polyline, cut at `clip`; a point that is not finite leaves a gap.
    pub fn line(&mut self, points: &[(f32, f32)], stroke: Stroke, clip: Option<&Rect>) {
        let mut builder = PathBuilder::new();
        for piece in clip_polyline(points, clip) {
            for (index, &(x, y)) in piece.iter().enumerate() {
                if index == 0 {
                    builder.move_to(snap(x), snap(y));
                } else {
                    builder.line_to(snap(x), snap(y));
                }
            }
        }
        if let Some(path) = builder.finish() {
            self.stroke_path(&path, stroke, LineJoin::Round);
        }
    }

    /// Fills a polygon; points that are not finite are left out.
    pub fn fill_polygon(&mut self, points: &[(f32, f32)], color: Color) {
        if let Some(path) = polygon(points) {
            self.fill_path(&path, color);
        }
    }

    /// Draws a data point of the given radius.
    pub fn marker(
        &mut self,
        (x, y): (f32, f32),
        marker: Marker,
        radius: f32,
        fill: Option<Color>,
        outline: Option<Stroke>,
    ) {
        if !(x.is_finite() && y.is_finite()) {
            return;
        }
        let (x, y) = (snap(x), snap(y));
        let half = radius * 0.886; // equal area with the disc
        let path = match marker {
            Marker::Circle => PathBuilder::from_circle(x, y, radius),
            Marker::Square => polygon(&[
                (x - half, y - half),
                (x + half, y - half),
                (x + half, y + half),
                (x - half, y + half),
            ]),
            Marker::Diamond => {
                let half = radius * 1.253;
                polygon(&[(x, y - half), (x + half, y), (x, y + half), (x - half, y)])
            }
            Marker::Triangle => polygon(&[
                (x - radius, y - half),
                (x + radius, y - half),
                (x, y + radius),
            ]),
            Marker::Cross => {
                let mut builder = PathBuilder::new();
                builder.move_to(x - half, y - half);
                builder.line_to(x + half, y + half);
                builder.move_to(x - half, y + half);
                builder.line_to(x + half, y - half);
                builder.finish()
            }
        };
        let Some(path) = path else { return };
        if let Some(color) = fill {
            self.fill_path(&path, color);
        }
        if let Some(stroke) = outline {
            self.stroke_path(&path, stroke, LineJoin::Miter);
        }
    }

    /// Fills `rect` with `columns × rows` cells; row 0 is the lowest.
    pub fn cells(
        &mut self,
        rect: Rect,
        columns: usize,
        rows: usize,
        color: impl Fn(usize, usize) -> Option<Color>,
    ) {
        let edge =
            |start: f32, length: f32, i: usize, n: usize| start + length * i as f32 / n as f32;
        for row in 0..rows {
            let bottom = rect.bottom() - edge(0.0, rect.height, row, rows);
            let top = rect.bottom() - edge(0.0, rect.height, row + 1, rows);
            for column in 0..columns {
                let left = edge(rect.x, rect.width, column, columns);
                let right = edge(rect.x, rect.width, column + 1, columns);
                if let Some(color) = color(column, row) {
                    self.fill_rect(Rect::new(left, top, right - left, bottom - top), color);
                }
            }
        }
    }

    /// Width of a line of text, pixels.
    #[must_use]
    pub fn text_width(&self, text: &str, style: &TextStyle) -> f32 {
        self.fonts.width(text, style.bold, style.size)
    }

    /// The longest beginning of `text` that fits `max_width`, with an ellipsis if cut.
    #[must_use]
    pub fn fitted(&self, text: &str, style: &TextStyle, max_width: f32) -> String {
        if self.text_width(text, style) <= max_width {
            return text.to_owned();
        }
        let mut kept = text.to_owned();
        while kept.pop().is_some() {
            let cut = format!("{}…", kept.trim_end());
            if self.text_width(&cut, style) <= max_width {
                return cut;
            }
        }
        String::new()
    }

    /// Sets one line of text.
    pub fn text(&mut self, text: &str, (x, y): (f32, f32), style: &TextStyle) {
        if !(x.is_finite() && y.is_finite()) {
            return;
        }
        let width = self.text_width(text, style);
        let along = match style.align {
            Align::Left => 0.0,
            Align::Center => -0.5 * width,
            Align::Right => -width,
        };
        let across = style.size
            * CAP_HEIGHT
            * match style.valign {
                VAlign::Top => 1.0,
                VAlign::Middle => 0.5,
                VAlign::Baseline => 0.0,
            };
        let placed = if style.upwards {
            Transform::from_row(0.0, -1.0, 1.0, 0.0, (x + across).round(), snap(y - along))
        } else {
            Transform::from_translate(snap(x + along), (y + across).round())
        };
        if let Some(svg) = &mut self.svg {
            let looks = (style.size, style.bold, style.upwards);
            svg.text(text, (placed.tx, placed.ty), looks, width, style.color);
        }
        if let Some(outline) = self.fonts.outline(text, style.bold, style.size) {
            self.pixmap.fill_path(
                &outline,
                &paint(style.color),
                FillRule::Winding,
                placed,
                None,
            );
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

    fn fill_path(&mut self, path: &Path, color: Color) {
        if let Some(svg) = &mut self.svg {
            svg.fill(path, color);
        }
        self.pixmap.fill_path(
            path,
            &paint(color),
            FillRule::Winding,
            Transform::identity(),
            None,
        );
    }

    fn stroke_path(&mut self, path: &Path, stroke: Stroke, line_join: LineJoin) {
        if let Some(svg) = &mut self.svg {
            svg.stroke(path, stroke);
        }
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

fn paint(color: Color) -> Paint<'static> {
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    paint.set_color_rgba8(color.r, color.g, color.b, color.a);
    paint
}

fn polygon(points: &[(f32, f32)]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for &(x, y) in points
        .iter()
        .filter(|(x, y)| x.is_finite() && y.is_finite())
    {
        if builder.is_empty() {
            builder.move_to(snap(x), snap(y));
        } else {
            builder.line_to(snap(x), snap(y));
        }
    }
    builder.close();
    builder.finish()
}

/// Rounds to 1/64 px, so that differences of a float's last bits cannot show.
fn snap(position: f32) -> f32 {
    (position * 64.0).round() / 64.0
}

/// The nearest pixel centre, where a thin line is sharp.
pub(super) fn crisp(position: f32) -> f32 {
    position.floor() + 0.5
}
