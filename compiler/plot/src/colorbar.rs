//! The bar that says which value a colour stands for.

use crate::axis::Axis;
use crate::canvas::Canvas;
use crate::color::ink;
use crate::color_map::ColorScale;
use crate::frame::TICK_LENGTH;
use crate::panel::Panel;
use crate::pixel::crisp;
use crate::rect::Rect;
use crate::size;
use crate::stroke::Stroke;
use crate::text_style::{Align, TextStyle, VAlign};

const BAR_WIDTH: f32 = 24.0;
const BAR_GAP: f32 = 22.0;

impl Panel {
    /// Draws a colour bar in the right margin; the margin needs about 150 px.
    pub fn colorbar(&self, canvas: &mut Canvas, scale: &ColorScale, label: &str) {
        let area = self.area();
        let bar = Rect::new(area.right() + BAR_GAP, area.y, BAR_WIDTH, area.height);
        draw_colorbar(canvas, bar, scale, label);
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
