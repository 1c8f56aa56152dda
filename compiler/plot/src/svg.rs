//! The picture as SVG, recorded one element at a time while it is drawn.
//!
//! Text stays text. A viewer that has the embedded type face uses it. Every line of text
//! states its width, so another face takes the same place.

use std::fmt::Write as _;

use tiny_skia::{Path, PathSegment};

use crate::color::Color;
use crate::rect::Rect;
use crate::stroke::Stroke;
use crate::text_style::TextStyle;

/// The elements so far.
pub(crate) struct Recorder(String);

impl Recorder {
    pub(crate) fn new() -> Self {
        Self(String::new())
    }

    pub(crate) fn rect(&mut self, rect: Rect, color: Color) {
        self.element(format_args!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" {}/>",
            rect.x,
            rect.y,
            rect.width,
            rect.height,
            Paint("fill", color)
        ));
    }

    pub(crate) fn fill(&mut self, path: &Path, color: Color) {
        self.element(format_args!(
            "<path d=\"{}\" {}/>",
            Data(path),
            Paint("fill", color)
        ));
    }

    pub(crate) fn stroke(&mut self, path: &Path, stroke: Stroke) {
        let dash = stroke.dash.map_or(String::new(), |[dash, gap]| {
            format!(" stroke-dasharray=\"{dash} {gap}\"")
        });
        self.element(format_args!(
            "<path d=\"{}\" fill=\"none\" {} stroke-width=\"{}\"{dash}/>",
            Data(path),
            Paint("stroke", stroke.color),
            stroke.width
        ));
    }

    /// A line of text whose baseline begins at a point.
    pub(crate) fn text(&mut self, text: &str, (x, y): (f32, f32), style: &TextStyle, width: f32) {
        let size = style.size;
        let weight = if style.bold {
            " font-weight=\"bold\""
        } else {
            ""
        };
        let turn = if style.upwards { " rotate(-90)" } else { "" };
        let escaped = text
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        self.element(format_args!(
            "<text transform=\"translate({x:.2} {y:.2}){turn}\" font-size=\"{size}\"{weight} \
             textLength=\"{width:.1}\" {}>{escaped}</text>",
            Paint("fill", style.color)
        ));
    }

    /// The whole document, for a picture of `width × height` pixels.
    pub(crate) fn document(&self, width: u32, height: u32) -> String {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             font-family=\"DejaVu Sans, Verdana, sans-serif\" xml:space=\"preserve\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n{}</svg>\n",
            self.0
        )
    }

    fn element(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{element}");
    }
}

/// A fill or a stroke as attributes.
struct Paint(&'static str, Color);

impl std::fmt::Display for Paint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(what, Color { r, g, b, a }) = self;
        write!(f, "{what}=\"#{r:02x}{g:02x}{b:02x}\"")?;
        if *a < 255 {
            write!(f, " {what}-opacity=\"{:.3}\"", f32::from(*a) / 255.0)?;
        }
        Ok(())
    }
}

/// The outline of a path.
struct Data<'a>(&'a Path);

impl std::fmt::Display for Data<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for segment in self.0.segments() {
            match segment {
                PathSegment::MoveTo(p) => write!(f, "M{:.2} {:.2}", p.x, p.y)?,
                PathSegment::LineTo(p) => write!(f, "L{:.2} {:.2}", p.x, p.y)?,
                PathSegment::QuadTo(c, p) => {
                    write!(f, "Q{:.2} {:.2} {:.2} {:.2}", c.x, c.y, p.x, p.y)?;
                }
                PathSegment::CubicTo(c, d, p) => write!(
                    f,
                    "C{:.2} {:.2} {:.2} {:.2} {:.2} {:.2}",
                    c.x, c.y, d.x, d.y, p.x, p.y
                )?,
                PathSegment::Close => f.write_str("Z")?,
            }
        }
        Ok(())
    }
}
