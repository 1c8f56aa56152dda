//! Style of text.

use crate::color::{Color, ink};
use crate::size;

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

/// Size, weight, colour and placement of a line of text.
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
