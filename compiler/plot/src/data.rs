//! Data in a panel: lines, points, bands and fields of colour.

use crate::axis::Axis;
use crate::canvas::Canvas;
use crate::color::Color;
use crate::marker::Marker;
use crate::panel::Panel;
use crate::rect::Rect;
use crate::stroke::Stroke;

impl Panel {
    /// Draws a line through points in data coordinates, cut at the frame. A value that is not
    /// finite leaves a gap.
    pub fn line(
        &self,
        canvas: &mut Canvas,
        points: impl IntoIterator<Item = (f64, f64)>,
        stroke: Stroke,
    ) {
        let pixels: Vec<(f32, f32)> = points
            .into_iter()
            .map(|(x, y)| self.position(x, y))
            .collect();
        canvas.line(&pixels, stroke, Some(&self.area()));
    }

    /// Draws a marker at each point in data coordinates that lies in the frame.
    pub fn points(
        &self,
        canvas: &mut Canvas,
        points: impl IntoIterator<Item = (f64, f64)>,
        marker: Marker,
        radius: f32,
        fill: Option<Color>,
        outline: Option<Stroke>,
    ) {
        let area = self.area().inset(-0.5);
        for (x, y) in points {
            let at = self.position(x, y);
            if area.contains(at) {
                canvas.marker(at, marker, radius, fill, outline);
            }
        }
    }

    /// Draws a vertical line over the whole height, if `x` is in range.
    pub fn vertical_line(&self, canvas: &mut Canvas, x: f64, stroke: Stroke) {
        self.line(canvas, [(x, self.y.min), (x, self.y.max)], stroke);
    }

    /// Draws a horizontal line over the whole width, if `y` is in range.
    pub fn horizontal_line(&self, canvas: &mut Canvas, y: f64, stroke: Stroke) {
        self.line(canvas, [(self.x.min, y), (self.x.max, y)], stroke);
    }

    /// Fills the part between `from` and `to` on the horizontal axis.
    pub fn band(&self, canvas: &mut Canvas, from: f64, to: f64, color: Color) {
        let area = self.area();
        let at = |x: f64| (self.position(x, self.y.min).0).clamp(area.x, area.right());
        let (left, right) = (at(from), at(to));
        canvas.fill_rect(Rect::new(left, area.y, right - left, area.height), color);
    }

    /// Colours every pixel of the frame from a table of `columns × rows` values that covers
    /// `x_range × y_range`.
    ///
    /// `color(column, row)` is the colour of a cell; row 0 is the lowest. Pixels outside the
    /// table stay as they are.
    pub fn heatmap(
        &self,
        canvas: &mut Canvas,
        x_range: (f64, f64),
        y_range: (f64, f64),
        columns: usize,
        rows: usize,
        color: impl Fn(usize, usize) -> Color,
    ) {
        let cell = |value: f64, (from, to): (f64, f64), count: usize| {
            let index = ((value - from) / (to - from) * count as f64).floor();
            (index >= 0.0 && index < count as f64).then_some(index as usize)
        };
        self.field(canvas, 1, |x, y| {
            Some(color(cell(x, x_range, columns)?, cell(y, y_range, rows)?))
        });
    }

    /// Colours the frame from a function of data coordinates, which is sampled at the centres of
    /// squares of `square_px`. Squares without a colour stay as they are.
    pub fn field(
        &self,
        canvas: &mut Canvas,
        square_px: usize,
        color: impl Fn(f64, f64) -> Option<Color>,
    ) {
        let area = self.area();
        let square = square_px.max(1) as f32;
        let columns = (area.width / square).round().max(1.0) as usize;
        let rows = (area.height / square).round().max(1.0) as usize;
        let value = |axis: &Axis, index: usize, count: usize| {
            axis.value((index as f64 + 0.5) / count as f64)
        };
        canvas.cells(area, columns, rows, |column, row| {
            color(value(&self.x, column, columns), value(&self.y, row, rows))
        });
    }
}
