//! Lines of text.

use tiny_skia::{FillRule, Transform};

use crate::canvas::{Canvas, paint};
use crate::pixel::snap;
use crate::text_style::{Align, TextStyle, VAlign};

/// Height of DejaVu's capitals relative to the em square.
const CAP_HEIGHT: f32 = 0.729;

impl Canvas {
    /// Width of a line of text, pixels.
    #[must_use]
    pub fn text_width(&self, text: &str, style: &TextStyle) -> f32 {
        let text = self.fonts.readable(text, style.bold);
        self.fonts.width(&text, style.bold, style.size)
    }

    /// The longest beginning of `text` that fits `max_width` pixels; an ellipsis marks a cut.
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

    /// Sets one line of text with its anchor at a point. What the embedded type face cannot set is
    /// spelt in Latin letters.
    pub fn text(&mut self, text: &str, (x, y): (f32, f32), style: &TextStyle) {
        if !(x.is_finite() && y.is_finite()) {
            return;
        }
        let text = &*self.fonts.readable(text, style.bold);
        let width = self.fonts.width(text, style.bold, style.size);
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
}
