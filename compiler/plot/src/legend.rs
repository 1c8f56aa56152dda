//! A legend: keys and their names on one line.

use crate::canvas::Canvas;
use crate::color::{Color, ink};
use crate::marker::Marker;
use crate::size;
use crate::stroke::Stroke;
use crate::text_style::{Align, TextStyle, VAlign};

/// The sign that stands before a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Key {
    /// A piece of a line.
    Line(Stroke),
    /// A data point: shape, radius, fill and outline.
    Point(Marker, f32, Option<Color>, Option<Stroke>),
    /// No sign: the name is a remark.
    Text,
}

/// Sets keys and names from left to right and returns the position of the right end.
///
/// `at` is the left end, at half the height of the text. Entries that would pass `right` are
/// left out.
pub fn legend(canvas: &mut Canvas, at: (f32, f32), right: f32, entries: &[(Key, &str)]) -> f32 {
    let style = TextStyle::new(size::TICK)
        .color(ink::GREY)
        .align(Align::Left, VAlign::Middle);
    let mut x = at.0;
    for (key, name) in entries {
        let key_width = match key {
            Key::Line(_) => 44.0,
            Key::Point(_, radius, ..) => 2.0 * radius + 10.0,
            Key::Text => 0.0,
        };
        let width = key_width + canvas.text_width(name, &style);
        if x + width > right {
            break;
        }
        match *key {
            Key::Line(stroke) => canvas.line(&[(x, at.1), (x + 34.0, at.1)], stroke, None),
            Key::Point(marker, radius, fill, outline) => {
                canvas.marker((x + radius, at.1), marker, radius, fill, outline);
            }
            Key::Text => {}
        }
        canvas.text(name, (x + key_width, at.1), &style);
        x += width + 28.0;
    }
    x - 28.0
}
