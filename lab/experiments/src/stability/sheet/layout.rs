//! The width, headings and legends that the sheets share.

use asperity_plot::{Canvas, Key, Panel, TextStyle, ink, legend, size};

pub(super) const WIDTH_PX: f32 = 2400.0;

/// Title of a sheet and one line below it.
pub(super) fn heading(canvas: &mut Canvas, title: &str, below: &str) {
    canvas.text(title, (30.0, 62.0), &TextStyle::new(size::HEADING).bold());
    let style = TextStyle::new(size::LABEL).color(ink::GREY);
    let line = canvas.fitted(below, &style, WIDTH_PX - 60.0);
    canvas.text(&line, (30.0, 106.0), &style);
}

/// A legend between a panel's title and its frame.
pub(super) fn keys(canvas: &mut Canvas, panel: &Panel, entries: &[(Key, &str)]) {
    let area = panel.area();
    legend(canvas, (area.x, area.y - 22.0), area.right(), entries);
}
