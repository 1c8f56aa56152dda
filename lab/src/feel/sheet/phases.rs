//! The strip above the panels that names the script's motions, and the shading of every other
//! motion in the panels.

use asperity_plot::{Align, Canvas, Color, Panel, Rect, Stroke, TextStyle, VAlign, ink};

use super::time::{TIME_MARGINS, time_axis};
use crate::feel::recording::{Recording, Span};
use asperity_sim::hand::Motion;

/// Height of the strip.
pub(super) const HEIGHT_PX: f32 = 96.0;
const LABEL_PX: f32 = 18.0;
const LINE_PX: f32 = 25.0;

/// Draws the strip.
pub(super) fn draw(canvas: &mut Canvas, recording: &Recording, outer: Rect) {
    let left = outer.x + TIME_MARGINS.left;
    let width = outer.width - TIME_MARGINS.left - TIME_MARGINS.right;
    let axis = time_axis(recording, false);
    let at = |t_s: f64| left + width * axis.fraction(t_s) as f32;
    let style = TextStyle::new(LABEL_PX).align(Align::Center, VAlign::Top);
    for (start_s, end_s, motion) in edges(recording) {
        let (x0, x1) = (at(start_s), at(end_s));
        let color = color(&motion);
        canvas.fill_rect(
            Rect::new(x0, outer.y, x1 - x0, outer.height),
            color.alpha(38),
        );
        canvas.fill_rect(Rect::new(x0, outer.y, x1 - x0, 7.0), color);
        canvas.line(
            &[(x0, outer.y), (x0, outer.bottom())],
            Stroke::new(ink::PAPER, 2.0),
            None,
        );
        let fits = |canvas: &Canvas, line: &str| canvas.text_width(line, &style) < x1 - x0 - 4.0;
        let text = motion.to_string();
        let mut lines = vec![motion.name().to_owned()];
        // A number and its unit stand on two lines where one line is too narrow.
        let words: Vec<&str> = text.split(' ').skip(1).collect();
        for pair in words.chunks(2) {
            let whole = pair.join(" ");
            if fits(canvas, &whole) {
                lines.push(whole);
            } else {
                lines.extend(pair.iter().map(|&word| word.to_owned()));
            }
        }
        for (row, line) in lines.iter().enumerate() {
            if fits(canvas, line) {
                let y = outer.y + 16.0 + LINE_PX * row as f32;
                canvas.text(line, (0.5 * (x0 + x1), y), &style);
            }
        }
    }
}

/// Shades every other motion behind a panel's data.
pub(super) fn shade(canvas: &mut Canvas, recording: &Recording, panel: &Panel) {
    for (index, (start_s, end_s, _)) in edges(recording).into_iter().enumerate() {
        if index % 2 == 1 {
            panel.band(canvas, start_s, end_s, ink::GREY.alpha(14));
        }
    }
}

/// Start, end and kind of every motion, s.
fn edges(recording: &Recording) -> Vec<(f64, f64, Motion)> {
    let tick_s = recording.tick_s();
    let ends = |span: Span<'_>| {
        let start_s = span.records.first()?.t_s;
        Some((start_s, span.records.last()?.t_s + tick_s, span.motion))
    };
    recording.spans().into_iter().filter_map(ends).collect()
}

fn color(motion: &Motion) -> Color {
    match motion {
        Motion::Approach { .. } | Motion::Lift { .. } => ink::LIGHT,
        Motion::Tap { .. } => ink::VERMILION,
        Motion::Press { .. } => ink::PURPLE,
        Motion::Stroke { .. } | Motion::Sweep { .. } => ink::BLUE,
        Motion::Scrub { .. } | Motion::Loop { .. } => ink::GREEN,
        Motion::Rest { .. } => ink::ORANGE,
    }
}
