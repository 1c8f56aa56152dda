//! A panel: two axes on a rectangle, with frame, title and data.

use super::axis::Axis;
use super::canvas::{Align, Canvas, Marker, Stroke, TextStyle, VAlign, crisp};
use super::color::{Color, ColorScale, ink};
use super::{Rect, size};

/// Space around the plotted area, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margins {
    /// For tick numbers and the label of the vertical axis.
    pub left: f32,
    /// For a colour bar, if any.
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
    /// Whether light lines mark the ticks behind the data.
    pub grid: bool,
    letter: Option<char>,
    title: String,
}

const TICK_LENGTH: f32 = 8.0;
const BAR_WIDTH: f32 = 24.0;
const BAR_GAP: f32 = 22.0;

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

    /// Draws title, frame, ticks and labels. Grid lines lie below what is drawn
    /// later, so heat maps come before and data after.
    pub fn draw_frame(&self, canvas: &mut Canvas) {
        let area = self.area();
        self.draw_title(canvas);
        let frame = Stroke::new(ink::BLACK, size::FRAME);
        let faint = Stroke::new(ink::GRID, 1.0);
        let number = TextStyle::new(size::TICK);

        for (value, text) in self.x.ticks() {
            let x = crisp(self.position(value, self.y.min).0);
            if self.grid {
                canvas.line(&[(x, area.y), (x, area.bottom())], faint, Some(&area));
            }
            let foot = area.bottom() + TICK_LENGTH;
            canvas.line(&[(x, area.bottom()), (x, foot)], frame, None);
            if self.x.numbered {
                let style = number.align(Align::Center, VAlign::Top);
                canvas.text(&text, (x, foot + 6.0), &style);
            }
        }
        let mut widest = 0.0_f32;
        for (value, text) in self.y.ticks() {
            let y = crisp(self.position(self.x.min, value).1);
            if self.grid {
                canvas.line(&[(area.x, y), (area.right(), y)], faint, Some(&area));
            }
            let end = area.x - TICK_LENGTH;
            canvas.line(&[(end, y), (area.x, y)], frame, None);
            if self.y.numbered {
                let style = number.align(Align::Right, VAlign::Middle);
                canvas.text(&text, (end - 6.0, y), &style);
                widest = widest.max(canvas.text_width(&text, &style));
            }
        }
        canvas.stroke_rect(area, frame);

        let label = TextStyle::new(size::LABEL);
        let numbers_height = if self.x.numbered { size::TICK } else { 0.0 };
        let below = area.bottom() + TICK_LENGTH + 6.0 + numbers_height + 8.0;
        let center = area.center();
        canvas.text(
            &self.x.full_label(),
            (center.0, below),
            &label.align(Align::Center, VAlign::Top),
        );
        // Beside the widest number, but never outside the panel.
        let beside = (area.x - TICK_LENGTH - 6.0 - widest - 16.0).max(self.outer.x + size::LABEL);
        canvas.text(
            &self.y.full_label(),
            (beside, center.1),
            &label.align(Align::Center, VAlign::Baseline).upwards(),
        );
    }

    fn draw_title(&self, canvas: &mut Canvas) {
        let area = self.area();
        // A legend may stand between title and frame where the margin has room.
        let baseline = (self.outer.y + 44.0).min(area.y - 20.0);
        let style = TextStyle::new(size::TITLE);
        let mut x = area.x;
        if let Some(letter) = self.letter {
            let text = format!("({letter})");
            canvas.text(&text, (x, baseline), &style.bold());
            x += canvas.text_width(&text, &style.bold()) + 14.0;
        }
        let title = canvas.fitted(&self.title, &style, self.outer.right() - x);
        canvas.text(&title, (x, baseline), &style);
    }

    /// Draws a line through points in data coordinates, cut at the frame; a value
    /// that is not finite leaves a gap.
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

    /// Draws a uniformly sampled series, sample `i` at `start + i·step`. Where many
    /// samples share a pixel column, its smallest and largest are drawn, so that no
    /// peak is lost.
    pub fn series(
        &self,
        canvas: &mut Canvas,
        start: f64,
        step: f64,
        values: &[f64],
        stroke: Stroke,
    ) {
        let area = self.area();
        let samples_per_px = values.len() as f64 / f64::from(area.width);
        if samples_per_px < 3.0 {
            let points = values.iter().enumerate();
            self.line(
                canvas,
                points.map(|(i, &v)| (start + step * i as f64, v)),
                stroke,
            );
            return;
        }
        let mut pixels: Vec<(f32, f32)> = Vec::new();
        let mut column: Option<(i64, Extremes)> = None;
        for (index, &value) in values.iter().enumerate() {
            let (x, y) = self.position(start + step * index as f64, value);
            let bin = x.floor() as i64;
            match &mut column {
                Some((current, extremes)) if *current == bin => extremes.add(y),
                _ => {
                    if let Some((done, extremes)) = column.take() {
                        extremes.push(done, &mut pixels);
                    }
                    column = Some((bin, Extremes::new(y)));
                }
            }
        }
        if let Some((done, extremes)) = column {
            extremes.push(done, &mut pixels);
        }
        canvas.line(&pixels, stroke, Some(&area));
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

    /// Colours every pixel of the frame from a table of `columns × rows` values that
    /// covers `x_range × y_range`; `color(column, row)`, row 0 at the lower end.
    /// Outside the table the paper shows.
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

    /// Colours the frame from a function of data coordinates, sampled at the centres
    /// of squares of `square_px`.
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
            let t = (index as f64 + 0.5) / count as f64;
            match axis.scale {
                super::Scale::Linear => axis.min + t * (axis.max - axis.min),
                super::Scale::Log => axis.min * (axis.max / axis.min).powf(t),
            }
        };
        canvas.cells(area, columns, rows, |column, row| {
            color(value(&self.x, column, columns), value(&self.y, row, rows))
        });
    }

    /// Draws a colour bar in the right margin (wants about 150 px there).
    pub fn colorbar(&self, canvas: &mut Canvas, scale: &ColorScale, label: &str) {
        let area = self.area();
        let bar = Rect::new(area.right() + BAR_GAP, area.y, BAR_WIDTH, area.height);
        draw_colorbar(canvas, bar, scale, label);
    }
}

/// The vertical extremes of one pixel column, in the order they occurred.
struct Extremes {
    first: f32,
    last: f32,
    min: f32,
    max: f32,
}

impl Extremes {
    fn new(y: f32) -> Self {
        Self {
            first: y,
            last: y,
            min: y,
            max: y,
        }
    }

    fn add(&mut self, y: f32) {
        self.last = y;
        self.min = self.min.min(y);
        self.max = self.max.max(y);
    }

    fn push(&self, column: i64, pixels: &mut Vec<(f32, f32)>) {
        let x = column as f32 + 0.5;
        let mut ys = vec![self.first, self.min, self.max, self.last];
        ys.dedup();
        pixels.extend(ys.into_iter().map(|y| (x, y)));
    }
}

/// Draws a vertical colour bar with ticks and label on its right.
fn draw_colorbar(canvas: &mut Canvas, bar: Rect, scale: &ColorScale, label: &str) {
    let rows = bar.height.round().max(1.0) as usize;
    canvas.cells(bar, 1, rows, |_, row| {
        Some(scale.map.at((row as f64 + 0.5) / rows as f64))
    });
    let frame = Stroke::new(ink::BLACK, size::FRAME);
    canvas.stroke_rect(bar, frame);
    let axis = Axis::new(label, scale.min, scale.max);
    let number = TextStyle::new(size::TICK).align(Align::Left, VAlign::Middle);
    let mut widest = 0.0_f32;
    for (value, text) in axis.ticks() {
        let y = crisp(bar.bottom() - bar.height * axis.fraction(value) as f32);
        canvas.line(
            &[(bar.right(), y), (bar.right() + TICK_LENGTH, y)],
            frame,
            None,
        );
        canvas.text(&text, (bar.right() + TICK_LENGTH + 6.0, y), &number);
        widest = widest.max(canvas.text_width(&text, &number));
    }
    let beside = bar.right() + TICK_LENGTH + 6.0 + widest + 14.0;
    canvas.text(
        &axis.full_label(),
        (beside, bar.center().1),
        &TextStyle::new(size::LABEL)
            .align(Align::Center, VAlign::Top)
            .upwards(),
    );
}
