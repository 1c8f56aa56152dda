//! Data points.

use tiny_skia::{LineJoin, PathBuilder};

use crate::canvas::Canvas;
use crate::color::Color;
use crate::pixel::{polygon, snap};
use crate::stroke::Stroke;

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

impl Marker {
    /// The shape of category `index`, counted from 0; four repeat.
    #[must_use]
    pub const fn category(index: usize) -> Self {
        const SHAPES: [Marker; 4] = [
            Marker::Circle,
            Marker::Square,
            Marker::Triangle,
            Marker::Diamond,
        ];
        SHAPES[index % SHAPES.len()]
    }
}

impl Canvas {
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
}
