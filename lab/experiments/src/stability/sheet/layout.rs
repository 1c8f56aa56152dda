//! The width and headings that the sheets share.

use asperity_plot::{Canvas, TextStyle, ink, size};

pub(super) const WIDTH_PX: f32 = 2400.0;

/// Title of a sheet and one line below it.
pub(super) fn heading(canvas: &mut Canvas, title: &str, below: &str) {
    canvas.text(title, (30.0, 62.0), &TextStyle::new(size::HEADING).bold());
    let style = TextStyle::new(size::LABEL).color(ink::GREY);
    let line = canvas.fitted(below, &style, WIDTH_PX - 60.0);
    canvas.text(&line, (30.0, 106.0), &style);
}
