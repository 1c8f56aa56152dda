//! A legend: keys and their names, from left to right.

use crate::canvas::Canvas;
use crate::color::{Color, ink};
use crate::marker::Marker;
use crate::panel::Panel;
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

/// Space between two entries, pixels.
const BETWEEN: f32 = 28.0;

/// Sets keys and names from left to right and returns the position of the right end.
///
/// `at` is the left end, at half the height of the text. An entry that would pass `right` begins
/// a line below.
pub fn legend(canvas: &mut Canvas, at: (f32, f32), right: f32, entries: &[(Key, &str)]) -> f32 {
    let rows = rows(canvas, right - at.0, entries);
    let mut end = at.0;
    let mut y = at.1;
    for row in rows {
        end = draw(canvas, (at.0, y), row);
        y += size::LEGEND_ROW;
    }
    end
}

impl Panel {
    /// The same panel with a top margin for this many lines of a legend.
    #[must_use]
    pub fn with_legend(mut self, lines: usize) -> Self {
        self.margins.top = 82.0 + size::LEGEND_ROW * lines as f32;
        self
    }

    /// Lines that a legend of these entries takes.
    #[must_use]
    pub fn legend_lines(&self, canvas: &Canvas, entries: &[(Key, &str)]) -> usize {
        rows(canvas, self.area().width, entries).len()
    }

    /// Sets keys and names between the title and the frame. Where one line is too short, further
    /// ones stand above it; [`Panel::with_legend`] makes room.
    pub fn legend(&self, canvas: &mut Canvas, entries: &[(Key, &str)]) {
        let area = self.area();
        let rows = rows(canvas, area.width, entries);
        let mut y = area.y - 22.0 - size::LEGEND_ROW * (rows.len() as f32 - 1.0);
        for row in rows {
            draw(canvas, (area.x, y), row);
            y += size::LEGEND_ROW;
        }
    }
}

impl Panel {
    /// Draws data as a key shows it: a line through the points, or a marker at each.
    pub fn keyed(
        &self,
        canvas: &mut Canvas,
        points: impl IntoIterator<Item = (f64, f64)>,
        key: Key,
    ) {
        match key {
            Key::Line(stroke) => self.line(canvas, points, stroke),
            Key::Point(marker, radius, fill, outline) => {
                self.points(canvas, points, marker, radius, fill, outline);
            }
            Key::Text => {}
        }
    }
}

fn style() -> TextStyle {
    TextStyle::new(size::TICK)
        .color(ink::GREY)
        .align(Align::Left, VAlign::Middle)
}

fn key_width(key: &Key) -> f32 {
    match key {
        Key::Line(_) => 44.0,
        Key::Point(_, radius, ..) => 2.0 * radius + 10.0,
        Key::Text => 0.0,
    }
}

/// The entries in lines no wider than `width`, one at least in each.
fn rows<'a, 'b>(
    canvas: &Canvas,
    width: f32,
    entries: &'a [(Key, &'b str)],
) -> Vec<&'a [(Key, &'b str)]> {
    let style = style();
    let mut rows = Vec::new();
    let (mut from, mut x) = (0, 0.0);
    for (index, (key, name)) in entries.iter().enumerate() {
        let own = key_width(key) + canvas.text_width(name, &style);
        if index > from && x + own > width {
            rows.push(&entries[from..index]);
            (from, x) = (index, 0.0);
        }
        x += own + BETWEEN;
    }
    rows.push(&entries[from..]);
    rows
}

/// Draws one line and returns its right end.
fn draw(canvas: &mut Canvas, (mut x, y): (f32, f32), entries: &[(Key, &str)]) -> f32 {
    let style = style();
    for (key, name) in entries {
        match *key {
            Key::Line(stroke) => canvas.line(&[(x, y), (x + 34.0, y)], stroke, None),
            Key::Point(marker, radius, fill, outline) => {
                canvas.marker((x + radius, y), marker, radius, fill, outline);
            }
            Key::Text => {}
        }
        canvas.text(name, (x + key_width(key), y), &style);
        x += key_width(key) + canvas.text_width(name, &style) + BETWEEN;
    }
    x - BETWEEN
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{axis::Axis, rect::Rect};

    /// Claim: no entry is left out, however narrow the panel, and none passes its frame unless it
    /// is wider by itself.
    #[test]
    fn every_entry_is_drawn() {
        let names = [
            "recorded",
            "texture",
            "sensor in the air",
            "a name that is rather long",
        ];
        let entries = names.map(|name| (Key::Line(Stroke::new(ink::BLUE, 2.0)), name));
        for width in [200.0, 420.0, 700.0, 1600.0] {
            let mut canvas = Canvas::new(1600, 400).expect("a canvas");
            let axis = || Axis::new("", 0.0, 1.0);
            let panel = Panel::new(Rect::new(0.0, 0.0, width, 400.0), axis(), axis());
            let area = panel.area();
            let rows = rows(&canvas, area.width, &entries);
            for row in &rows {
                let end = draw(&mut canvas, (0.0, 0.0), row);
                assert!(row.len() == 1 || end <= area.width);
            }
            assert_eq!(rows.concat(), entries, "{width} px leave out a name");
            let mut canvas = Canvas::new(1600, 400).expect("a canvas");
            panel.legend(&mut canvas, &entries);
            let mut expected = Canvas::new(1600, 400).expect("a canvas");
            for (row, above) in rows.iter().rev().zip(0_u8..) {
                let y = area.y - 22.0 - size::LEGEND_ROW * f32::from(above);
                draw(&mut expected, (area.x, y), row);
            }
            assert!(canvas.png().unwrap() == expected.png().unwrap(), "{width}");
        }
    }
}
