//! The same picture as SVG: what is drawn is written down as it goes.
//!
//! Text stays text, in the embedded face where the reader has it; its width is given, so
//! that another face takes the same place.

use super::canvas::Stroke;
use super::color::Color;
use super::geometry::Rect;
use std::fmt::Write as _;
use tiny_skia::{Path, PathSegment};

/// The elements so far.
pub(super) struct Recorder(String);

impl Recorder {
    pub(super) fn new() -> Self {
        Self(String::new())
    }

    pub(super) fn rect(&mut self, rect: Rect, color: Color) {
        self.element(format_args!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" {}/>",
            rect.x,
            rect.y,
            rect.width,
            rect.height,
            Paint("fill", color)
        ));
    }

    pub(super) fn fill(&mut self, path: &Path, color: Color) {
        self.element(format_args!(
            "<path d=\"{}\" {}/>",
            Data(path),
            Paint("fill", color)
        ));
    }

    pub(super) fn stroke(&mut self, path: &Path, stroke: Stroke) {
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
    pub(super) fn text(
        &mut self,
        text: &str,
        (x, y): (f32, f32),
        (size, bold, upwards): (f32, bool, bool),
        width: f32,
        color: Color,
    ) {
        let weight = if bold { " font-weight=\"bold\"" } else { "" };
        let turn = if upwards { " rotate(-90)" } else { "" };
        let escaped = text
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;");
        self.element(format_args!(
            "<text transform=\"translate({x:.2} {y:.2}){turn}\" font-size=\"{size}\"{weight} \
             textLength=\"{width:.1}\" {}>{escaped}</text>",
            Paint("fill", color)
        ));
    }

    /// The whole document.
    pub(super) fn document(&self, width: u32, height: u32) -> String {
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

#[cfg(test)]
mod tests {
    use super::super::{Canvas, Marker, TextStyle, ink};
    use super::*;

    #[test]
    fn what_is_drawn_is_written_down_as_well_formed_xml() {
        let mut canvas = Canvas::recording(200, 100).unwrap();
        canvas.line(
            &[(0.0, 0.0), (50.0, 20.0), (90.0, 5.0)],
            Stroke::new(ink::BLUE, 2.0).dashed(),
            None,
        );
        canvas.marker(
            (60.0, 60.0),
            Marker::Circle,
            8.0,
            Some(ink::GREEN.alpha(128)),
            None,
        );
        canvas.fill_rect(Rect::new(5.0, 70.0, 30.0, 10.0), ink::GRID);
        canvas.text(
            "a < b & c, 1 + z⁻¹",
            (100.0, 50.0),
            &TextStyle::new(20.0).upwards(),
        );
        let svg = canvas.svg().unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let count = |name| {
            document
                .descendants()
                .filter(|n| n.has_tag_name(("http://www.w3.org/2000/svg", name)))
                .count()
        };
        assert_eq!((count("path"), count("rect"), count("text")), (2, 2, 1));
        let text = document
            .descendants()
            .find(|n| n.is_text() && n.text().unwrap().contains('z'));
        assert_eq!(text.unwrap().text(), Some("a < b & c, 1 + z⁻¹"));
        assert!(Canvas::new(10, 10).unwrap().svg().is_none());
    }
}
