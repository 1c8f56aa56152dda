//! Rectangles, polylines, polygons and tables of cells.

use crate::{
    canvas::Canvas,
    color::Color,
    pixel::{crisp, polygon, snap},
    rect::Rect,
    stroke::Stroke,
};
use tiny_skia::{LineJoin, PathBuilder};

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

// Lines clipped to a rectangle.

/// The part of the segment `a`–`b` inside `clip` (Liang–Barsky), if any.
fn clip_segment(a: (f32, f32), b: (f32, f32), clip: &Rect) -> Option<((f32, f32), (f32, f32))> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
    for (direction, distance) in [
        (-dx, a.0 - clip.x),
        (dx, clip.right() - a.0),
        (-dy, a.1 - clip.y),
        (dy, clip.bottom() - a.1),
    ] {
        if direction == 0.0 {
            if distance < 0.0 {
                return None;
            }
        } else {
            let t = distance / direction;
            if direction < 0.0 {
                enter = enter.max(t);
            } else {
                leave = leave.min(t);
            }
        }
    }
    (enter <= leave).then(|| {
        let at = |t: f32| (a.0 + t * dx, a.1 + t * dy);
        (
            if enter > 0.0 { at(enter) } else { a },
            if leave < 1.0 { at(leave) } else { b },
        )
    })
}

/// Splits a polyline at the border of `clip` and at points that are not finite.
fn clip_polyline(points: &[(f32, f32)], clip: Option<&Rect>) -> Vec<Vec<(f32, f32)>> {
    let mut pieces: Vec<Vec<(f32, f32)>> = Vec::new();
    let mut joined = false;
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let finite = a.0.is_finite() && a.1.is_finite() && b.0.is_finite() && b.1.is_finite();
        let segment = match clip {
            _ if !finite => None,
            Some(rect) => clip_segment(a, b, rect),
            None => Some((a, b)),
        };
        let Some((from, to)) = segment else {
            joined = false;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if joined && from == a => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
        joined = to == b;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claim: a line that leaves the rectangle and returns becomes two pieces that
    /// end on its border, and a gap in the data splits a line.
    #[test]
    fn clipping_splits_at_borders_and_gaps() {
        let clip = Rect::new(0.0, 0.0, 10.0, 10.0);
        let excursion = [(2.0, 5.0), (4.0, -5.0), (6.0, 5.0)];
        let pieces = clip_polyline(&excursion, Some(&clip));
        assert_eq!(
            pieces,
            vec![vec![(2.0, 5.0), (3.0, 0.0)], vec![(5.0, 0.0), (6.0, 5.0)]]
        );

        let gap = [
            (0.0, 0.0),
            (1.0, 1.0),
            (f32::NAN, 2.0),
            (3.0, 3.0),
            (4.0, 4.0),
        ];
        assert_eq!(clip_polyline(&gap, None).len(), 2);
        let outside = [(-5.0, -5.0), (-1.0, 20.0)];
        assert!(clip_polyline(&outside, Some(&clip)).is_empty());
    }
}
