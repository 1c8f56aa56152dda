//! A panel: two axes that span a rectangle of the canvas.
//!
//! This file has its layout. What is drawn is in `frame.rs` (title, ticks, labels),
//! `data.rs`, `series.rs` and `colorbar.rs`.

use crate::axis::Axis;
use crate::rect::Rect;

/// Space around the plotted area, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margins {
    /// For tick numbers and the label of the vertical axis.
    pub left: f32,
    /// For a colour bar, where there is one.
    pub right: f32,
    /// For the title.
    pub top: f32,
    /// For tick numbers and the label of the horizontal axis.
    pub bottom: f32,
}

impl Default for Margins {
    fn default() -> Self {
        Self {
            left: 120.0,
            right: 24.0,
            top: 64.0,
            bottom: 88.0,
        }
    }
}

/// Two axes on a rectangle of the canvas.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The rectangle with all margins.
    pub outer: Rect,
    /// Space around the plotted area.
    pub margins: Margins,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// True if light lines mark the ticks behind the data.
    pub grid: bool,
    pub(crate) letter: Option<char>,
    pub(crate) title: String,
}

impl Panel {
    /// A panel inside `outer`, with the default margins.
    #[must_use]
    pub fn new(outer: Rect, x: Axis, y: Axis) -> Self {
        Self {
            outer,
            margins: Margins::default(),
            x,
            y,
            grid: true,
            letter: None,
            title: String::new(),
        }
    }

    /// The same panel with a bold letter before its title.
    #[must_use]
    pub fn letter(self, letter: char) -> Self {
        Self {
            letter: Some(letter),
            ..self
        }
    }

    /// The same panel with a title.
    #[must_use]
    pub fn title(self, title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            ..self
        }
    }

    /// The same panel with other margins.
    #[must_use]
    pub fn margins(self, margins: Margins) -> Self {
        Self { margins, ..self }
    }

    /// The same panel without lines at the ticks.
    #[must_use]
    pub fn without_grid(self) -> Self {
        Self {
            grid: false,
            ..self
        }
    }

    /// The rectangle that holds the data.
    #[must_use]
    pub fn area(&self) -> Rect {
        let margins = &self.margins;
        Rect::new(
            self.outer.x + margins.left,
            self.outer.y + margins.top,
            (self.outer.width - margins.left - margins.right).max(1.0),
            (self.outer.height - margins.top - margins.bottom).max(1.0),
        )
    }

    /// Pixel position of a point in data coordinates.
    #[must_use]
    pub fn position(&self, x: f64, y: f64) -> (f32, f32) {
        let area = self.area();
        (
            area.x + area.width * self.x.fraction(x) as f32,
            area.bottom() - area.height * self.y.fraction(y) as f32,
        )
    }
}
