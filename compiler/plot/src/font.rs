//! The embedded type face, DejaVu Sans: outlines, advances and kerning.

use std::borrow::Cow;

use tiny_skia::{Path, PathBuilder};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use crate::error::PlotError;
use crate::readable::readable;

/// The type face, regular and bold.
pub(crate) struct Fonts {
    regular: Face<'static>,
    bold: Face<'static>,
}

impl Fonts {
    pub(crate) fn embedded() -> Result<Self, PlotError> {
        let face = |bytes| Face::parse(bytes, 0).map_err(PlotError::Font);
        Ok(Self {
            regular: face(dejavu::sans::regular())?,
            bold: face(dejavu::sans::bold())?,
        })
    }

    fn face(&self, bold: bool) -> &Face<'static> {
        if bold { &self.bold } else { &self.regular }
    }

    /// The text as it is drawn: what the type face cannot set is spelt in Latin letters.
    pub(crate) fn readable<'a>(&self, text: &'a str, bold: bool) -> Cow<'a, str> {
        let face = self.face(bold);
        readable(text, |c| face.glyph_index(c).is_some())
    }

    /// Width of a line of text at `size_px`, pixels.
    pub(crate) fn width(&self, text: &str, bold: bool, size_px: f32) -> f32 {
        let face = self.face(bold);
        layout(face, text, |_, _| {}) * scale(face, size_px)
    }

    /// The outline of a line of text, its baseline starting at the origin, y downwards.
    pub(crate) fn outline(&self, text: &str, bold: bool, size_px: f32) -> Option<Path> {
        let face = self.face(bold);
        let scale = scale(face, size_px);
        let mut pen = Pen {
            path: PathBuilder::new(),
            x: 0.0,
            scale,
        };
        layout(face, text, |glyph, x| {
            pen.x = x * scale;
            face.outline_glyph(glyph, &mut pen);
        });
        pen.path.finish()
    }
}

fn scale(face: &Face<'_>, size_px: f32) -> f32 {
    size_px / f32::from(face.units_per_em())
}

/// Visits the glyphs with their positions and returns the total advance, in font units.
fn layout(face: &Face<'_>, text: &str, mut visit: impl FnMut(GlyphId, f32)) -> f32 {
    let mut x = 0.0;
    let mut previous = None;
    for character in text.chars().filter(|c| !c.is_control()) {
        let glyph = face.glyph_index(character).unwrap_or_default();
        if let Some(left) = previous {
            x += kerning(face, left, glyph);
        }
        visit(glyph, x);
        x += f32::from(face.glyph_hor_advance(glyph).unwrap_or_default());
        previous = Some(glyph);
    }
    x
}

fn kerning(face: &Face<'_>, left: GlyphId, right: GlyphId) -> f32 {
    face.tables()
        .kern
        .into_iter()
        .flat_map(|table| table.subtables)
        .filter(|subtable| subtable.horizontal && !subtable.variable)
        .find_map(|subtable| subtable.glyphs_kerning(left, right))
        .map_or(0.0, f32::from)
}

struct Pen {
    path: PathBuilder,
    x: f32,
    scale: f32,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.scale, -y * self.scale)
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (x1, y1) = self.place(x1, y1);
        let (x, y) = self.place(x, y);
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (x1, y1) = self.place(x1, y1);
        let (x2, y2) = self.place(x2, y2);
        let (x, y) = self.place(x, y);
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
