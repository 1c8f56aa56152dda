//! How a line is drawn.

use crate::color::Color;

/// Colour, width and dashes of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub color: Color,
    /// Its width, pixels.
    pub width: f32,
    /// Lengths of dash and gap, pixels; `None` for a solid line.
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
