//! A panel with one row for each name: its median and its 95th percentile.

use crate::pareto::statistics::Spread;
use asperity_plot::{
    Align, Axis, Canvas, Color, Marker, Panel, Rect, Stroke, TextStyle, VAlign, ink, size,
};

/// A row.
pub(super) struct Row {
    pub(super) name: String,
    pub(super) spread: Spread,
    pub(super) color: Color,
    /// True for the product's own method.
    pub(super) chosen: bool,
}

/// Draws rows from top to bottom.
pub(super) fn draw(
    canvas: &mut Canvas,
    outer: Rect,
    (letter, title): (char, &str),
    label: &str,
    rows: &[Row],
) {
    let most = rows
        .iter()
        .fold(0.0_f64, |most, row| most.max(row.spread.p95));
    let count = rows.len().max(1) as f64;
    let mut y = Axis::new("", 0.0, count).unnumbered();
    y.tick_count = 1;
    let mut panel = Panel::new(outer, Axis::new(label, 0.0, 1.12 * most), y)
        .letter(letter)
        .title(title);
    panel.margins.left = 330.0;
    panel.draw_frame(canvas);
    let style = TextStyle::new(size::TICK).align(Align::Right, VAlign::Middle);
    let number = TextStyle::new(size::TICK - 2.0)
        .color(ink::GREY)
        .align(Align::Center, VAlign::Baseline);
    for (index, row) in rows.iter().enumerate() {
        let height = count - index as f64 - 0.5;
        let (x, middle) = panel.position(0.0, height);
        let name = if row.chosen { style.bold() } else { style };
        canvas.text(&row.name, (x - 18.0, middle), &name);
        let Spread { median, p95, .. } = row.spread;
        let stroke = Stroke::new(row.color, 4.0);
        panel.line(
            canvas,
            [(0.0, height), (p95, height)],
            Stroke::new(ink::GRID, 3.0),
        );
        panel.line(canvas, [(median, height), (p95, height)], stroke);
        panel.points(
            canvas,
            [(median, height)],
            Marker::Circle,
            10.0,
            Some(row.color),
            None,
        );
        let end = Some(Stroke::new(row.color, 3.0));
        panel.points(
            canvas,
            [(p95, height)],
            Marker::Square,
            8.0,
            Some(ink::PAPER),
            end,
        );
        for value in [median, p95] {
            let (x, y) = panel.position(value, height);
            canvas.text(&format!("{value:.2}"), (x, y - 18.0), &number);
        }
    }
}
