//! The frame of a panel: title, ticks, numbers and labels.

use crate::canvas::Canvas;
use crate::color::ink;
use crate::panel::Panel;
use crate::pixel::crisp;
use crate::size;
use crate::stroke::Stroke;
use crate::text_style::{Align, TextStyle, VAlign};

/// Length of the marks at ticks, pixels.
pub(crate) const TICK_LENGTH: f32 = 8.0;

impl Panel {
    /// Draws title, frame, ticks and labels.
    ///
    /// Grid lines cover what was drawn before them. Draw heat maps first, then the frame,
    /// then lines and points.
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
}
