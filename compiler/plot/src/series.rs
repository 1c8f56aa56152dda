//! Long uniformly sampled series, thinned out to what pixels can show.

use crate::canvas::Canvas;
use crate::panel::Panel;
use crate::stroke::Stroke;

impl Panel {
    /// Draws a uniformly sampled series, sample `i` at `start + i·step`.
    ///
    /// Where many samples fall into one column of pixels, the smallest and the largest of them
    /// are drawn, so no peak is lost.
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
}

/// Values of a column of pixels: first, smallest, largest and last.
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
