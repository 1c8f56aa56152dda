//! Rectangles, polylines, polygons and tables of cells.

use tiny_skia::{LineJoin, PathBuilder};

use crate::canvas::Canvas;
use crate::clip::clip_polyline;
use crate::color::Color;
use crate::pixel::{crisp, polygon, snap};
use crate::rect::Rect;
use crate::stroke::Stroke;

impl Canvas {
    /// Draws the border of a rectangle.
    pub fn stroke_rect(&mut self, rect: Rect, stroke: Stroke) {
        let (x0, y0) = (crisp(rect.x), crisp(rect.y));
        let (x1, y1) = (crisp(rect.right()), crisp(rect.bottom()));
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        if let Some(path) = polygon(&corners) {
            self.stroke_path(&path, stroke, LineJoin::Miter);
        }
    }

    /// Draws a polyline, cut at `clip`. A point that is not finite leaves a gap.
    pub fn line(&mut self, points: &[(f32, f32)], stroke: Stroke, clip: Option<&Rect>) {
        let mut builder = PathBuilder::new();
        for piece in clip_polyline(points, clip) {
            for (index, &(x, y)) in piece.iter().enumerate() {
                if index == 0 {
                    builder.move_to(snap(x), snap(y));
                } else {
                    builder.line_to(snap(x), snap(y));
                }
            }
        }
        if let Some(path) = builder.finish() {
            self.stroke_path(&path, stroke, LineJoin::Round);
        }
    }

    /// Fills a polygon; points that are not finite are left out.
    pub fn fill_polygon(&mut self, points: &[(f32, f32)], color: Color) {
        if let Some(path) = polygon(points) {
            self.fill_path(&path, color);
        }
    }

    /// Fills `rect` with `columns × rows` cells; row 0 is the lowest.
    pub fn cells(
        &mut self,
        rect: Rect,
        columns: usize,
        rows: usize,
        color: impl Fn(usize, usize) -> Option<Color>,
    ) {
        let edge =
            |start: f32, length: f32, i: usize, n: usize| start + length * i as f32 / n as f32;
        for row in 0..rows {
            let bottom = rect.bottom() - edge(0.0, rect.height, row, rows);
            let top = rect.bottom() - edge(0.0, rect.height, row + 1, rows);
            for column in 0..columns {
                let left = edge(rect.x, rect.width, column, columns);
                let right = edge(rect.x, rect.width, column + 1, columns);
                if let Some(color) = color(column, row) {
                    self.fill_rect(Rect::new(left, top, right - left, bottom - top), color);
                }
            }
        }
    }
}
